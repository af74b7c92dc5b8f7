# SPDX-License-Identifier: MIT
"""whole_runs.py CASE PROGRAM SCENES: whole runs of small scenes give the same bits
  threads    with 1, 2 and 4 threads; a run of all four stages is begun with one and goes on with others (H18),
  restarts   stopped and resumed at odd steps, three in every stage (H17),
  periodic   the same in a box that is periodic, deforms and lets grains out, where the time of a search shows in the bits,
  output     whatever is written and however often (no balance, other intervals): the grains themselves."""

import json
import shutil
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent.parent / "runs"))
from program import Arenite, checkpoints, expect, expect_same_run, finish, step_and_stage


def stops_in_every_stage(folder: Path) -> list[float]:
    """Three times in each of the run's stages, no multiples of anything: s."""
    times, start = [], 0.0
    for stage in json.loads((folder / "summary.json").read_text())["stages"]:
        step = stage["values"]["time_step_s"]
        for share in (0.13, 0.37, 0.71):
            times.append(start + (int(share * stage["steps"] / 100) * 100 + 43 - 0.5) * step)
        start += stage["simulated_time"]
    return times


def check_restarts(program: Arenite, scene: Path, scratch: Path) -> None:
    reference, folder = scratch / "whole", scratch / "stopped"
    program.run(scene, reference)
    stops, resume = stops_in_every_stage(reference), []
    for time in stops:
        program.run(scene, folder, "--until", repr(time), *resume)
        resume = ["--resume"]
    program.run(scene, folder, *resume)
    expect_same_run(folder, reference, f"with {len(stops)} stops")


def check_threads(program: str, scenes: Path, scratch: Path) -> None:
    """Every stage is there, but short: where another program has the core, a step waits for it at every kernel."""
    short = ["--set", "stages.stir.duration=1e-3", "--set", "stages.drain.duration=1.5e-3"]
    for threads in (1, 2, 4):
        Arenite(program, threads).run(scenes / "periodic.toml", scratch / str(threads), *short)
        expect_same_run(scratch / str(threads), scratch / "1", f"with {threads} threads")
    rows = (scratch / "1" / "produced.csv").read_text().splitlines()
    expect(len(rows) > 3, f"only {len(rows) - 1} grains left through the drain")
    short = ["--set", "stages.perforation.walls.penetrometer.travel=2e-3", "--set", "stages.production.duration=5e-5"]
    reference = scratch / "small"
    Arenite(program, 1).run(scenes / "small.toml", reference, *short)
    pressed = next(path for path in checkpoints(reference) if step_and_stage(path)[1] == "compression/relax")
    for threads in (2, 4):
        folder = scratch / f"small-{threads}"
        shutil.copytree(reference, folder)
        Arenite(program, threads).run(scenes / "small.toml", folder, *short, "--resume", str(folder / pressed.name))
        expect_same_run(folder, reference, f"bonds and water with {threads} threads")


def check_output(program: Arenite, scene: Path, scratch: Path) -> None:
    """Rows of the history at times that both runs write are equal, and so is what was produced."""
    program.run(scene, scratch / "often")
    often = scratch / "often" / "probe-grain.csv"
    rarely = ["--set", "output.history_interval=2e-4", "--set", "output.field_interval=2.7e-4", "--set", "output.checkpoint_interval=1.9e-4"]
    program.run(scene, scratch / "rarely", *rarely)
    program.run(scene, scratch / "balanced", *rarely, "--set", "output.energies=true")
    lines = set(often.read_text().splitlines())
    for folder in (scratch / "rarely", scratch / "balanced"):
        rows = (folder / "probe-grain.csv").read_text().splitlines()
        shared = [row for row in rows if row in lines]
        expect(len(rows) > 30 and shared == rows, f"{folder.name}: only {len(shared)} of {len(rows)} rows are those of the other run")
        expect((folder / "produced.csv").read_bytes() == (scratch / "often" / "produced.csv").read_bytes(), f"{folder.name}: other grains left")


def main() -> None:
    case, program, scenes = sys.argv[1], sys.argv[2], Path(sys.argv[3])
    with tempfile.TemporaryDirectory() as name:
        scratch = Path(name)
        if case == "threads":
            check_threads(program, scenes, scratch)
        elif case == "restarts":
            check_restarts(Arenite(program), scenes / "small.toml", scratch)
        elif case == "periodic":
            check_restarts(Arenite(program), scenes / "periodic.toml", scratch)
        elif case == "output":
            check_output(Arenite(program), scenes / "periodic.toml", scratch)
    finish()


main()
