# SPDX-License-Identifier: MIT
"""Puts a report together: what goes where, and the files beside it."""

from __future__ import annotations

import os
import shutil
from dataclasses import dataclass, field
from datetime import datetime
from pathlib import Path
from typing import Any, Callable

from . import figures_history, figures_production, figures_speed, numbers, page, tables
from .figure import Figure
from .figures_production import Measured
from .figures_speed import Timing
from .pictures import Pictures
from .run_folder import Run, read_runs


@dataclass
class Request:
    folders: list[Path]
    page: Path  # report.html
    reference: Path | None = None  # of the folders: the original
    measured: list[Measured] = field(default_factory=list)
    timings: list[Timing] = field(default_factory=list)
    scaling_source: str = ""


def write_report(request: Request) -> list[str]:
    """Writes the page and the files beside it; returns what is missing, for the terminal."""
    runs = read_runs(request.folders)
    pictures = Pictures(runs)  # draws while the curves are drawn here
    curves = [numbers.production_curve(run) for run in runs]
    original = _original(runs, request)
    timings, timed_case, source = _timings(runs, request, original)

    faults: list[str] = []

    def tried(draw: Callable[..., Figure | None], *with_these: Any) -> list[Figure]:
        """One figure that some odd folder makes impossible must not cost the others."""
        try:
            drawn_figure = draw(*with_these)
            return [drawn_figure] if drawn_figure else []
        except Exception as error:  # noqa: BLE001 - whatever it is, it is said
            faults.append(f"figure {draw.__name__.replace('_', ' ')} could not be drawn: {type(error).__name__}: {error}")
            return []

    mass = [*tried(figures_production.produced_mass, runs, curves), *tried(figures_production.dimensionless, runs, curves, request.measured)]
    classes = tried(figures_production.mass_by_class, runs)
    history = [figure for draw in (figures_history.bonds, figures_history.energies, figures_history.momenta, figures_history.wall_load)
               for figure in tried(draw, runs)]
    health = tried(figures_history.margins, runs)
    speed = tried(figures_speed.scaling, timings, timed_case, source)
    views = pictures.figures()

    files = request.page.with_name(request.page.stem)
    missing = [f"{run.name}: {line}" if len(runs) > 1 else line for run in runs for line in run.missing]
    if pictures.problem:
        missing.append(f"pictures of grains and fluid are left out: {pictures.problem}")
    missing += pictures.notes + faults

    def drawn(figures: list[Figure]) -> str:
        return "".join(page.figure(figure, files.name) for figure in figures)

    def of_view(prefix: str) -> str:
        return drawn([view for view in views if view.name.startswith(prefix)])

    per_run = "" if len(runs) == 1 else "<h3>{}</h3>"
    errors = page.table(figures_production.error_table(runs, curves, original, request.measured))
    text = page.page(_title(runs), _subtitle(runs), [
        page.section("summary", "Summary", page.table(tables.headline(runs, curves), "headline"),
                     page.notes("What is missing or was left out", missing)),
        page.section("production", "Production", drawn(mass),
                     "<h3>Error of each case (eq 41 with its square)</h3>" + errors if errors else "", drawn(classes)),
        page.section("perforation", "Perforation", of_view("figure-6")),
        page.section("flow", "Fluid and grains", of_view("figure-9")),
        page.section("bonds", "Bonds, energy, load", drawn(history[:2]), page.table(tables.energy_budget(runs)), drawn(history[2:])),
        page.section("margins", "Warnings and margins", page.table(tables.warnings(runs)),
                     "" if tables.warnings(runs) or not any(run.summary for run in runs) else "<p>No warnings.</p>",
                     "".join(per_run.format(run.name) + page.table(tables.margins(run)) for run in runs if run.summary), drawn(health)),
        page.section("speed", "Speed", drawn(speed), page.table(figures_speed.speed_up_table(timings, timed_case))),
        page.section("stages", "Stages", "".join(per_run.format(run.name) + page.table(tables.stages(run)) +
                                                 _folded(page.table(tables.other_values(run))) for run in runs if run.summary)),
        page.section("machine", "Versions and hardware", page.table(tables.machines(runs))),
        page.section("scene", "Scene", "".join(page.details(f"{run.name}: every value, defaults filled in", run.scene_text)
                                               for run in runs if run.scene_text)),
    ])
    _store(request, text, [*mass, *classes, *history, *health, *speed, *views], files)
    return missing


def _folded(text: str) -> str:
    return f"<details><summary>other values</summary>{text}</details>" if text else ""


def _title(runs: list[Run]) -> str:
    titles = list(dict.fromkeys(run.scene.title or run.name for run in runs))
    return titles[0] if len(titles) == 1 else "Runs side by side: " + ", ".join(run.name for run in runs)


def _subtitle(runs: list[Run]) -> str:
    return f"{', '.join(str(run.folder) for run in runs)} · written {datetime.now():%Y-%m-%d %H:%M}"


def _original(runs: list[Run], request: Request) -> int | None:
    """The run that others are compared with: the one named, or the only one whose grains are not coarse."""
    if request.reference is not None:
        return next(row for row, folder in enumerate(request.folders) if folder.resolve() == request.reference.resolve())
    fine = [row for row, run in enumerate(runs) if run.scene.data and run.scene.factor == 1]
    return fine[0] if len(fine) == 1 else 0 if len(runs) > 1 else None


def _timings(runs: list[Run], request: Request, original: int | None) -> tuple[list[Timing], str | None, str]:
    if request.timings:
        return request.timings, figures_speed.original_of(request.timings, None), f"From {request.scaling_source}."
    timings = figures_speed.timings_of_runs(runs)
    reference = runs[original].label if original is not None else None
    return timings, figures_speed.original_of(timings, reference), "Wall time of the production in these runs."


def _store(request: Request, text: str, figures: list[Figure], files: Path) -> None:
    files.mkdir(parents=True, exist_ok=True)
    for figure in figures:
        _write(files / f"{figure.name}.png", figure.png)
        _write(files / f"{figure.name}.csv", figure.csv_text().encode())
    script = Path(__file__).with_name("view.py")
    for folder in request.folders:
        if (folder / "particles.pvd").is_file() and os.access(folder, os.W_OK):
            shutil.copyfile(script, folder / "view.py")
    _write(request.page, text.encode("utf-8"))


def _write(path: Path, content: bytes) -> None:
    """Whole or not at all."""
    beside = path.with_name(f".{path.name}.part")
    beside.write_bytes(content)
    beside.replace(path)
