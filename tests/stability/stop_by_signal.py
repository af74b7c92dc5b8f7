# SPDX-License-Identifier: MIT
"""stop_by_signal.py PROGRAM SCENE: SIGTERM and SIGINT end a run soundly: it writes a checkpoint, says how to go on, and the run
that goes on ends as the one that was left alone."""

import random
import shlex
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent.parent / "runs"))
from program import Arenite, expect, expect_same_run, finish


def signalled(process, number, seconds: float) -> str:
    try:
        process.wait(seconds)
    except Exception:  # still running
        for _ in range(2):  # timeout(1) signals the process and then its group
            process.send_signal(number)
    out, err = process.communicate()
    return out + err


def main() -> None:
    program, scene = Arenite(sys.argv[1]), Path(sys.argv[2])
    choice = random.Random(3)
    with tempfile.TemporaryDirectory() as name:
        reference, folder = Path(name) / "whole", Path(name) / "stopped"
        begin = time.monotonic()
        program.run(scene, reference)
        whole_time = time.monotonic() - begin
        number, stops = signal.SIGTERM, 0
        process = program.start(scene, folder)
        while True:
            said = signalled(process, number, whole_time * choice.uniform(0.1, 0.25))
            if process.returncode == 0:
                break
            stops += 1
            expect(process.returncode == 128 + number, f"exit code {process.returncode}, not {128 + number}: {said[-300:]}")
            expect(said.count("\n") - said.count("warning:") <= 1 and "stopped by " + signal.Signals(number).name in said, f"says: {said}")
            command = said[said.find("to go on: arenite ") + 18 :].strip()
            number = signal.SIGINT if number == signal.SIGTERM else signal.SIGTERM
            process = subprocess.Popen([program.program, *shlex.split(command), "--quiet"], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                       text=True, env=program.environment)
        expect(stops >= 3, f"only {stops} signals came in time")
        expect_same_run(folder, reference, f"after {stops} signals")
    finish()


main()
