# SPDX-License-Identifier: MIT
"""The report's tables, as rows of text with a header row. A dash is a value that the folder does not have."""

from __future__ import annotations

from typing import Any, Callable

import numpy as np

from . import numbers
from .figures_history import ENERGY_COLUMN, WORK_COLUMN
from .numbers import Curve
from .run_folder import Run

Rows = list[list[str]]
NONE = "–"


def headline(runs: list[Run], curves: list[Curve | None]) -> Rows:
    """What one wants to know first, a column for each run."""
    lines: list[tuple[str, Callable[[Run, Curve | None], str]]] = [
        ("how it ended", lambda run, _: run.outcome),
        ("grains", lambda run, _: _grains(run)),
        ("coarse graining", lambda run, _: NONE if not run.scene.data else "none" if run.scene.scheme == "none" else
         f"{run.scene.scheme.upper()}, k = {run.scene.factor:g}"),
        ("porosity, pressed", lambda run, _: _text(_pressed(run).get("porosity"), "{:.4f}")),
        ("stress on the plate, pressed", lambda run, _: _stress(run)),
        ("contacts a grain, pressed", lambda run, _: _text(_pressed(run).get("coordination"), "{:.2f}")),
        ("bonds broken", lambda run, _: _bonds(run)),
        ("produced mass", lambda run, curve: _mass(run, curve)),
        ("produced grains", lambda run, _: _produced_grains(run)),
        ("half of it by (t50)", lambda _, curve: _share_time(curve, 0.5)),
        ("nine tenths by (t90)", lambda _, curve: _share_time(curve, 0.9)),
        ("production simulated", lambda run, curve: _simulated(run, curve)),
        ("wall time", lambda run, _: duration(numbers.wall_time(run))),
        ("of it the production", lambda run, _: duration(numbers.wall_time(run, run.scene.production()["name"]))),
        ("particle-steps/s, production", lambda run, _: _speed(run)),
        ("warnings", lambda run, _: _warning_count(run)),
    ]
    return [["", *(run.name for run in runs)],
            *([name, *(value(run, curve) for run, curve in zip(runs, curves))] for name, value in lines)]


def _text(value: Any, form: str) -> str:
    return NONE if value is None else form.format(value)


def duration(seconds: float | None) -> str:
    if seconds is None:
        return NONE
    if seconds < 120:
        return f"{seconds:.1f} s"
    return f"{seconds / 60:.1f} min" if seconds < 7200 else f"{seconds / 3600:.2f} h"


def _first_with(run: Run, stage_name: str, last: bool = True) -> dict[str, Any]:
    stages = run.stage_summaries(stage_name)
    return stages[-1 if last else 0] if stages else {}


def _pressed(run: Run) -> dict[str, Any]:
    """The state before the perforation: of the last stage that came before it, or of the last one known."""
    stages = run.summary.get("stages", [])
    later = {run.scene.perforation()["name"], run.scene.production()["name"]}
    before = [stage for stage in stages if stage.get("name") not in later]
    return before[-1].get("end_state", {}) if before else {}


def _stress(run: Run) -> str:
    name = next((stage["end"]["stress_wall"] for stage in run.scene.stages if stage.get("end", {}).get("stress_wall")), None)
    wall = _pressed(run).get("walls", {}).get(name or run.scene.production().get("outlet_wall", ""), {})
    return NONE if wall.get("stress") is None else f"{wall['stress'] / 1e6:.4g} MPa ({name or 'outlet wall'})"


def _grains(run: Run) -> str:
    if len(run.history):
        count = np.nanmax(run.history.numbers("grains"), initial=0.0)
        return f"{count:,.0f}".replace(",", " ")
    return NONE


def _bonds(run: Run) -> str:
    known = numbers.bonds_over_time(run)
    if known is None or not known[1].size or not known[1][0]:
        return NONE
    broken = known[1][0] - known[1][-1]
    return f"{broken:.0f} of {known[1][0]:.0f} ({100 * broken / known[1][0]:.1f} %)"


def _mass(run: Run, curve: Curve | None) -> str:
    if curve is None:
        return NONE
    grains = next((stage["values"]["grain_mass_kg"] for stage in run.summary.get("stages", [])
                   if stage.get("values", {}).get("grain_mass_kg")), None)
    share = f" ({100 * curve.total / grains:.2f} % of the sample)" if grains else ""
    return f"{curve.total * 1e6:.4g} mg{share}"


def _produced_grains(run: Run) -> str:
    if run.produced is None:
        return NONE
    originals = np.nansum(run.produced.numbers("k") ** 3)
    return f"{len(run.produced)}" + (f" (for {originals:.0f} original ones)" if originals > len(run.produced) else "")


def _share_time(curve: Curve | None, share: float) -> str:
    time = curve.time_of_share(share) if curve else None
    return NONE if time is None else f"{time * 1e3:.3g} ms"


def _simulated(run: Run, curve: Curve | None) -> str:
    if curve is None or run.span_of(run.scene.production()["name"]) is None:
        return NONE
    planned = float(run.scene.production().get("duration", 0) or 0)
    return f"{curve.end * 1e3:.4g} ms" + (f" of {planned * 1e3:.4g}" if planned > curve.end * 1.001 else "")


def _speed(run: Run) -> str:
    stage = _first_with(run, run.scene.production()["name"])
    return _text(numbers.speed(stage), "{:.3g}")


def _warning_count(run: Run) -> str:
    warnings = run.summary.get("warnings")
    if warnings is None:
        return NONE
    return "none" if not warnings else ", ".join(f"{kind.replace('_', ' ')} ({count})" for kind, count in warnings.items())


def stages(run: Run) -> Rows:
    header = ["stage", "ended by", "wall time", "simulated", "steps", "particle-steps/s", "grains", "porosity", "contacts a grain", "bonds",
              "kinetic energy"]
    rows = [header]
    for stage in run.summary.get("stages", []):
        end = stage.get("end_state", {})
        rows.append([str(stage.get("name", "")), str(stage.get("ended_by") or "running"), duration(stage.get("wall_time")),
                     _text(stage.get("simulated_time"), "{:.4g} s"), _text(stage.get("steps"), "{}"), _text(numbers.speed(stage), "{:.3g}"),
                     _text(end.get("grains"), "{}"), _text(end.get("porosity"), "{:.4f}"), _text(end.get("coordination"), "{:.2f}"),
                     _text(end.get("bonds"), "{}"), _text(end.get("kinetic_energy"), "{:.3g} J")])
    return rows if len(rows) > 1 else []


def margins(run: Run) -> Rows:
    """Time step against what the stiffest contact allows, steps that a neighbour search lasted and what searches took, the largest
    overlap."""
    rows = [["stage", "time step", "over the contact's limit", "searches", "steps a search", "time in searches",
             "largest overlap / radius"]]
    for stage in run.summary.get("stages", []):
        values = stage.get("values", {})
        searches, steps = values.get("searches"), stage.get("steps", 0)
        seconds, whole = values.get("search_time_s"), stage.get("wall_time")
        rows.append([str(stage.get("name", "")), _text(values.get("time_step_s"), "{:.4g} s"),
                     _text(values.get("time_step_over_contact_limit"), "{:.3f}"), _text(searches, "{:.0f}"),
                     f"{steps / searches:.0f}" if searches else NONE, f"{seconds / whole:.1%}" if seconds and whole else NONE,
                     _text(stage.get("max_overlap_ratio"), "{:.4g}")])
    return rows if len(rows) > 1 else []


def other_values(run: Run) -> Rows:
    """Whatever else a stage has to tell (tuned friction, energies): what the tables above do not show."""
    shown = {"time_step_s", "time_step_over_contact_limit", "searches", "search_time_s"}
    rows = [[str(stage.get("name", "")), name, f"{value:.6g}"] for stage in run.summary.get("stages", [])
            for name, value in stage.get("values", {}).items() if name not in shown and isinstance(value, (int, float))]
    return [["stage", "value", ""], *rows] if rows else []


def energy_budget(runs: list[Run]) -> Rows:
    """Who did the work during the production: change of each energy, each work and loss.

    Works and losses count from the start of the stage, so that their last value is that of the whole production."""
    columns: dict[str, None] = {}
    for run in runs:
        columns.update(dict.fromkeys(name for name in run.history.names if ENERGY_COLUMN.search(name) or WORK_COLUMN.search(name)))
    changes = {run.name: {name: change for name in columns if (change := _change(run, name)) is not None} for run in runs}
    known = [name for name in columns if any(values.get(name) for values in changes.values())]
    if not any(WORK_COLUMN.search(name) for name in known):
        return []
    rows = [["during the production", *(run.name for run in runs)]]
    for name in known:
        title = ("change of " if ENERGY_COLUMN.search(name) else "") + name.replace("_", " ")
        rows.append([title, *(_text(changes[run.name].get(name), "{:+.3e} J") for run in runs)])
    return rows


def _change(run: Run, column: str) -> float | None:
    rows = run.rows_of(run.scene.production()["name"])
    values = run.history.numbers(column)[rows] if rows.size else np.zeros(0)
    values = values[np.isfinite(values)]
    if values.size < 2:
        return None
    return float(values[-1] - values[0]) if ENERGY_COLUMN.search(column) else float(values[-1])


def warnings(runs: list[Run]) -> Rows:
    rows = [[run.name, str(stage.get("name", "")), kind.replace("_", " "), str(count)]
            for run in runs for stage in run.summary.get("stages", []) for kind, count in stage.get("warnings", {}).items()]
    return [["run", "stage", "kind", "how often"], *rows] if rows else []


def machines(runs: list[Run]) -> Rows:
    """Versions and hardware, a column for each run."""
    known: dict[str, None] = {}
    for run in runs:
        for part in ("versions", "machine"):
            known.update(dict.fromkeys((f"{part}/{key}") for key in run.summary.get(part, {})))
    rows = [["", *(run.name for run in runs)]]
    for path in known:
        part, key = path.split("/", 1)
        values = [run.summary.get(part, {}).get(key) for run in runs]
        shown = [NONE if value is None else f"{float(value) / 2**30:.1f} GiB" if key == "memory_bytes" else str(value) for value in values]
        rows.append([("memory" if key == "memory_bytes" else key.replace("_", " ")), *shown])
    return rows if len(rows) > 1 else []
