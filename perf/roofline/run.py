#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Grain steps against what the machine can do: speed, cost per particle-step and shares of a stream copy and of
multiply-adds that are measured in the same run, for every pack, law and number of threads; memory by View. So it is also
how cost grows with the number of grains. What is stepped tile by tile is measured in one part too (whole_steps). Fails where
a pack's state depends on the number of threads or on the tiles.

Writes roofline.csv and memory.csv. Bytes and flops are counted by hand: apps/bench_limits.cpp says what is counted."""

from __future__ import annotations

import argparse
import collections
import itertools
import statistics
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import measure  # noqa: E402
import packs  # noqa: E402

# Of `arenite bench`, in the order of the table's columns; the first is also given as least and most.
MEDIANS = ["particle_steps_per_s", "evaluate_ns", "integrate_ns", "one_search_s", "searches", "candidates_per_grain",
           "contacts_per_grain", "bytes_per_particle_step", "flops_per_particle_step", "copy_bytes_per_s",
           "copy_bytes_per_s_beyond_caches", "multiply_add_flops_per_s", "share_of_copy", "share_of_copy_beyond_caches",
           "share_of_multiply_add", "memory_bytes_per_grain", "peak_memory_bytes_per_grain"]
COLUMNS = ["grains", "law", "threads", "whole_steps", "repeats", "steps", *MEDIANS, "least_particle_steps_per_s",
           "most_particle_steps_per_s", "state_hash"]


def steps_for(grains: int, particle_steps: float) -> int:
    return max(50, min(6000, round(particle_steps / grains)))


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--arenite", type=Path, default=measure.DEFAULT_PROGRAM, help="the program under test")
    parser.add_argument("--grains", type=int, nargs="+", default=list(packs.GRAINS), choices=packs.GRAINS, help="packs")
    parser.add_argument("--threads", type=int, nargs="+", default=sorted({1, measure.cores()}))
    parser.add_argument("--repeats", type=int, default=3, help="rounds")
    parser.add_argument("--particle-steps", type=float, default=5e7, help="of a round; 50 steps at least, 6000 at most")
    arguments = parser.parse_args()
    results = collections.defaultdict(list)  # of (grains, law, threads, in one part)
    for number in range(1, arguments.repeats + 1):  # round by round: a host that slows down slows all packs
        for law, threads, grains in itertools.product(("hertz", "jkr"), arguments.threads, arguments.grains):
            steps = steps_for(grains, arguments.particle_steps)
            for whole in (0, 1):
                run = measure.bench(arguments.arenite, threads, "--pack", packs.get(grains, arguments.arenite).file, "--law", law,
                                    "--steps", steps, "--warm-up", max(5, steps // 2), "--repeats", 1, "--limits",
                                    *(["--whole-steps"] if whole else []))[0]
                results[grains, law, threads, whole].append(run)
                print(f"round {number}: {grains:8} grains, {law:5}, {threads} threads{', in one part' if whole else ''}: "
                      f"{run['particle_steps_per_s'] / 1e6:6.2f} M particle-steps/s, {100 * run['share_of_copy']:.0f} % of a copy",
                      flush=True)
                if run["tile_grains"] == 0:
                    break  # there is nothing to compare
    rows, hashes = [], collections.defaultdict(set)
    for (grains, law, threads, whole), runs in sorted(results.items()):
        medians = [float(statistics.median(run[name] for run in runs)) for name in MEDIANS]
        speeds = [run["particle_steps_per_s"] for run in runs]
        hashes[grains, law] |= {run["state_hash"] for run in runs}
        rows.append([grains, law, threads, whole, len(runs), runs[0]["steps"], *medians, min(speeds), max(speeds),
                     runs[0]["state_hash"]])
    memory = [[grains, law, view, size] for grains, law in hashes
              for view, size in results[grains, law, arguments.threads[0], 0][0]["memory"].items()]
    torn = [f"{grains} grains, {law}: the state depends on the threads or the run: {', '.join(sorted(found))}"
            for (grains, law), found in hashes.items() if len(found) > 1]
    for law, threads in itertools.product(("hertz", "jkr"), arguments.threads):
        first, last = (results[grains, law, threads, 0] for grains in (min(arguments.grains), max(arguments.grains)))
        growth = statistics.median(a["particle_steps_per_s"] / b["particle_steps_per_s"] for a, b in zip(first, last))
        print(f"{law:5}, {threads} threads: the largest pack takes {growth:.2f} times the smallest one's time a particle-step")
    head = measure.header(measure.program_info(arguments.arenite), "medians of interleaved rounds; skin 3e-05 m, dt 1e-8 s, 1000 g",
                          "copy: as much memory as the pack takes; beyond caches: 512 MiB", *torn)
    measure.write_table(measure.results_folder() / "roofline.csv", head, COLUMNS, rows)
    measure.write_table(measure.results_folder() / "memory.csv", head, ["grains", "law", "view", "bytes_per_grain"], memory)
    for line in torn:
        print(f"FAILED {line}")
    return 1 if torn else 0


if __name__ == "__main__":
    sys.exit(main())
