#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs cases of the study (docs/study.md), each into runs/study/<case>:

    perf/study/run.py --list
    perf/study/run.py ssw-k4 ssw-k4-no-fluid ...

A case that was interrupted goes on from its newest checkpoint; one that is done is left alone. A case that shares the sample of
another starts from that one's checkpoint, which is made first if it is not there.
"""

from __future__ import annotations

import argparse
import json
import pathlib
import shutil
import subprocess
import sys

from cases import CASES, Case

ROOT = pathlib.Path(__file__).resolve().parents[2]
SAMPLES = ("compression", "perforation")  # stages whose end state is kept for the cases that share it


class Study:
    def __init__(self, program: str, folder: pathlib.Path, extra: list[str]) -> None:
        self.program, self.folder, self.extra = program, folder, extra

    def run(self, name: str) -> None:
        case, folder = CASES[name], self.folder / name
        if self.ended_stage(folder) == "all":
            print(f"{name}: done already, in {folder}")
            return
        if case.sample and not folder.exists():
            start = self.sample(case.sample, case.since)
            self.arenite(case, folder, ["--resume", str(start)])
            return
        if not case.sample:
            for stage in SAMPLES:
                self.sample(name, stage)
        self.arenite(case, folder, ["--resume"] + (["--until", case.until] if case.until else []))

    def sample(self, name: str, stage: str) -> pathlib.Path:
        """The checkpoint of a case at the end of a stage, made if it is not there."""
        folder = self.folder / name
        kept = folder / f"after_{stage}.h5"
        if not kept.exists():
            resume = ["--resume"] if list(folder.glob("checkpoint-*.h5")) else []
            self.arenite(CASES[name], folder, resume + ["--until", stage])
            shutil.copyfile(max(folder.glob("checkpoint-*.h5")), kept)
        return kept

    def arenite(self, case: Case, folder: pathlib.Path, arguments: list[str]) -> None:
        changes = [word for key, value in case.changes.items() for word in ("--set", f"{key}={value}")]
        command = [self.program, "run", str(ROOT / "scenes/paper" / case.scene), "-o", str(folder), *arguments, *changes, *self.extra]
        print("+", " ".join(command), flush=True)
        subprocess.run(command, check=True)

    @staticmethod
    def ended_stage(folder: pathlib.Path) -> str:
        try:
            return "all" if json.loads((folder / "summary.json").read_text())["outcome"] == "done" else ""
        except (OSError, ValueError, KeyError):
            return ""


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("cases", nargs="*", metavar="CASE")
    parser.add_argument("--list", action="store_true", help="names, scenes and changes of all cases")
    parser.add_argument("--program", default=str(ROOT / "build/openmp/apps/arenite"))
    parser.add_argument("--folder", type=pathlib.Path, default=ROOT / "runs/study")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", help="one more change, for all the cases")
    options = parser.parse_args()
    unknown = [name for name in options.cases if name not in CASES]
    if unknown:
        parser.error(f"no case {', '.join(unknown)}; see --list")
    if options.list or not options.cases:
        for name, case in CASES.items():
            print(f"{name:28} {case.scene:14} {case.note}" + (f"; sample of {case.sample}" if case.sample else ""))
        return 0
    study = Study(options.program, options.folder, [word for change in options.set for word in ("--set", change)])
    for name in options.cases:
        study.run(name)
    return 0


if __name__ == "__main__":
    sys.exit(main())
