#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Speed against error: runs the ladders and writes docs/speed_error.md, its figures and the CSV of all rows.

    perf/speed_error/run.py build/openmp/apps/arenite [--machine epyc-2core] [--only LADDER ...] [--folder DIR]

Ladders: time_step, seeds, coupling, k, fluid, skin. With --only the page is not written; runs that are in the
folder already are taken from there (runs.py), so ladders may be made one by one and the page at the end.
Needs matplotlib.
"""
import argparse
import csv
import dataclasses
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import ladders
import page
import runs
from page_parts import ROOT


def write_csv(path, rows, version):
    path.parent.mkdir(parents=True, exist_ok=True)
    with open(path, "w", newline="") as file:
        file.write(f"# {version}; perf/speed_error/run.py; one thread\n")
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow([field.name for field in dataclasses.fields(ladders.Row)])
        for row in rows:
            writer.writerow(["" if value is None else f"{value:.6g}" if isinstance(value, float) else value
                             for value in dataclasses.astuple(row)])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", help="the arenite program")
    parser.add_argument("--machine", default="epyc-2core", help="folder of perf/results that takes the CSV")
    parser.add_argument("--only", nargs="+", choices=ladders.LADDERS)
    parser.add_argument("--folder", default=ROOT / "runs/speed_error", help="of the runs")
    arguments = parser.parse_args()
    work = runs.Runs(arguments.program, arguments.folder)
    rows = [row for name in arguments.only or ladders.LADDERS for row in ladders.LADDERS[name](work)]
    if arguments.only: return
    write_csv(ROOT / "perf/results" / arguments.machine / "speed_error.csv", rows, work.version)
    page.write(rows, work)


if __name__ == "__main__":
    main()
