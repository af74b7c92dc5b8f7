# SPDX-License-Identifier: MIT
"""The numbers that the report compares: production curves, their times and errors, mass by size class, bonds, wall time."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from .run_folder import Run

# The paper's moments of a production of 0.04 s: the ends of fig 11's intervals, and what fig 9 shows.
PAPER_TIMES = (0.003, 0.015, 0.04)  # s


@dataclass(frozen=True)
class Curve:
    """Cumulative produced mass against the time since the production began."""

    time: np.ndarray  # s, ascending, from 0
    mass: np.ndarray  # kg, cumulative

    @property
    def end(self) -> float:
        return float(self.time[-1])

    @property
    def total(self) -> float:
        return float(self.mass[-1])

    def at(self, times: np.ndarray) -> np.ndarray:
        """The mass is a staircase: what had left by then."""
        return self.mass[np.maximum(np.searchsorted(self.time, times, side="right") - 1, 0)]

    def time_of_share(self, share: float) -> float | None:
        """When this share of the total had left."""
        if self.total <= 0:
            return None
        return float(self.time[np.argmax(self.mass >= share * self.total * (1 - 1e-12))])

    def dimensionless(self) -> "Curve | None":
        """Eqs 39 and 40: time over the time of the end, mass over the mass at the end."""
        return Curve(self.time / self.end, self.mass / self.total) if self.end > 0 and self.total > 0 else None


def production_curve(run: Run) -> Curve | None:
    """From the ledger; from the history's column where there is no ledger."""
    span = run.span_of(run.scene.production()["name"])
    if span is None and (run.produced is None or len(run.produced) == 0):
        return None
    start, end = span if span else (0.0, float(run.produced.numbers("time")[-1]))
    if run.produced is not None:
        time, mass = run.produced.numbers("time") - start, run.produced.numbers("mass")
        order = np.argsort(time, kind="stable")
        time, mass = np.maximum(time[order], 0), np.cumsum(mass[order])
    else:
        rows = run.rows_of(run.scene.production()["name"])
        time, mass = run.history.numbers("time")[rows] - start, run.history.numbers("produced_mass")[rows]
    end = max(end - start, time[-1] if time.size else 0.0)
    return Curve(np.concatenate([[0.0], time, [end]]), np.concatenate([[0.0], mass, mass[-1:] if mass.size else [0.0]]))


def rmsre(expected: np.ndarray, model: np.ndarray) -> float | None:
    """Eq 41 with the square that its print lacks, in %. Points where nothing is expected have no relative error."""
    known = expected > 0
    if not known.any():
        return None
    return float(100 * np.sqrt(np.mean(((expected[known] - model[known]) / expected[known]) ** 2)))


def rmsre_of_curves(reference: Curve, model: Curve, points: int = 100) -> float | None:
    """Of dimensionless curves, at evenly spread times from 1/points of the end to the end."""
    a, b = reference.dimensionless(), model.dimensionless()
    times = np.arange(1, points + 1) / points
    return rmsre(a.at(times), b.at(times)) if a and b else None


def rmsre_of_masses(reference: Curve, model: Curve, points: int = 100) -> float | None:
    """The same in kg and s: it also sees that a model gives more or less in all. Over the time that both have."""
    times = np.arange(1, points + 1) / points * min(reference.end, model.end)
    return rmsre(reference.at(times), model.at(times))


def production_length(run: Run) -> float:
    """s that the production is to last: the scene's, or what there is so far."""
    planned = float(run.scene.production().get("duration", 0) or 0)
    span = run.span_of(run.scene.production()["name"])
    return planned if planned > 0 else (span[1] - span[0] if span else 0.0)


def moments(runs: list[Run]) -> tuple[list[float], str]:
    """The paper's three times, or the same shares of a production of another length, and a word on which."""
    length = max((production_length(run) for run in runs), default=0.0)
    if length == 0 or abs(length / PAPER_TIMES[-1] - 1) < 0.01:
        return list(PAPER_TIMES), "the paper's times"
    scaled = [time / PAPER_TIMES[-1] * length for time in PAPER_TIMES]
    return scaled, f"the paper's times ({', '.join(f'{t:g}' for t in PAPER_TIMES)} s) scaled to a production of {length:g} s"


def class_diameters(run: Run) -> np.ndarray | None:
    """m, the original diameter that each produced grain stands for. SSP's grains keep their class but have one size."""
    if run.produced is None:
        return None
    classes, sizes = run.produced.numbers("class"), np.array(run.scene.class_diameters)
    own = run.produced.numbers("diameter") / run.produced.numbers("k")
    if sizes.size == 0 or not np.all((classes >= 0) & (classes < sizes.size)):
        return np.round(own, 7)
    return sizes[classes.astype(int)]


def mass_by_class(run: Run, edges: list[float]) -> dict[float, np.ndarray]:
    """kg for each original diameter in the intervals between the edges (s since the production began)."""
    span, diameters = run.span_of(run.scene.production()["name"]), class_diameters(run)
    if diameters is None:
        return {}
    time = run.produced.numbers("time") - (span[0] if span else 0.0)
    mass = run.produced.numbers("mass")
    # A grain belongs to the interval whose end is the first at or after it; what left after the last edge to none.
    interval = np.searchsorted(np.array(edges[1:]) * (1 + 1e-9), time)
    sizes = set(np.unique(diameters)) | set(run.scene.class_diameters)
    return {float(size): np.array([mass[(diameters == size) & (interval == i)].sum() for i in range(len(edges) - 1)])
            for size in sorted(sizes)}


def bonds_over_time(run: Run) -> tuple[np.ndarray, np.ndarray, np.ndarray] | None:
    """Time, bonds and grains from the start of the perforation on, or of the whole history where nothing is perforated."""
    if "bonds" not in run.history or len(run.history) == 0:
        return None
    time, bonds = run.history.numbers("time"), run.history.numbers("bonds")
    span = run.span_of(run.scene.perforation()["name"]) or run.span_of(run.scene.production()["name"])
    from_there = time >= span[0] * (1 - 1e-12) if span else np.ones(time.size, dtype=bool)
    return time[from_there], bonds[from_there], run.history.numbers("grains")[from_there]


def wall_time(run: Run, stage_name: str | None = None) -> float | None:
    """s, of a stage with its parts, or of all stages (those before a resume too)."""
    stages = run.stage_summaries(stage_name) if stage_name else run.summary.get("stages", [])
    return sum(float(stage.get("wall_time", 0)) for stage in stages) if stages else None


def speed(stage: dict[str, Any]) -> float | None:
    value = stage.get("particle_steps_per_second")
    return float(value) if value else None
