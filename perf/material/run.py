#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Material tests on periodic samples: runs the series and writes docs/material.md, its figures and the CSV of all rows.

    perf/material/run.py [--arenite PROGRAM] [--only SERIES ...] [--seeds N ...] [--folder DIR] [--page]

Runs that are in the folder already are taken from there, so series may be run one by one; with --only no page is
written, with --page nothing is run and the page says what is missing. Needs numpy and matplotlib.
"""

import argparse
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent), str(HERE.parent / "speed_error")]

import measure  # noqa: E402
import runs  # noqa: E402
from cases import SEEDS, SERIES, Test  # noqa: E402


def run(work: runs.Runs, test: Test) -> runs.Run | None:
    """None where it is not there and may not be made."""
    scene = runs.SCENES / f"{test.scene}.toml"
    sample = work.scene(test.sample, scene, test.sample_settings(), until="confine")
    return sample and work.scene(test.name, scene, test.settings(), resume=sample.last_checkpoint())


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--arenite", default=measure.DEFAULT_PROGRAM, help="the program")
    parser.add_argument("--only", nargs="+", choices=SERIES, metavar="SERIES", help=", ".join(SERIES))
    parser.add_argument("--seeds", nargs="+", type=int, default=SEEDS, help="of those of the series")
    parser.add_argument("--folder", default=measure.ROOT / "runs/material", help="of the runs")
    parser.add_argument("--page", action="store_true", help="the page from the runs that are there")
    arguments = parser.parse_args()
    work = runs.Runs(arguments.arenite, arguments.folder, make=not arguments.page)
    made = {
        name: {test: run(work, test) for test in SERIES[name]() if test.seed in arguments.seeds}
        for name in arguments.only or SERIES
    }
    if arguments.only:
        return
    import page

    page.write(work, made)


if __name__ == "__main__":
    main()
