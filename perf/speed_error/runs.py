# SPDX-License-Identifier: MIT
"""Runs of the program on one thread, each with its cost, and what their histories hold.

A run that is already in the folder, made by the same program with the same arguments, is taken as it is: a ladder that
was stopped goes on, and the page can be written again without running anything.
"""
import csv
import dataclasses
import json
import os
import pathlib
import shutil
import subprocess

HERE = pathlib.Path(__file__).resolve().parent
SCENES = HERE.parents[1] / "scenes"


@dataclasses.dataclass
class Run:
    folder: pathlib.Path
    cpu_seconds: float  # of the whole process

    def summary(self):
        return json.loads((self.folder / "summary.json").read_text())

    def history(self, stage):
        """Rows of history.csv of one stage: column name to list of numbers (None where a cell is empty)."""
        with open(self.folder / "history.csv", newline="") as file:
            rows = [row for row in csv.DictReader(file) if row["stage"] == stage]
        return {name: [float(row[name]) if row[name] else None for row in rows] for name in rows[0] if name != "stage"}

    def last_checkpoint(self):
        return sorted(self.folder.glob("checkpoint-*.h5"))[-1]

    def grain_steps(self):
        """Steps of each stage times the grains at its end."""
        return sum(stage["steps"] * stage["end_state"]["grains"] for stage in self.summary()["stages"])


class Runs:
    def __init__(self, program, folder, make=True):
        """Without `make`, a run that is not in the folder is None."""
        self.make = make
        self.program = str(pathlib.Path(program).resolve())
        self.folder = pathlib.Path(folder).resolve()
        self.folder.mkdir(parents=True, exist_ok=True)
        info = subprocess.run([self.program, "info"], capture_output=True, text=True, check=True).stdout
        self.version = info.splitlines()[0]

    def scene(self, name, scene, settings, resume=None, until=None):
        """`arenite run` of a scene with overrides {key: value}, from a checkpoint or from the start."""
        folder = self.folder / name
        arguments = ["run", str(scene), "-o", str(folder)]
        if resume: arguments += ["--resume", str(resume)]
        if until: arguments += ["--until", until]
        for key, value in settings.items(): arguments += ["--set", f"{key}={value}"]
        return self._run(folder, arguments, scene)

    def bench(self, name, pack, *arguments):
        """The JSON of `arenite bench` on a file of grains, and the run."""
        run = self._run(self.folder / name, ["bench", "--pack", str(pack), *arguments], pack)
        return json.loads((run.folder / "log.txt").read_text()), run

    def cpu_seconds(self):
        """Of all runs in the folder that this program made."""
        costs = [json.loads(path.read_text()) for path in self.folder.glob("*/cost.json")]
        return sum(cost["cpu_seconds"] for cost in costs if cost["version"] == self.version)

    def _run(self, folder, arguments, scene):
        made_of = {"version": self.version, "arguments": arguments, "scene": pathlib.Path(scene).read_text()}
        try:
            kept = json.loads((folder / "cost.json").read_text())
            if all(kept[key] == value for key, value in made_of.items()): return Run(folder, kept["cpu_seconds"])
        except (OSError, ValueError, KeyError):
            pass
        if not self.make: return None
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        before = os.times()
        done = subprocess.run([self.program, *arguments], capture_output=True, text=True,
                              env=os.environ | {"OMP_NUM_THREADS": "1"})
        after = os.times()
        if done.returncode: raise SystemExit(f"{' '.join(arguments)}:\n{done.stdout}{done.stderr}")
        cpu = after.children_user + after.children_system - before.children_user - before.children_system
        print(f"{cpu:8.1f} s  {folder.name}", flush=True)
        (folder / "log.txt").write_text(done.stdout)
        (folder / "cost.json").write_text(json.dumps(made_of | {"cpu_seconds": cpu}))
        return Run(folder, cpu)
