#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Speed over threads, strong (one pack for all) and weak (a tile of 8 438 grains per thread), and the wall time of the same
production at k = 1, 2 and 4. Writes threads.csv to perf/results/<machine>, and perf/scaling/<machine>.csv, which
`arenite report` draws beside the paper's speed-ups; pictures come with perf/performance_page.py.
How cost grows with the number of grains is measured by perf/roofline/run.py."""

from __future__ import annotations

import argparse
import statistics
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
sys.path.insert(0, str(Path(__file__).resolve().parent))
import cases  # noqa: E402
import measure  # noqa: E402
import packs  # noqa: E402

STRONG, WEAK = 33752, 8438  # grains: of the pack, and of a thread's tile
WALL_TIME_OF = 1e-3         # s of production that the wall times are for


def measure_threads(program: Path, counts: list[int], rounds: int, particle_steps: float) -> list[list]:
    """A row per kind, law and number of threads; the counts of threads are interleaved."""
    results: dict[tuple, list[float]] = {}
    for _ in range(rounds):
        for law in ("hertz", "jkr"):
            for threads in counts:
                for kind, grains, tile in (("strong", STRONG, 1), ("weak", WEAK, threads)):
                    pack = ["--pack", packs.get(grains, program).file, "--tile", tile, 1]
                    steps = round(particle_steps / (grains * tile))
                    length = ["--steps", steps, "--warm-up", steps // 5, "--repeats", 1]
                    speed = measure.bench(program, threads, *pack, "--law", law, *length)[0]["particle_steps_per_s"]
                    results.setdefault((kind, law, threads, grains * tile), []).append(speed)
    rows = []
    for (kind, law, threads, grains), speeds in results.items():
        alone = next(values for key, values in results.items() if key[:3] == (kind, law, counts[0]))
        gains = [speed / one for speed, one in zip(speeds, alone)]
        rows.append([kind, law, threads, grains, len(speeds), statistics.median(speeds) / 1e6, min(speeds) / 1e6,
                     max(speeds) / 1e6, statistics.median(gains)])
    return rows


def measure_cases(program: Path, counts: list[int], rounds: int) -> list[list]:
    rows = []
    for k in cases.FACTORS:
        scene = cases.write_case(k, program)
        fluid_steps = {4: 32, 2: 8, 1: 1}[k]  # a run takes seconds
        for threads in counts:
            for _ in range(rounds if k > 1 else 1):
                wall_time = WALL_TIME_OF * cases.seconds_per_second(program, scene, threads, fluid_steps)
                name, grains = "original" if k == 1 else "SSW", cases.grains_of(k)
                rows.append([name, k, threads, wall_time, grains, grains * WALL_TIME_OF / (1e-8 * k) / wall_time])
                print(f"{name}, k = {k}, {threads} threads: {wall_time:.0f} s for {WALL_TIME_OF:g} s of production", flush=True)
    return rows


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--arenite", type=Path, default=measure.DEFAULT_PROGRAM, help="the program under test")
    parser.add_argument("--threads", type=int, nargs="+", help="1, 2, 4, ... up to the cores unless named")
    parser.add_argument("--rounds", type=int, default=3, help="repetitions; once for k = 1, which takes longest")
    parser.add_argument("--particle-steps", type=float, default=1.5e7, help="of a timing")
    arguments = parser.parse_args()
    powers = [2**n for n in range(10) if 2**n <= measure.cores()]
    counts = arguments.threads or sorted({*powers, measure.cores()})
    info = measure.program_info(arguments.arenite)

    rows = measure_threads(arguments.arenite, counts, arguments.rounds, arguments.particle_steps)
    measure.write_table(measure.results_folder() / "threads.csv", measure.header(info, "medians; speed_up: median of the rounds'"),
                        ["kind", "law", "threads", "grains", "rounds", "Mparticle_steps_per_s", "least", "most", "speed_up"], rows)
    rows = measure_cases(arguments.arenite, counts, arguments.rounds)
    head = measure.header(info, f"wall_time: s for {WALL_TIME_OF:g} s of production with water, the same volume of sand at each k",
                          "from the difference of two run lengths; dt = k 1e-8 s, a fluid step every 1e-6 s")
    measure.write_table(measure.ROOT / f"perf/scaling/{measure.machine_name()}.csv", head,
                        ["case", "k", "threads", "wall_time", "grains", "particle_steps_per_s"], rows)
    return 0


if __name__ == "__main__":
    sys.exit(main())
