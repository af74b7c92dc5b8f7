# SPDX-License-Identifier: MIT
"""The study's numbers, a row a case, from the run folders; docs/study.csv holds them."""

from __future__ import annotations

import hashlib
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import measure  # noqa: E402

sys.path.insert(0, str(measure.ROOT / "apps/report"))
from arenite_report import numbers  # noqa: E402
from arenite_report.run_folder import Run, read_run  # noqa: E402

from cases import CASES  # noqa: E402

Row = dict[str, str]
MOMENTS = (0.003, 0.015, 0.04)  # s of production, as the paper's figs 9 and 11
EARLY, EARLY_TERMS = 0.005, ("work_drag", "loss_tangential", "loss_damping")  # s of production
ENERGY_TERMS = ("elastic_energy", "adhesive_energy", "tangential_energy", "kinetic_energy", "rotation_energy")
WORK_TERMS = ("work_gravity", "work_drag", "work_pressure", "work_walls", "loss_damping", "loss_tangential", "loss_adhesion", "energy_removed",
              "energy_residual")


def text(value: float | int | None, form: str = ".6g") -> str:
    return "" if value is None else format(value, form)


def stage(run: Run, name: str) -> dict:
    stages = run.stage_summaries(name)
    return stages[-1] if stages else {}


def energy_changes(run: Run) -> Row:
    """J, over the production: what is stored less what was, works and losses as history.csv counts them from its start."""
    rows = run.rows_of("production")
    if rows.size < 2 or "elastic_energy" not in run.history:
        return {}
    row: Row = {}
    before = rows[0] - 1 if rows[0] > 0 else rows[0]
    for term in ENERGY_TERMS:
        values = run.history.numbers(term)
        row[f"change_{term}_J"] = text(values[rows[-1]] - values[before])
    for term in WORK_TERMS:
        row[f"{term}_J"] = text(run.history.numbers(term)[rows[-1]])
    return row


def early_column(term: str) -> str:
    return f"{term}_at_{1e3 * EARLY:g}ms_J"


def works_early(run: Run) -> Row:
    """J, works and losses of the production up to EARLY: what runs of different length have in common."""
    rows = run.rows_of("production")
    if rows.size < 2 or "loss_tangential" not in run.history:
        return {}
    since = run.history.numbers("time")[rows] - run.span_of("production")[0]
    if since[-1] < EARLY * (1 - 1e-6):
        return {}
    row = rows[int(abs(since - EARLY).argmin())]
    return {early_column(term): text(run.history.numbers(term)[row]) for term in EARLY_TERMS}


def resumed_within(run: Run, name: str) -> bool:
    """Whether the run began inside a stage: then it knows the wall time of the last part only."""
    step, resumed = 0, run.summary.get("resumed_from_step")
    for part in run.summary.get("stages", []):
        first, step = step, step + part.get("steps", 0)
        if part["name"].split("/")[0] == name and resumed is not None and first < resumed < step:
            return True
    return False


def largest(run: Run, stage_name: str, column: str) -> float | None:
    """Of the column's rows in a stage, None without any."""
    rows = run.rows_of(stage_name)
    return float(run.history.numbers(column)[rows].max()) if rows.size and column in run.history else None


def hardware(run: Run) -> str:
    """What the run ran on, as its summary says."""
    machine = run.summary.get("machine") or {}
    if machine.get("gpu"):
        return str(machine["gpu"])
    threads = machine.get("concurrency")
    return str(machine.get("cpu", "")) + (f", {threads} thread{'s' if threads != 1 else ''}" if threads else "")


def row_of(name: str, folder: pathlib.Path) -> Row | None:
    run = read_run(folder, name)
    curve = numbers.production_curve(run)
    if curve is None or run.produced is None or run.rows_of("production").size == 0:
        return None
    pressed, perforated = stage(run, "compression").get("end_state", {}), stage(run, "perforation").get("end_state", {})
    bonds = run.history.numbers("bonds")[run.rows_of("production")]
    grain_mass = stage(run, "perforation").get("values", {}).get("grain_mass_kg")
    row: Row = {
        "case": name, "what": CASES[name].note, "k": text(run.scene.factor, "g"), "scheme": run.scene.scheme,
        "grains": text(pressed.get("grains")), "porosity": text(pressed.get("porosity"), ".4f"),
        "contacts_per_grain": text(pressed.get("coordination"), ".3f"), "bonds_pressed": text(pressed.get("bonds")),
        "largest_overlap_perforation": text(largest(run, "perforation", "max_overlap_ratio"), ".3f"),
        "bonds_perforated": text(perforated.get("bonds")), "bonds_end": text(int(bonds[-1])),
        "production_s": text(curve.end), "time_step_s": text(run.scene.production().get("time_step")),
        "produced_kg": text(curve.total), "produced_grains": text(len(run.produced)),
        "share_of_sample": text(curve.total / grain_mass if grain_mass else None),
        "last_grain_s": text(curve.time_of_share(1.0)) if curve.total > 0 else "",
        "t50_s": text(curve.time_of_share(0.5)), "t90_s": text(curve.time_of_share(0.9)),
    }
    for moment in MOMENTS:
        row[f"produced_at_{1e3 * moment:g}ms_kg"] = text(float(curve.at([moment])[0])) if curve.end >= moment * (1 - 1e-6) else ""
    row |= energy_changes(run) | works_early(run)
    for name_, label in (("compression", "pressing"), ("perforation", "perforation"), ("production", "production")):
        row[f"wall_{label}_s"] = "" if resumed_within(run, name_) else text(numbers.wall_time(run, name_), ".0f")
    row["on"] = hardware(run)
    row["commit"] = str(run.summary.get("versions", {}).get("commit", ""))
    if resumed_within(run, "production"):
        row["commit"] += f" from step {run.summary['resumed_from_step']} on"
    row["ledger_sha256"] = hashlib.sha256((folder / "produced.csv").read_bytes()).hexdigest()[:16]
    return row


def collect(folder: pathlib.Path) -> list[Row]:
    rows = (row_of(name, folder / name) for name in CASES if not CASES[name].until and (folder / name).is_dir())
    return [row for row in rows if row]


def write(rows: list[Row], path: pathlib.Path) -> None:
    columns = list(dict.fromkeys(column for row in rows for column in row))
    measure.write_table(path, [], columns, [[row.get(column, "") for column in columns] for row in rows])


def read(path: pathlib.Path) -> list[Row]:
    return measure.read_table(path)[1]


def number(row: Row, column: str) -> float | None:
    """None where the run has no such number."""
    return float(row[column]) if row.get(column) else None
