# SPDX-License-Identifier: MIT
"""The command line of the report. `arenite report` starts it and passes its arguments on; exit codes as everywhere: 0, 1, 2."""

from __future__ import annotations

import sys

if sys.version_info < (3, 11):
    sys.exit(f"arenite report needs Python 3.11 or newer; {sys.executable} is {sys.version.split()[0]} (set ARENITE_PYTHON to another)")

import argparse
import importlib.util
import time
from pathlib import Path

HOW_TO_GET = "./run.sh installs what the report needs into deps/python; or: python3 -m pip install matplotlib pyvista"


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="arenite report", description="report.html with the pictures and tables of one or several runs")
    parser.add_argument("folders", metavar="DIR", nargs="+", type=Path, help="a run's folder")
    parser.add_argument("-o", "--output", type=Path, help="the page, or a folder for it; report.html in the first DIR unless named")
    parser.add_argument("--measured", metavar="CSV", action="append", type=Path, default=[], help="points (t, M) to compare with")
    parser.add_argument("--reference", metavar="DIR", type=Path, help="the run that the others are compared with: the original")
    parser.add_argument("--scaling", metavar="CSV", action="append", type=Path, default=[], help="wall times: case, threads, wall_time")
    return parser.parse_args()


def page_of(options: argparse.Namespace) -> Path:
    if options.output is None:
        return options.folders[0] / "report.html"
    return options.output if options.output.suffix in (".html", ".htm") else options.output / "report.html"


def scaling_files(options: argparse.Namespace) -> list[Path]:
    """Those named, or what the source tree keeps in perf/scaling."""
    return options.scaling or sorted((Path(__file__).parents[3] / "perf" / "scaling").glob("*.csv"))


def run() -> int:
    options = arguments()
    folders = list(dict.fromkeys([*options.folders, *([options.reference] if options.reference else [])]))
    absent = [str(folder) for folder in folders if not folder.is_dir()]
    if absent:
        print(f"no such folder: {', '.join(absent)}", file=sys.stderr)
        return 2
    lacking = [name for name in ("numpy", "matplotlib") if importlib.util.find_spec(name) is None]
    if lacking:
        print(f"the report needs {' and '.join(lacking)} for {sys.executable}. {HOW_TO_GET}", file=sys.stderr)
        return 1
    from . import figures_production, figures_speed
    from .report import Request, write_report
    from .run_folder import PARTS, holds_a_run

    strange = [str(folder) for folder in folders if not holds_a_run(folder)]
    if strange:
        print(f"nothing of a run in {', '.join(strange)}: none of {', '.join(PARTS)}", file=sys.stderr)
        return 2

    begin = time.perf_counter()
    request = Request(folders, page_of(options), options.reference)
    try:
        request.measured = [figures_production.read_measured(path) for path in options.measured]
        request.timings = figures_speed.read_scaling(scaling_files(options))
        request.scaling_source = ", ".join(path.name for path in scaling_files(options))
    except (OSError, ValueError) as error:
        print(error, file=sys.stderr)
        return 2
    for line in write_report(request):
        print(f"missing: {line}", file=sys.stderr)
    print(f"{request.page} ({time.perf_counter() - begin:.1f} s)")
    return 0


if __name__ == "__main__":
    sys.exit(run())
