#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs cases of the study (docs/study.md), each in a folder runs/study/CASE:

    perf/study/run.py --list
    perf/study/run.py ssw-k4 ssw-k4-no-fluid

What a case starts from is run first if it is not there. A case that was interrupted goes on from its newest checkpoint; one that is
done is left alone.
"""

from __future__ import annotations

import argparse
import json
import pathlib
import shutil
import subprocess
import sys

from cases import CASES

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from measure import DEFAULT_PROGRAM, ROOT  # noqa: E402


def is_done(folder: pathlib.Path) -> bool:
    """Ended where the case ends; a folder without a readable summary has not."""
    try:
        summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return False
    until = CASES[folder.name].until
    return any(stage["name"].split("/")[0] == until for stage in summary["stages"]) if until else summary.get("outcome") == "done"


def run(name: str, folder: pathlib.Path, program: str, more: list[str]) -> None:
    case, own = CASES[name], folder / name
    if is_done(own):
        print(f"{name}: done already, in {own}")
        return
    if case.start and not own.exists():
        run(case.start, folder, program, more)
        shutil.copytree(folder / case.start, own)
    command = [program, "run", str(ROOT / "scenes" / case.scene), "-o", str(own)]
    if list(own.glob("checkpoint-*.h5")):
        command.append("--resume")
    if case.until:
        command += ["--until", case.until]
    for key, value in case.changes.items():
        command += ["--set", f"{key}={value}"]
    print("+", " ".join(command + more), flush=True)
    subprocess.run(command + more, check=True)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("cases", nargs="*", metavar="CASE")
    parser.add_argument("--list", action="store_true", help="the cases, what they are and what they start from")
    parser.add_argument("--program", default=str(DEFAULT_PROGRAM))
    parser.add_argument("--folder", type=pathlib.Path, default=ROOT / "runs/study")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", help="one more change, for all of the cases")
    options = parser.parse_args()
    unknown = [name for name in options.cases if name not in CASES]
    if unknown:
        parser.error(f"no case {', '.join(unknown)}; see --list")
    if options.list or not options.cases:
        for name, case in CASES.items():
            print(f"{name:26} {case.scene:20} {case.start or '-':24} {case.note}")
        return 0
    for name in options.cases:
        run(name, options.folder, options.program, [word for change in options.set for word in ("--set", change)])
    return 0


if __name__ == "__main__":
    sys.exit(main())
