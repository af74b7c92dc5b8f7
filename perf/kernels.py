#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The Google Benchmarks of perf/ on this machine; perf/results/<machine>/kernels.csv.

    cmake --preset openmp -DARENITE_ENABLE_PERF=ON && cmake --build --preset openmp
    python3 perf/kernels.py [--build FOLDER] [--threads 1,2] [--repetitions 5] [--filter REGEX]

Columns: program, benchmark, threads, median wall time of a call, its spread (coefficient of variation over the repetitions), and
items (grains, cells, contacts or evaluations; the program says which) per second at the median."""

from __future__ import annotations

import argparse
import json
import re
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import measure  # noqa: E402

PROGRAMS = {"bench_kernels": True, "bench_pair_storage": True, "bench_jkr": False}  # whether it has threads
COLUMNS = ["program", "benchmark", "threads", "median_ms", "spread_percent", "items_per_s"]


def flags(build: Path) -> str:
    """Those of optimisation and target that the kernels are compiled with."""
    for entry in json.loads((build / "compile_commands.json").read_text()):
        if entry["file"].endswith("/kernels/integrate.cpp"):
            words = entry["command"].split()
            return " ".join(w for w in words if re.match(r"-(O|m|f|D?NDEBUG|arch|-use)", w) and not w.startswith("-fdiag"))
    return "unknown"


def run(program: Path, threads: int, repetitions: int, which: str) -> list[dict]:
    command = [program, "--benchmark_format=json", f"--benchmark_repetitions={repetitions}", "--benchmark_min_time=0.2",
               "--benchmark_report_aggregates_only=true", f"--benchmark_filter={which}"]
    done = subprocess.run(command, env=measure.environment_of(threads), capture_output=True, text=True)
    if done.returncode != 0 or not done.stdout.strip():
        raise SystemExit(f"{program} failed:\n{done.stderr}{done.stdout}")
    return json.loads(done.stdout)["benchmarks"]


def rows_of(program: Path, threads: int, results: list[dict]) -> list[list]:
    to_ms = {"ns": 1e-6, "us": 1e-3, "ms": 1.0, "s": 1e3}
    by_name: dict[str, dict] = {}
    for result in results:
        by_name.setdefault(result["run_name"].removesuffix("/real_time"), {})[result["aggregate_name"]] = result
    rows = []
    for name, parts in by_name.items():
        median = parts["median"]
        items = median.get("items_per_second", median.get("grains/s", ""))
        rows.append([program.name, name, threads, median["real_time"] * to_ms[median["time_unit"]], 100 * parts["cv"]["real_time"], items])
    return rows


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=Path, default=measure.ROOT / "build/openmp")
    parser.add_argument("--threads", default="1,2", help="numbers, with commas")
    parser.add_argument("--repetitions", type=int, default=5)
    parser.add_argument("--filter", default=".", help="only benchmarks whose name matches; writes no table")
    options = parser.parse_args()
    rows = []
    for name, threaded in PROGRAMS.items():
        for threads in [int(word) for word in options.threads.split(",")] if threaded else [1]:
            new = rows_of(options.build / "perf" / name, threads, run(options.build / "perf" / name, threads, options.repetitions, options.filter))
            for row in new:
                print(f"{row[1]:34} {row[2]} threads {row[3]:10.4f} ms  {row[4]:5.1f} %", flush=True)
            rows += new
    if options.filter == ".":
        info = measure.program_info(options.build / "apps/arenite")
        notes = (f"flags: {flags(options.build)}", f"{options.repetitions} repetitions")
        measure.write_table(measure.results_folder() / "kernels.csv", measure.header(info, *notes), COLUMNS, rows)


if __name__ == "__main__":
    main()
