# SPDX-License-Identifier: MIT
"""What the measuring programs of perf/ share: which machine this is, where results go, how a table of them looks, how the
program under test is called. Standard library only."""

from __future__ import annotations

import csv
import datetime
import json
import os
import platform
import re
import resource
import shlex
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
DEFAULT_PROGRAM = ROOT / "build/openmp/apps/arenite"


def cpu_model() -> str:
    try:
        return re.search(r"model name\s*: (.*)", Path("/proc/cpuinfo").read_text()).group(1)
    except (OSError, AttributeError):
        return platform.processor() or platform.machine()


def cores() -> int:
    return len(os.sched_getaffinity(0))


def vector_width() -> str:
    """What an x86 processor without AVX-512 has; a virtual one may not tell more of its model than "AMD EPYC"."""
    try:
        flags = re.search(r"flags\s*: (.*)", Path("/proc/cpuinfo").read_text()).group(1).split()
    except (OSError, AttributeError):
        return ""
    return "avx2" if "avx2" in flags and "avx512f" not in flags else ""


def machine_name() -> str:
    """Name of the machine's folder under perf/results: "AMD EPYC 9654 96-Core Processor" of 8 cores is epyc-9654-8core, an
    "AMD EPYC" of 2 cores without AVX-512 epyc-avx2-2core."""
    words = re.sub(r"\(.*?\)|@.*", " ", cpu_model()).lower().split()
    dull = {"amd", "intel", "cpu", "processor", "with"}
    kept = [word for word in words if word not in dull and not word.endswith("-core")]
    return "-".join(filter(None, [*kept[:3], vector_width(), f"{cores()}core"]))


def results_folder() -> Path:
    folder = ROOT / "perf/results" / machine_name()
    folder.mkdir(parents=True, exist_ok=True)
    return folder


def this_command() -> str:
    """The command line as a user would repeat it: from the root of the tree, without folders of this machine."""
    script = Path(sys.argv[0]).resolve()
    name = script.relative_to(ROOT) if script.is_relative_to(ROOT) else script.name
    arguments, skip = [], False
    for argument in sys.argv[1:]:
        if not skip and argument != "--arenite":
            arguments.append(argument)
        skip = argument == "--arenite"
    return shlex.join([os.environ.get("ARENITE_MEASURED_BY", str(name)), *arguments])


def header(info: dict[str, str], *notes: str) -> list[str]:
    """What stands above a table: date, machine, commit and compiler (of `arenite info`), command, notes."""
    date = datetime.date.today().isoformat()
    machine = ", ".join(filter(None, [cpu_model(), f"{cores()} cores", vector_width().upper()]))
    return [f"{date}; {machine}", f"commit {info['commit']}, {info['compiler']}",
            f"command: {this_command()}", *notes]


def write_table(path: Path, comments: list[str], columns: list[str], rows: list[list]) -> None:
    with open(path, "w", newline="") as file:
        file.writelines(f"# {line}\n" for line in comments)
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows([f"{value:.5g}" if isinstance(value, float) else value for value in row] for row in rows)
    print(f"wrote {path.relative_to(ROOT) if path.is_relative_to(ROOT) else path}", flush=True)


def read_table(path: Path) -> tuple[list[str], list[dict[str, str]]]:
    """The comments and the rows of a table that write_table wrote."""
    lines = path.read_text().splitlines()
    comments = [line[2:] for line in lines if line.startswith("# ")]
    return comments, list(csv.DictReader(line for line in lines if not line.startswith("#")))


def program_info(program: Path) -> dict[str, str]:
    """Commit and compiler as `arenite info` says them."""
    first = subprocess.run([program, "info"], capture_output=True, text=True, check=True).stdout.splitlines()[0]
    version, compiler, build = re.match(r"Arenite \S+ \((\S+)\), (.*), (\w+)", first).groups()
    return {"commit": version, "compiler": f"{compiler}, {build}"}


def environment_of(threads: int) -> dict[str, str]:
    """The environment in which a program of ours runs on that many threads."""
    return {**os.environ, "OMP_NUM_THREADS": str(threads), "OMP_PROC_BIND": "false"}


def bench(program: Path, threads: int, *arguments: object) -> list[dict]:
    """Results of `arenite bench` with the arguments; raises where it fails."""
    command = [str(program), "bench", "--json", *map(str, arguments)]
    run = subprocess.run(command, env=environment_of(threads), capture_output=True, text=True)
    if run.returncode != 0:
        raise RuntimeError(f"{shlex.join(command)} failed:\n{run.stderr}{run.stdout}")
    return [json.loads(line) for line in run.stdout.splitlines() if line.startswith("{")]


class OtherLoad:
    """Cores that other processes kept busy between the construction and cores(): a timing beside them means little."""

    def __init__(self) -> None:
        self._time, self._busy = time.time(), self._others()

    @staticmethod
    def _others() -> float:
        fields = [int(field) for field in Path("/proc/stat").read_text().split("\n", 1)[0].split()[1:9]]
        usages = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
        own = sum(usage.ru_utime + usage.ru_stime for usage in usages)
        idle = fields[3] + fields[4]
        return (sum(fields) - idle) / os.sysconf("SC_CLK_TCK") - own

    def cores(self) -> float:
        return max(0.0, (self._others() - self._busy) / (time.time() - self._time))
