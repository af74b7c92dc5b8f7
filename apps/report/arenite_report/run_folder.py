# SPDX-License-Identifier: MIT
"""What a run folder holds. Anything may be missing or cut short; what is, is said in `missing`, and the rest is used."""

from __future__ import annotations

import json
import tomllib
import xml.etree.ElementTree as xml
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from .scene import Scene, part_of
from .table import Table, read_table


@dataclass(frozen=True)
class Frame:
    """One state of a series."""

    time: float  # s
    path: Path


@dataclass
class Run:
    folder: Path
    name: str
    scene: Scene = field(default_factory=Scene)
    scene_text: str = ""
    summary: dict[str, Any] = field(default_factory=dict)
    history: Table = field(default_factory=lambda: Table({}))
    produced: Table | None = None
    series: dict[str, list[Frame]] = field(default_factory=dict)
    missing: list[str] = field(default_factory=list)

    @property
    def label(self) -> str:
        """For legends: the folder's name and how the grains were made coarser."""
        return self.name if self.scene.scheme == "none" else f"{self.name} ({self.scene.scheme.upper()}, k = {self.scene.factor:g})"

    @property
    def finished(self) -> bool:
        return self.summary.get("outcome") == "done"

    @property
    def outcome(self) -> str:
        outcome = self.summary.get("outcome")
        if outcome is None:
            return "no end known (still going, or killed)"
        if outcome == "running":
            stages = self.summary.get("stages", [])
            return f"still going or killed; {stages[-1]['name']} had ended" if stages else "still going or killed"
        return str(outcome)

    def rows_of(self, stage_name: str) -> np.ndarray:
        """Rows of the history that belong to a stage and its parts."""
        labels = self.history.texts("stage") if "stage" in self.history else []
        return np.array([row for row, label in enumerate(labels) if part_of(label, stage_name)], dtype=int)

    def span_of(self, stage_name: str) -> tuple[float, float] | None:
        """First and last time of a stage that the history knows, in s."""
        rows = self.rows_of(stage_name)
        if rows.size == 0:
            return None
        times = self.history.numbers("time")
        start = times[rows[0] - 1] if rows[0] > 0 else times[rows[0]]  # a stage begins where the one before ended
        return float(start), float(times[rows[-1]])

    def stage_summaries(self, stage_name: str) -> list[dict[str, Any]]:
        return [stage for stage in self.summary.get("stages", []) if part_of(str(stage.get("name", "")), stage_name)]

    def frames_in(self, series: str, span: tuple[float, float] | None) -> list[Frame]:
        if span is None:
            return []
        slack = 1e-9 + 1e-6 * abs(span[1])
        return [frame for frame in self.series.get(series, []) if span[0] - slack <= frame.time <= span[1] + slack]


def nearest(frames: list[Frame], time: float) -> Frame | None:
    return min(frames, key=lambda frame: abs(frame.time - time), default=None)


def read_runs(folders: list[Path]) -> list[Run]:
    """One run for each folder, with names that tell them apart."""
    resolved = [folder.resolve() for folder in folders]
    names = [folder.name for folder in resolved]
    if len(set(names)) < len(names):
        names = [f"{folder.parent.name}/{folder.name}" for folder in resolved]
    if len(set(names)) < len(names):
        names = [str(folder) for folder in folders]
    return [read_run(folder, name) for folder, name in zip(folders, names)]


PARTS = ("scene.toml", "summary.json", "history.csv", "produced.csv", "particles.pvd", "fluid.pvd")


def holds_a_run(folder: Path) -> bool:
    return any((folder / part).is_file() for part in PARTS)


def read_run(folder: Path, name: str) -> Run:
    run = Run(folder, name)
    _read_scene(run)
    _read_summary(run)
    run.history = _read_csv(run, "history.csv", "no curves over time") or Table({})
    run.produced = _read_csv(run, "produced.csv", "no sizes of what was produced")
    for series in ("particles", "walls", "fluid", "streamlines"):
        run.series[series] = _read_series(run, series)
    return run


def _read_scene(run: Run) -> None:
    try:
        run.scene_text = (run.folder / "scene.toml").read_text(encoding="utf-8")
        run.scene = Scene(tomllib.loads(run.scene_text))
    except (OSError, ValueError) as error:  # tomllib's error is a ValueError
        run.missing.append(f"scene.toml: {_reason(error)}; sizes, classes and the stages' roles are guessed")


def _read_summary(run: Run) -> None:
    try:
        run.summary = json.loads((run.folder / "summary.json").read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        run.missing.append(f"summary.json: {_reason(error)}; no wall times, warnings, versions and hardware")


def _read_csv(run: Run, name: str, lost: str) -> Table | None:
    try:
        table = read_table(run.folder / name)
    except (OSError, ValueError) as error:
        run.missing.append(f"{name}: {_reason(error)}; {lost}")
        return None
    if table.cut_rows:
        run.missing.append(f"{name}: {table.cut_rows} row{'s' if table.cut_rows > 1 else ''} cut short, left out")
    return table


def _read_series(run: Run, name: str) -> list[Frame]:
    path = run.folder / f"{name}.pvd"
    try:
        root = xml.parse(path).getroot()
    except (OSError, xml.ParseError) as error:
        wet = any(stage.get("fluid") and run.rows_of(stage["name"]).size for stage in run.scene.stages)
        if wet or (name == "particles" and run.scene.data.get("particles", {}).get("source") != "none"):
            run.missing.append(f"{path.name}: {_reason(error)}; pictures that show it are left out")
        return []
    frames = [Frame(float(item.get("timestep", "nan")), run.folder / item.get("file", "")) for item in root.iter("DataSet")]
    there = [frame for frame in frames if frame.path.is_file()]
    if len(there) < len(frames):
        run.missing.append(f"{path.name}: {len(frames) - len(there)} of its {len(frames)} files are not there")
    return there


def _reason(error: Exception) -> str:
    return "not there" if isinstance(error, FileNotFoundError) else f"cannot be read ({getattr(error, 'strerror', None) or error})"
