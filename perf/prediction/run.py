#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What `arenite check` says that a scene will take, and what it takes, with the share of searches: stage by stage, for the demo
and for pieces of the paper's SSW scene (its first stages whole, 0.2 ms each of the perforation and the production). Writes
prediction.csv; fails where the whole of a scene is off by more than 30 %."""

from __future__ import annotations

import argparse
import json
import re
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import measure  # noqa: E402

SCENES = {"demo": ("scenes/demo.toml", []),
          "ssw": ("scenes/paper/ssw.toml", ["stages.perforation.duration=2e-4", "stages.production.duration=2e-4"])}
TOLERANCE = 0.3
UNITS = {"d": 86400, "h": 3600, "min": 60, "s": 1}


def seconds_of(text: str) -> float:
    """"1 h 02 min" or "4.5 s" in seconds."""
    return sum(float(number) * UNITS[unit] for number, unit in re.findall(r"([0-9.]+) (d|h|min|s)\b", text))


def predict(program: Path, scene: str, overrides: list[str], environment: dict) -> dict[str, tuple[float, float]]:
    """Steps and seconds of each stage, by its label."""
    run = subprocess.run([program, "check", measure.ROOT / scene, *overrides], env=environment, capture_output=True, text=True,
                         check=True)
    line = r"^  (\S+): dt \S+ s, (?:about|at most) (\S+) steps.*?: ([0-9.]+ (?:d|h|min|s)\b[0-9 a-z]*)"
    stages = re.findall(line, run.stdout, re.MULTILINE)
    return {label: (float(steps), seconds_of(time)) for label, steps, time in stages}


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--arenite", type=Path, default=measure.DEFAULT_PROGRAM, help="the program under test")
    parser.add_argument("--scenes", nargs="+", default=list(SCENES), choices=SCENES)
    parser.add_argument("--threads", type=int, default=measure.cores())
    arguments = parser.parse_args()
    environment = measure.environment_of(arguments.threads)
    rows, wrong = [], []
    for name in arguments.scenes:
        scene, settings = SCENES[name]
        overrides = [word for setting in settings for word in ("--set", setting)]
        expected = predict(arguments.arenite, scene, overrides, environment)
        output = measure.ROOT / f"build/prediction/{name}"
        output.parent.mkdir(parents=True, exist_ok=True)
        run = [arguments.arenite, "run", measure.ROOT / scene, "-o", output, "--quiet", *overrides]
        subprocess.run(run, env=environment, check=True)
        done = {stage["name"]: stage for stage in json.loads((output / "summary.json").read_text())["stages"]}
        stages = [label for label in expected if label in done]
        for label in stages:
            steps, seconds = expected[label]
            stage = done[label]
            rows.append([name, label, arguments.threads, int(steps), stage["steps"], seconds, stage["wall_time"],
                         seconds / stage["wall_time"], stage["values"]["search_time_s"] / stage["wall_time"]])
        whole = sum(expected[label][1] for label in stages), sum(done[label]["wall_time"] for label in stages)
        searching = sum(done[label]["values"]["search_time_s"] for label in stages)
        rows.append([name, "all", arguments.threads, "", "", *whole, whole[0] / whole[1], searching / whole[1]])
        print(f"{name}: {whole[0]:.1f} s expected, {whole[1]:.1f} s taken", flush=True)
        if abs(whole[0] / whole[1] - 1) > TOLERANCE:
            wrong.append(f"{name}: {whole[0]:.1f} s expected, {whole[1]:.1f} s taken")
    head = measure.header(measure.program_info(arguments.arenite),
                          *(f"{name}: {SCENES[name][0]} {' '.join(SCENES[name][1])}" for name in arguments.scenes))
    measure.write_table(measure.results_folder() / "prediction.csv", head,
                        ["scene", "stage", "threads", "expected_steps", "steps", "expected_s", "measured_s",
                         "expected_over_measured", "search_share"], rows)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
