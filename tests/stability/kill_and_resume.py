# SPDX-License-Identifier: MIT
"""kill_and_resume.py PROGRAM SCENE SEED: a run of all stages that is killed (SIGKILL) at 20 random moments and resumed each time ends as
the one that was left alone: the tables and the states at the ends of stages to the bit. After each kill what is there is whole."""

import json
import random
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent.parent / "runs"))
from program import Arenite, checkpoints, expect, expect_same_run, expect_sound_series, finish, step_and_stage, with_checkpoints

KILLS = 20


def wait_for_kill(process, seconds: float) -> str:
    """Kills it then; what it said until then. Nothing is killed that has ended."""
    try:
        process.wait(seconds)
    except Exception:  # still running
        process.kill()
    out, err = process.communicate()
    return out + err


def check_what_is_left(folder: Path) -> None:
    expect_sound_series(folder)
    if (folder / "summary.json").exists():
        json.loads((folder / "summary.json").read_text())


def main() -> None:
    program, seed = Arenite(sys.argv[1]), int(sys.argv[3])
    choice = random.Random(seed)
    with tempfile.TemporaryDirectory() as name:
        scratch = Path(name)
        scene = with_checkpoints(Path(sys.argv[2]), scratch, 1.5e-5)
        reference, folder = scratch / "whole", scratch / "killed"
        begin = time.monotonic()
        program.run(scene, reference)
        whole_time = time.monotonic() - begin
        kills, stages = 0, set()
        while kills < KILLS:
            resume = ["--resume"] if checkpoints(folder) else []
            process = program.start(scene, folder, *resume)
            said = wait_for_kill(process, whole_time * choice.uniform(0.01, 0.12))
            expect("passed over" not in said, f"a kill left a damaged checkpoint: {said}")
            if process.returncode == 0:  # it came to its end: once more from somewhere in the middle
                expect_same_run(folder, reference, f"after {kills} kills")
                process = program.start(scene, folder, "--resume", str(choice.choice(checkpoints(folder)[:-1])))
                wait_for_kill(process, whole_time * choice.uniform(0.01, 0.05))
            expect(process.returncode == -9, f"exit code {process.returncode}, not that of a kill: {said[-300:]}")
            kills += 1
            check_what_is_left(folder)
            last = step_and_stage(checkpoints(folder)[-1]) if checkpoints(folder) else (0, "none")
            stages.add(last[1])
            print(f"kill {kills}: the last checkpoint is of step {last[0]}, {last[1]}", flush=True)
        program.run(scene, folder, *(["--resume"] if checkpoints(folder) else []))
        expect(len(stages) > 2, f"the kills hit the stages {sorted(stages)}")
        expect_same_run(folder, reference, f"after {KILLS} kills")
        expect(not list(folder.rglob("*.unfinished")), "a half-written file is still there")
    finish()


main()
