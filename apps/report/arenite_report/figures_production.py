# SPDX-License-Identifier: MIT
"""Produced sand: mass over time (fig 10), dimensionless against the original and measured points (fig 8), by size (fig 11)."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from . import numbers, palette
from .figure import Figure, as_png, below, columns_as_rows, panels
from .numbers import Curve
from .run_folder import Run
from .table import read_table


@dataclass(frozen=True)
class Measured:
    """Points of a laboratory or of another code."""

    name: str
    time: np.ndarray
    mass: np.ndarray

    def dimensionless(self) -> "Measured":
        """Eqs 39 and 40 with the last point as the end; points that are dimensionless already stay as they are."""
        return Measured(self.name, self.time / self.time[-1], self.mass / self.mass[-1])


def read_measured(path: Path) -> Measured:
    """A CSV with a time in its first column and a cumulative mass in its second, or in columns named t and M. ValueError if not."""
    table = read_table(path)
    names = {name.lower(): name for name in table.names}
    if len(names) < 2:
        raise ValueError(f"{path}: two columns are needed, t and M")
    time = table.numbers(names.get("t", names.get("time", table.names[0])))
    mass = table.numbers(names.get("m", names.get("mass", table.names[1])))
    known = np.isfinite(time) & np.isfinite(mass)
    order = np.argsort(time[known], kind="stable")
    time, mass = time[known][order], mass[known][order]
    if time.size == 0 or time[-1] <= 0 or mass[-1] <= 0:
        raise ValueError(f"{path}: no points (t, M) above zero")
    return Measured(path.stem, time, mass)


def error_to_measured(measured: Measured, curve: Curve) -> float | None:
    points, model = measured.dimensionless(), curve.dimensionless()
    return numbers.rmsre(points.mass, model.at(points.time)) if model else None


def produced_mass(runs: list[Run], curves: list[Curve | None]) -> Figure | None:
    drawn = [(row, run, curve) for row, (run, curve) in enumerate(zip(runs, curves)) if curve is not None]
    if not drawn:
        return None
    canvas, (axes,) = panels(1, 1, 8.0, 4.2)
    rows = []
    for row, run, curve in drawn:
        axes.step(curve.time * 1e3, curve.mass * 1e6, where="post", label=run.label, **palette.run_style(row))
        rows += columns_as_rows(run.name, curve.time, curve.mass)
    axes.set(xlabel="time since the production began [ms]", ylabel="produced mass [mg]", xlim=(0, None), ylim=(0, None))
    below(canvas, axes)
    return Figure("figure-10-produced-mass", "Produced mass over time (paper's fig 10)",
                  "Cumulative mass of the grains that left through the hole, from produced.csv: a step for every grain.",
                  as_png(canvas), ["run", "time_s", "produced_mass_kg"], rows)


def dimensionless(runs: list[Run], curves: list[Curve | None], measured: list[Measured]) -> Figure | None:
    drawn = [(row, run, curve.dimensionless()) for row, (run, curve) in enumerate(zip(runs, curves))
             if curve is not None and curve.dimensionless()]
    if not drawn:
        return None
    canvas, (axes,) = panels(1, 1, 8.0, 4.2)
    rows = []
    for row, run, curve in drawn:
        axes.step(curve.time, curve.mass, where="post", label=run.label, **palette.run_style(row))
        rows += columns_as_rows(run.name, curve.time, curve.mass)
    for number, points in enumerate(point.dimensionless() for point in measured):
        axes.plot(points.time, points.mass, "osD^"[number % 4], color=palette.MEASURED, label=f"{points.name} (measured)")
        rows += columns_as_rows(points.name, points.time, points.mass)
    axes.set(xlabel="$t_d = t/t_{end}$", ylabel="$M_d = M/M_{end}$", xlim=(0, 1.01), ylim=(0, 1.03))
    below(canvas, axes)
    going = [run.name for _, run, _ in drawn if not run.finished]
    unfinished = f" Not finished, so that its end is that of now: {', '.join(going)}." if going else ""
    return Figure("figure-8-dimensionless", "Dimensionless production (paper's fig 8, eqs 39 and 40)",
                  "Time over the time of the production's end, mass over the mass produced by then." + unfinished,
                  as_png(canvas), ["case", "t_d", "M_d"], rows)


def mass_by_class(runs: list[Run]) -> Figure | None:
    times, which = numbers.moments(runs)
    edges = [0.0, *times]
    drawn = [(row, run, numbers.mass_by_class(run, edges)) for row, run in enumerate(runs)]
    drawn = [(row, run, classes) for row, run, classes in drawn if any(mass.any() for mass in classes.values())]
    if not drawn:
        return None
    sizes = sorted({size for _, _, classes in drawn for size in classes})
    place = np.arange(len(sizes), dtype=float)
    width = 0.8 / len(drawn)
    canvas, axes = panels(1, 3, 11.0, 3.9)
    rows = []
    for interval, panel in enumerate(axes):
        for bar, (row, run, classes) in enumerate(drawn):
            mass = np.array([classes[size][interval] if size in classes else 0.0 for size in sizes])
            x = place + (bar - (len(drawn) - 1) / 2) * width
            panel.bar(x, mass * 1e6, width * 0.92, color=palette.run_style(row)["color"], label=run.label)
            _mark_expected(panel, run, sizes, x, mass.sum(), width)
            rows += [[run.name, edges[interval], edges[interval + 1], float(size), float(m)] for size, m in zip(sizes, mass)]
        panel.set_title(f"{edges[interval] * 1e3:.4g} to {edges[interval + 1] * 1e3:.4g} ms")
        panel.set_xticks(place, [f"{size * 1e3:.4g}" for size in sizes], rotation=45)
        panel.set_xlabel("original diameter [mm]")
        panel.grid(axis="x", visible=False)
        if not any(mass[interval] for _, _, classes in drawn for mass in classes.values()):
            panel.text(0.5, 0.5, "nothing produced", transform=panel.transAxes, ha="center", color=palette.MEASURED)
            panel.set_yticks([])
    axes[0].set_ylabel("produced mass [mg]")
    below(canvas, axes[0])
    return Figure("figure-11-mass-by-class", "Produced mass by size in three intervals (paper's fig 11)",
                  "By the diameter of the original grains that a grain stands for (its class; SSP's grains have one size but keep "
                  f"their class). Intervals: {which}. A dark mark is what the class would have by its mass share in the sample.",
                  as_png(canvas), ["run", "from_s", "to_s", "original_diameter_m", "produced_mass_kg"], rows)


def _mark_expected(panel: plt.Axes, run: Run, sizes: list[float], x: np.ndarray, total: float, width: float) -> None:
    shares = dict(zip(run.scene.class_diameters, run.scene.class_mass_shares))
    known = [i for i, size in enumerate(sizes) if size in shares]
    if known and total > 0:
        panel.hlines([shares[sizes[i]] * total * 1e6 for i in known], x[known] - width * 0.46, x[known] + width * 0.46,
                     color="#1a1a1a", linewidth=1.6)


def error_table(runs: list[Run], curves: list[Curve | None], reference: int | None, measured: list[Measured]) -> list[list[str]]:
    """RMSRE of every case, with a header row; empty where there is nothing to compare with."""
    header = ["case"]
    compared = reference is not None and curves[reference] is not None and len(runs) > 1
    if compared:
        header += [f"M_d against {runs[reference].name}", f"M against {runs[reference].name}", "mass in all, over the original's"]
    header += [f"M_d against {points.name} ({points.time.size} points)" for points in measured]
    if len(header) == 1:
        return []
    table = [header]
    for row, (run, curve) in enumerate(zip(runs, curves)):
        cells = [run.label]
        if compared:
            original = curves[reference]
            same = row == reference or curve is None
            cells += [_percent(None if same else numbers.rmsre_of_curves(original, curve)),
                      _percent(None if same else numbers.rmsre_of_masses(original, curve)),
                      "–" if same or original.total <= 0 else f"{curve.total / original.total:.3f}"]
        cells += [_percent(error_to_measured(points, curve) if curve else None) for points in measured]
        table.append(cells)
    return table


def _percent(value: float | None) -> str:
    return "–" if value is None else f"{value:.2f} %"
