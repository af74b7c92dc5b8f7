# SPDX-License-Identifier: MIT
"""The 3-D pictures on axes in mm: bonds during the perforation (fig 6), fluid and grains during the production (fig 9).

Which states are shown is decided here; `render` draws them in a process of its own, started before the curves are drawn.
"""

from __future__ import annotations

import importlib.util
import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Colormap, Normalize

from . import numbers, palette
from .figure import Figure, as_png
from .run_folder import Frame, Run, nearest

SHARES_OF_PERFORATION = (0.0, 0.5, 1.0)
# Tried in turn: without a display VTK's own choice is no good everywhere. EGL is Mesa or a GPU, OSMesa pure software.
OPENGL_WINDOWS = ("vtkEGLRenderWindow", "vtkOSOpenGLRenderWindow", "")
NEAR_ENOUGH = 0.2  # of the depth, between a state and what it stands for
PATIENCE = 300  # s for all pictures


class Pictures:
    """Starts drawing when it is made; `figures` waits for it. `problem` says why there are none, where there are none."""

    def __init__(self, runs: list[Run]):
        self.runs = runs
        self.problem = ""
        self.notes: list[str] = []
        self._scratch = tempfile.TemporaryDirectory(prefix="arenite-report-")
        self._job = Path(self._scratch.name) / "job.json"
        self._process: subprocess.Popen[str] | None = None
        self.chosen = [picture for run in runs for picture in (*self._bond_pictures(run), *self._flow_pictures(run))]
        if not self.chosen:
            self.problem = "no states of grains or fluid to show"
        elif importlib.util.find_spec("pyvista") is None:
            self.problem = "PyVista is not installed for this Python"
        else:
            self._job.write_text(json.dumps(self.chosen), encoding="utf-8")
            self._process = self._start(OPENGL_WINDOWS[0])

    def _start(self, window: str) -> subprocess.Popen[str]:
        environment = {**os.environ, "PYTHONPATH": str(Path(__file__).parents[1]), "PYVISTA_OFF_SCREEN": "true"}
        if window:
            environment.setdefault("VTK_DEFAULT_OPENGL_WINDOW", window)
        return subprocess.Popen([sys.executable, "-B", "-W", "ignore", "-m", f"{__package__}.render", str(self._job)],
                                env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)

    def drawn(self) -> dict[str, Any]:
        """What each picture shows; empty, with a problem set, where no way of drawing works."""
        if self._process is None:
            return {}
        for window in OPENGL_WINDOWS:
            process, self._process = self._process or self._start(window), None
            try:
                errors = process.communicate(timeout=PATIENCE)[1]
            except subprocess.TimeoutExpired:
                process.kill()
                process.communicate()
                self.problem = f"drawing took longer than {PATIENCE} s"
                return {}
            result = self._job.with_name("drawn.json")
            if process.returncode == 0 and result.is_file():
                self.problem = ""
                return json.loads(result.read_text(encoding="utf-8"))
            lines = [line for line in re.sub(r"\x1b\[[0-9;]*m", "", errors).splitlines() if line.strip()]
            self.problem = f"PyVista could not draw without a display: {lines[-1] if lines else f'status {process.returncode}'}"
        return {}

    def figures(self) -> list[Figure]:
        drawn = self.drawn()
        figures = [self._bonds_figure(drawn), self._speed_figure(drawn, "fluid_speed"), self._speed_figure(drawn, "grain_speed")]
        self._scratch.cleanup()
        return [figure for figure in figures if figure]

    # -- which states

    def _picture(self, run: Run, kind: str, frame: Frame, title: str, **more: Any) -> dict[str, Any]:
        section = run.scene.section()
        domain = run.scene.data.get("domain", {})
        lateral = [float(domain[key][section.lateral]) for key in ("lower", "upper")] if domain else None
        walls = nearest(run.series["walls"], frame.time)
        same_time = walls is not None and abs(walls.time - frame.time) <= 1e-9 + 1e-6 * frame.time
        rod = run.scene.rod()
        return {"name": f"{kind}-{self.runs.index(run)}-{frame.path.stem}",
                "kind": kind, "run": run.name, "title": title, "time": frame.time, "lateral": lateral,
                "section": {"centre": list(map(float, section.centre)), "up": section.up, "lateral": section.lateral,
                            "normal": section.normal},
                "walls": str(walls.path) if same_time else None,
                "rod": run.scene.wall_row(rod["wall"]) if rod else None, **more}

    def _bond_pictures(self, run: Run) -> list[dict[str, Any]]:
        stage = run.scene.perforation()["name"]
        frames = run.frames_in("particles", run.span_of(stage))
        if not frames:
            return []
        shares = np.array(rod_shares(run, frames))
        chosen: dict[float, Frame] = {}
        for wanted in SHARES_OF_PERFORATION:
            best = int(np.argmin(np.abs(shares - wanted)))
            if abs(shares[best] - wanted) > NEAR_ENOUGH and wanted == 1:
                best = len(frames) - 1  # the hole after the rod has left says more than half a hole
            if abs(shares[best] - wanted) <= NEAR_ENOUGH or wanted == 1:
                chosen.setdefault(float(shares[best]), frames[best])
        if len(chosen) < len(SHARES_OF_PERFORATION):
            self.notes.append(f"{run.name}: no states of grains at all of 0, 50 and 100 % of the perforation; a field_interval in stage "
                              f"\"{stage}\" of the scene gives them")
        return [self._picture(run, "bonds", frame, _rod_title(share), particles=str(frame.path)) for share, frame in sorted(chosen.items())]

    def _flow_pictures(self, run: Run) -> list[dict[str, Any]]:
        span = run.span_of(run.scene.production()["name"])
        pictures: dict[tuple[str, str], dict[str, Any]] = {}
        for series, kind in (("fluid", "fluid_speed"), ("particles", "grain_speed")):
            for frame in self._flow_frames(run, series, span):
                title = f"{(frame.time - (span[0] if span else 0)) * 1e3:.4g} ms"
                more = {series: str(frame.path)}
                if series == "fluid":
                    lines = nearest(run.series["streamlines"], frame.time)
                    more["streamlines"] = str(lines.path) if lines and abs(lines.time - frame.time) < 1e-9 else None
                pictures.setdefault((kind, title), self._picture(run, kind, frame, title, **more))
        return list(pictures.values())

    def _flow_frames(self, run: Run, series: str, span: tuple[float, float] | None) -> list[Frame]:
        """Nearest to the paper's times; without a production the first, the middle and the last state of all."""
        if span is None:
            frames = run.series[series]
            return [frames[row] for row in sorted({0, len(frames) // 2, len(frames) - 1})] if frames else []
        frames = [frame for frame in run.frames_in(series, span) if frame.time > span[0]]
        return [frame for moment in numbers.moments(self.runs)[0] if (frame := nearest(frames, span[0] + moment))]

    # -- how they are set

    def _grid(self, kind: str, drawn: dict[str, Any]) -> tuple[plt.Figure, dict[str, list[dict[str, Any]]], list[plt.Axes]] | None:
        """One row of axes for each run that has pictures of the kind, with the pictures in them."""
        rows: dict[str, list[dict[str, Any]]] = {}
        for picture in self.chosen:
            if picture["kind"] == kind and picture["name"] in drawn:
                rows.setdefault(picture["run"], []).append(picture)
        if not rows:
            return None
        columns = max(len(pictures) for pictures in rows.values())
        aspects = [max(_aspect(drawn[picture["name"]]["extent"]) for picture in pictures) for pictures in rows.values()]
        wide = min(9.2 / max(columns, 2), 4.6 / max(aspects))  # in, of a picture
        size = ((wide + 0.25) * columns + 1.7, sum(wide * aspect + 0.35 for aspect in aspects) + 0.4)
        canvas, grid = plt.subplots(len(rows), columns, squeeze=False, sharey="row", figsize=size, height_ratios=aspects,
                                    layout="compressed")  # for axes of a fixed aspect: "constrained" cuts their titles
        used = []
        labels = {run.name: run.label for run in self.runs}
        for (name, pictures), line in zip(rows.items(), grid):
            for axes in line[len(pictures):]:
                axes.set_visible(False)
            for picture, axes in zip(pictures, line):
                self._set(axes, picture, drawn[picture["name"]])
                used.append(axes)
            if len(rows) > 1:
                line[0].set_ylabel(f"{labels[name]}\n{line[0].get_ylabel()}")
        return canvas, rows, used

    def _set(self, axes: plt.Axes, picture: dict[str, Any], result: dict[str, Any]) -> None:
        section = picture["section"]
        axes.imshow(plt.imread(result["file"]), extent=[value * 1e3 for value in result["extent"]], interpolation="antialiased")
        axes.set_title(picture["title"])
        axes.set_xlabel(f"{'xyz'[section['lateral']]} [mm]")
        if axes.get_subplotspec().is_first_col():
            axes.set_ylabel(f"{'xyz'[section['up']]} [mm]")
        axes.grid(False)

    def _rows_for_csv(self, rows: dict[str, list[dict[str, Any]]]) -> list[list[Any]]:
        return [[name, picture["title"], float(picture["time"]), Path(picture.get("fluid") or picture["particles"]).name]
                for name, pictures in rows.items() for picture in pictures]

    def _bonds_figure(self, drawn: dict[str, Any]) -> Figure | None:
        grid = self._grid("bonds", drawn)
        if grid is None:
            return None
        canvas, rows, used = grid
        bar = canvas.colorbar(ScalarMappable(Normalize(0, 5), palette.BOND_COLOURS), ax=used, ticks=np.arange(5) + 0.5, fraction=0.05, pad=0.015)
        bar.ax.set_yticklabels(palette.BOND_LABELS)
        bar.set_label("bonds of a grain")
        return Figure("figure-6-bonds", "Bonds during the perforation (paper's fig 6)",
                      "Section through the axis; titles: depth of the rod over its deepest. Grains behind the plane are seen as spheres, those "
                      "that it cuts as discs; what lies before it is left out.",
                      as_png(canvas), ["run", "share", "time_s", "state"], self._rows_for_csv(rows))

    def _speed_figure(self, drawn: dict[str, Any], kind: str) -> Figure | None:
        grid = self._grid(kind, drawn)
        if grid is None:
            return None
        canvas, rows, used = grid
        highest = max(drawn[picture["name"]]["highest"] for pictures in rows.values() for picture in pictures)
        fluid = kind == "fluid_speed"
        colours: Colormap = palette.FLUID_SPEED_COLOURS if fluid else palette.GRAIN_SPEED_COLOURS
        norm = palette.speed_norm(highest, palette.FLUID_DECADES if fluid else palette.GRAIN_DECADES)
        bar = canvas.colorbar(ScalarMappable(norm, colours), ax=used, fraction=0.05, pad=0.015, extend="both")
        bar.set_label("fluid speed [m/s]" if fluid else "grain speed [m/s]")
        produced = any(run.span_of(run.scene.production()["name"]) for run in self.runs)
        which = f"Times since the production began: the states nearest to {numbers.moments(self.runs)[1]}." if produced else \
            "First, middle and last state of the run."
        if fluid:
            return Figure("figure-9-fluid", "Fluid speed and streamlines (paper's fig 9)",
                          f"In the plane through the axis, with streamlines. {which}",
                          as_png(canvas), ["run", "shown", "time_s", "state"], self._rows_for_csv(rows))
        return Figure("figure-9-grains", "Grain speed (paper's fig 9)", f"Half section through the axis. {which}",
                      as_png(canvas), ["run", "shown", "time_s", "state"], self._rows_for_csv(rows))


def _aspect(extent: list[float]) -> float:
    return (extent[3] - extent[2]) / (extent[1] - extent[0])


def rod_shares(run: Run, frames: list[Frame]) -> list[float]:
    """Depth of the rod over its deepest, at each state: from the stage's travel, speed and ramp; time's share without them."""
    start, end = run.span_of(run.scene.perforation()["name"])
    times = np.array([frame.time - start for frame in frames])
    rod = run.scene.rod()
    if not rod or not rod.get("velocity"):
        return list(times / max(end - start, 1e-300))
    travel, speed = float(rod["travel"]), float(np.linalg.norm(rod["velocity"]))
    ramp = float(rod.get("ramp_time", 0) or 0)
    way = np.array([_way(time, speed, ramp, travel) for time in times])
    if not rod.get("and_back"):
        return list(way)
    there = travel / speed + ramp
    back = np.array([_way(max(time - there, 0.0), speed, ramp, travel) for time in times])
    # On the way out the hole is whole: those states count as beyond 100 %, so that the deepest is taken.
    return list(np.where(times <= there, way, 1 + back))


def _rod_title(share: float) -> str:
    """Shares above one are the way out."""
    return f"{100 * share:.0f} % of the depth" if share <= 1.01 else "rod out again" if share >= 1.99 else "rod on its way out"


def _way(time: float, speed: float, ramp: float, travel: float) -> float:
    """Share of the travel made: speed rises over the ramp, stays, and falls over another."""
    total = travel / speed + ramp
    if ramp <= 0 or time >= total:
        return min(1.0, speed * time / travel)
    if time < ramp:
        return speed * time * time / (2 * ramp) / travel
    if time > total - ramp:
        return 1 - speed * (total - time) ** 2 / (2 * ramp) / travel
    return speed * (time - ramp / 2) / travel
