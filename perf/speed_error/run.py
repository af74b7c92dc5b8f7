#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Speed against error: runs the ladders and writes docs/speed_error.md, its figures and the CSV of all rows.

    perf/speed_error/run.py [--arenite PROGRAM] [--only LADDER ...] [--folder DIR]

With --only the page is not written; runs that are in the folder already are taken from there (runs.py), so
ladders may be made one by one and the page at the end. Needs matplotlib.
"""
import argparse
import dataclasses
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import fluid_ladders
import grain_ladders
import measure
import page
import runs
from rows import Row

LADDERS = {"time_step": grain_ladders.time_step, "coupling": fluid_ladders.coupling,
           "k": grain_ladders.coarse_graining, "cells": fluid_ladders.cells, "smoothing": fluid_ladders.smoothing,
           "tolerance": fluid_ladders.tolerance, "skin": grain_ladders.skin}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--arenite", default=measure.DEFAULT_PROGRAM, help="the program")
    parser.add_argument("--only", nargs="+", choices=LADDERS)
    parser.add_argument("--folder", default=measure.ROOT / "runs/speed_error", help="of the runs")
    arguments = parser.parse_args()
    work = runs.Runs(arguments.arenite, arguments.folder)
    rows = [row for name in arguments.only or LADDERS for row in LADDERS[name](work)]
    if arguments.only: return
    comments = measure.header(measure.program_info(work.program))[:2] + ["perf/speed_error/run.py, one thread"]
    columns = [field.name for field in dataclasses.fields(Row)]
    measure.write_table(measure.results_folder() / "speed_error.csv", comments, columns, map(dataclasses.astuple, rows))
    page.write(rows, work.version, work.cpu_seconds() / 60)


if __name__ == "__main__":
    main()
