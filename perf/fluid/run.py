#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Fluid and coupling, timed; perf/results/<machine>/fluid.csv and coupling.csv.

    cmake --preset openmp -DARENITE_ENABLE_PERF=ON && cmake --build --preset openmp
    python3 perf/fluid/run.py [--build FOLDER] [--threads 1,2] [--cells 32,64,128] [--quick]

fluid.csv: a step of n^3 cells with a variable void fraction (bench_projection.cpp says which), the pressure solve in it, and
the same linear system to the same residual by PyAMG (conjugate gradients, preconditioned by smoothed aggregation and by
Ruge-Stueben; Bell, Olson & Schroder 2022). PyAMG comes from the package index into build/pyamg; where it cannot, that is said
and the rows are left out. coupling.csv: deposit, interpolation and fluid in steps of the grains.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import measure  # noqa: E402

HERE = Path(__file__).resolve().parent
PYAMG = ("pyamg==5.4.1", "numpy", "scipy")
FLUID = ["solver", "cells_per_edge", "backend", "threads", "step_ms", "iterations", "setup_and_solve_ms", "Mcell_updates_per_s",
         "solve_GB_per_s", "copy_GB_per_s", "share_of_copy"]
COUPLING = ["grains", "cells", "backend", "threads", "grain_step_ms", "deposit_ms", "interpolate_ms", "flow_ms",
            "exchange_in_grain_steps", "share_at_100_steps", "share_at_50_steps"]


def pyamg_python() -> Path | None:
    """A Python that has PyAMG."""
    folder = measure.ROOT / "build/pyamg"
    python = folder / "bin/python3"
    if subprocess.run([python, "-c", "import pyamg"], capture_output=True).returncode == 0 if python.exists() else False:
        return python
    made = subprocess.run([sys.executable, "-m", "venv", folder], capture_output=True, text=True)
    if made.returncode == 0:
        made = subprocess.run([python, "-m", "pip", "install", "--quiet", *PYAMG], capture_output=True, text=True)
    if made.returncode != 0:
        print(f"PyAMG could not be installed; its rows are left out:\n{made.stderr.strip()}", file=sys.stderr)
        return None
    return python


def run(program: Path, threads: int, *arguments: object) -> list[str]:
    done = subprocess.run([str(program), *map(str, arguments)], env=measure.environment_of(threads), capture_output=True, text=True)
    if done.returncode != 0:
        raise SystemExit(f"{program.name} {' '.join(map(str, arguments))} failed:\n{done.stderr}")
    return done.stdout.strip().split(",")


def fluid_rows(build: Path, cells: list[int], threads: list[int], repeats: int) -> list[list]:
    rows, python = [], pyamg_python()
    for n in cells:
        with tempfile.TemporaryDirectory() as system:
            for count in threads:
                row = run(build / "perf/bench_projection", count, n, repeats, system)
                rows.append(["arenite", *row])
                print(",".join(rows[-1]), flush=True)
            if python is None:
                continue
            environment = {**os.environ, "OMP_NUM_THREADS": "1"}
            done = subprocess.run([python, HERE / "pyamg_poisson.py", system, str(n), str(min(repeats, 3))], env=environment,
                                  capture_output=True, text=True)
            if done.returncode != 0:
                print(f"PyAMG failed at {n}^3:\n{done.stderr}", file=sys.stderr)
                continue
            for result in map(json.loads, done.stdout.splitlines()):
                rows.append([result["solver"], n, "host", 1, "", result["iterations"], f"{result['ms']:.1f}", "", "", "", ""])
                print(",".join(map(str, rows[-1])), flush=True)
    return rows


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=Path, default=measure.ROOT / "build/openmp")
    parser.add_argument("--threads", default="1,2", help="numbers, with commas")
    parser.add_argument("--cells", default="32,64,128", help="cells per edge, with commas")
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--only", choices=["fluid", "coupling"])
    parser.add_argument("--quick", action="store_true", help="small sizes, to see that it works; writes no tables")
    options = parser.parse_args()
    threads = [int(word) for word in options.threads.split(",")]
    cells = [16, 32] if options.quick else [int(word) for word in options.cells.split(",")]
    # The paper's grid at k = 2 and k = 1, and a million grains on cells of the same size.
    cases = [(3375, (4, 4, 4))] if options.quick else [(34000, (12, 12, 6)), (270000, (12, 12, 6)), (1000000, (28, 28, 28))]
    info = measure.program_info(options.build / "apps/arenite")
    folder = measure.results_folder()
    if options.only != "coupling":
        rows = fluid_rows(options.build, cells, threads, options.repeats)
        if not options.quick:
            measure.write_table(folder / "fluid.csv", measure.header(info, f"medians of {options.repeats}"), FLUID, rows)
    if options.only != "fluid":
        rows = []
        for grains, grid in cases:
            for count in threads:
                row = run(options.build / "perf/bench_coupling", count, grains, *grid, options.repeats)
                rows.append(row)
                print(",".join(row), flush=True)
        if not options.quick:
            measure.write_table(folder / "coupling.csv", measure.header(info, f"medians of {options.repeats}; modified JKR, history on"),
                                COUPLING, rows)


if __name__ == "__main__":
    main()
