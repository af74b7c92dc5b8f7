#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Speed against error: runs the ladders and writes docs/speed_error.md, its figures and the CSV of all rows.

    perf/speed_error/run.py build/openmp/apps/arenite [--machine epyc-2core] [--only LADDER ...] [--folder DIR]

With --only the page is not written; runs that are in the folder already are taken from there (runs.py), so
ladders may be made one by one and the page at the end. Needs matplotlib.
"""
import argparse
import csv
import dataclasses
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import fluid_ladders
import grain_ladders
import page
import runs
from page_parts import ROOT
from rows import Row

LADDERS = {"time_step": grain_ladders.time_step, "seeds": grain_ladders.seeds, "coupling": fluid_ladders.coupling,
           "k": grain_ladders.coarse_graining, "cells": fluid_ladders.cells, "smoothing": fluid_ladders.smoothing,
           "tolerance": fluid_ladders.tolerance, "skin": grain_ladders.skin}


def write_csv(path, rows, version):
    with open(path, "w", newline="") as file:
        file.write(f"# {version}; perf/speed_error/run.py; one thread\n")
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow([field.name for field in dataclasses.fields(Row)])
        for row in rows:
            writer.writerow(["" if value is None else f"{value:.6g}" if isinstance(value, float) else value
                             for value in dataclasses.astuple(row)])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", help="the arenite program")
    parser.add_argument("--machine", default="epyc-2core", help="folder of perf/results that takes the CSV")
    parser.add_argument("--only", nargs="+", choices=LADDERS)
    parser.add_argument("--folder", default=ROOT / "runs/speed_error", help="of the runs")
    arguments = parser.parse_args()
    work = runs.Runs(arguments.program, arguments.folder)
    rows = [row for name in arguments.only or LADDERS for row in LADDERS[name](work)]
    if arguments.only: return
    write_csv(ROOT / "perf/results" / arguments.machine / "speed_error.csv", rows, work.version)
    page.write(rows, arguments.machine, work.version, work.cpu_seconds() / 60)


if __name__ == "__main__":
    main()
