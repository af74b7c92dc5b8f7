# SPDX-License-Identifier: MIT
"""What the tests of whole runs share: the program as a user starts it, and two folders of results compared.
The same state gives the same bytes of a checkpoint, so files are compared, not numbers."""

import os
import re
import subprocess
import sys
from pathlib import Path

faults: list[str] = []


def expect(truth: object, what: str) -> None:
    if not truth:
        faults.append(what)
        print(f"FAULT: {what}", flush=True)


def finish() -> None:
    print("all as it should be" if not faults else f"{len(faults)} faults", flush=True)
    sys.exit(1 if faults else 0)


class Arenite:
    def __init__(self, program: str, threads: int = 1) -> None:
        self.program = program
        # More threads than cores wait for each other: asleep, not turning.
        self.environment = os.environ | {"OMP_NUM_THREADS": str(threads), "OMP_PROC_BIND": "false", "OMP_WAIT_POLICY": "passive"}

    def command(self, scene: Path, folder: Path, *words: str) -> list[str]:
        return [self.program, "run", str(scene), "-o", str(folder), "--quiet", *words]

    def start(self, scene: Path, folder: Path, *words: str, **options: object) -> subprocess.Popen:
        return subprocess.Popen(self.command(scene, folder, *words), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                env=self.environment, **options)

    def run(self, scene: Path, folder: Path, *words: str, code: int = 0, **options: object) -> str:
        """What it says, in all; its exit code has to be the given one."""
        process = self.start(scene, folder, *words, **options)
        out, err = process.communicate()
        expect(process.returncode == code, f"{' '.join(words)}: exit code {process.returncode}, not {code}: {(out + err)[-600:]}")
        return out + err


def checkpoints(folder: Path) -> list[Path]:
    return sorted(folder.glob("checkpoint-*.h5"))


def step_and_stage(checkpoint: Path) -> tuple[int, str]:
    """From the text at the file's head."""
    head = checkpoint.read_bytes()[:512].decode("utf-8", "replace")
    return int(re.search(r"^step (\d+)$", head, re.M).group(1)), re.search(r"^stage \d+ (.*)$", head, re.M).group(1)


def expect_same_run(folder: Path, reference: Path, what: str) -> None:
    """The tables, and the states at the ends of stages and of the run, to the bit."""
    tables = ["history.csv", "produced.csv"] + [path.name for path in reference.glob("probe-*.csv")]
    ends = [path.name for path in checkpoints(reference) if b"\nstage_end 1\n" in path.read_bytes()[:512]]
    expect(len(ends) > 0, f"{reference} has the end of a stage")
    for name in tables + ends:
        path = folder / name
        same = path.exists() and path.read_bytes() == (reference / name).read_bytes()
        expect(same, f"{what}: {name} is not that of the uninterrupted run")


def expect_sound_series(folder: Path) -> None:
    """No list names a piece that is not there."""
    for series in folder.glob("*.pvd"):
        text = series.read_text()
        expect(text.endswith("</VTKFile>\n"), f"{series} is whole")
        for piece in re.findall(r'file="([^"]+)"', text):
            expect((folder / piece).exists(), f"{series} lists {piece}, which is not there")


def with_checkpoints(scene: Path, folder: Path, interval: float) -> Path:
    """A copy of the scene in the folder, with checkpoints every so many seconds in all of its stages."""
    text = re.sub(r"(?m)^checkpoint_interval = .*$", "", scene.read_text())
    copy = folder / scene.name
    copy.write_text(text.replace("\n[output]\n", f"\n[output]\ncheckpoint_interval = {interval}\n"))
    return copy
