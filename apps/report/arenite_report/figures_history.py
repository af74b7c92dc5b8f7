# SPDX-License-Identifier: MIT
"""Curves of history.csv: bonds, energy and momentum shares, compression, and how near the run was to its limits."""

from __future__ import annotations

import math
import re
from typing import Iterable

import matplotlib.pyplot as plt
import numpy as np

from . import numbers, palette
from .figure import Figure, as_png, below, columns_as_rows, panels
from .run_folder import Run

ENERGY_COLUMN = re.compile(r"_energy$")
WORK_COLUMN = re.compile(r"^work_|^loss_|^energy_")
MOMENTUM_COLUMN = re.compile(r"momentum|impulse")
SHARE_COLOURS = (*palette.RUNS, "#8c6d31", "#7f7f7f", "#5254a3", "#ad494a", "#637939")


def bonds(runs: list[Run]) -> Figure | None:
    canvas, axes = panels(1, 2, 10.0, 3.7)
    rows = []
    for row, run in enumerate(runs):
        known = numbers.bonds_over_time(run)
        if known is None or not np.nansum(known[1]):
            continue
        time, count, grains = known
        broken = count[0] - count
        axes[0].plot((time - time[0]) * 1e3, 100 * broken / max(count[0], 1), label=run.label, **palette.run_style(row))
        axes[1].plot((time - time[0]) * 1e3, 2 * count / np.maximum(grains, 1), label=run.label, **palette.run_style(row))
        rows += columns_as_rows(run.name, time, count, broken, grains)
    if not rows:
        plt.close(canvas)
        return None
    for panel, label in zip(axes, ("bonds broken [% of those at the start]", "bonds of a grain, mean")):
        panel.set(xlabel="time since the perforation began [ms]", ylabel=label, xlim=(0, None), ylim=(0, None))
        _mark_production(panel, runs)
    below(canvas, axes[0])
    return Figure("bonds-broken", "Bonds broken",
                  "Bonds at the start of the perforation (of the production where nothing is perforated) less those of now; bonds "
                  "of grains that have left count as broken. Dotted: the production begins.",
                  as_png(canvas), ["run", "time_s", "bonds", "broken", "grains"], rows)


def _mark_production(panel: plt.Axes, runs: list[Run]) -> None:
    for row, run in enumerate(runs):
        perforated, produced = (run.span_of(stage["name"]) for stage in (run.scene.perforation(), run.scene.production()))
        if perforated and produced:
            panel.axvline((produced[0] - perforated[0]) * 1e3, color=palette.run_style(row)["color"], linestyle=":", linewidth=1)


def shares(runs: list[Run], groups: dict[str, re.Pattern[str]], name: str, title: str, unit: str, caption: str) -> Figure | None:
    """A row for each run, a panel for each group: the columns that its pattern finds, from the start of the perforation on."""
    found = {run.name: {group: _moving_columns(run, pattern) for group, pattern in groups.items()} for run in runs}
    shown = [run for run in runs if any(found[run.name].values())]
    used = [group for group in groups if any(found[run.name][group] for run in shown)]
    if not shown:
        return None
    canvas, axes = panels(len(shown), len(used), 11.0, 4.4)
    # A quantity looks the same in every run, also where one of them lacks the one before it.
    drawn = {group: list(dict.fromkeys(column for run in shown for column in found[run.name][group])) for group in used}
    rows = []
    for number, panel in enumerate(axes):
        run, group = shown[number // len(used)], used[number % len(used)]
        columns = found[run.name][group]
        for column in columns:
            rows += [[run.name, column, float(t), float(v)] for t, v in zip(run.history.numbers("time"), run.history.numbers(column))
                     if np.isfinite(v)]
        panel.set_title(group if len(shown) == 1 else f"{run.label}: {group}")
        if columns:
            _draw_shares(panel, run, {column: drawn[group].index(column) for column in columns}, linear=group == "momentum")
        panel.set(xlabel="time [ms]", ylabel=unit)
    return Figure(name, title, caption, as_png(canvas), ["run", "column", "time_s", f"value_{unit.strip('[]').replace(' ', '')}"], rows)


def _moving_columns(run: Run, pattern: re.Pattern[str]) -> list[str]:
    """Those that the pattern finds and that are not zero throughout."""
    shown = _shown(run)
    return [column for column in run.history.names if pattern.search(column) and np.nansum(np.abs(run.history.numbers(column)[shown])) > 0]


def _shown(run: Run) -> np.ndarray:
    """Rows from the start of the perforation on, of the production without one, or all."""
    time = run.history.numbers("time")
    span = run.span_of(run.scene.perforation()["name"]) or run.span_of(run.scene.production()["name"])
    return time >= span[0] if span else np.ones(time.size, dtype=bool)


def _draw_shares(panel: plt.Axes, run: Run, columns: dict[str, int], linear: bool) -> None:
    """columns: those drawn, each with the number of its style."""
    time, shown = run.history.numbers("time"), _shown(run)
    for column, number in columns.items():
        panel.plot(time[shown] * 1e3, run.history.numbers(column)[shown], label=column.replace("_", " "), linewidth=1.4,
                   color=SHARE_COLOURS[number % len(SHARE_COLOURS)], linestyle="-" if number < len(palette.RUNS) else "--")
    if not linear:
        panel.set_yscale("symlog", linthresh=_linear_range(run, columns, shown))
    for _, begin in _stage_starts(run):
        if shown.any() and begin > time[shown][0]:
            panel.axvline(begin * 1e3, color="#9aa0a8", linestyle=":", linewidth=1)
    panel.legend(loc="upper center", bbox_to_anchor=(0.5, -0.16), ncols=3, fontsize=8)


def _linear_range(run: Run, columns: Iterable[str], shown: np.ndarray) -> float:
    """Shares differ by orders of magnitude and in sign: logarithmic down to a ten-thousandth of the largest or less, linear
    below. A power of ten, so that no tick lies between it and zero."""
    values = np.abs(np.concatenate([run.history.numbers(column)[shown] for column in columns]))
    largest = np.nanmax(values) if np.isfinite(values).any() else 0.0
    return 10.0 ** math.floor(math.log10(max(largest * 1e-4, 1e-300)))


def _stage_starts(run: Run) -> list[tuple[str, float]]:
    labels, times = run.history.texts("stage"), run.history.numbers("time")
    return [(label, float(times[i])) for i, label in enumerate(labels) if i == 0 or labels[i - 1] != label]


def energies(runs: list[Run]) -> Figure | None:
    return shares(runs, {"energies": ENERGY_COLUMN, "works and losses": WORK_COLUMN}, "energy-shares", "Energy over time", "[J]",
                  "As history.csv has it, from the start of the perforation: energies of the moment, works and losses since the stage "
                  "began. Linear near zero and logarithmic beyond; what stays zero is left out. Dotted: stages begin.")


def momenta(runs: list[Run]) -> Figure | None:
    return shares(runs, {"momentum": MOMENTUM_COLUMN}, "momentum-shares", "Momentum over time", "[kg m/s]",
                  "Of grains and fluid, as history.csv has it. Dotted: stages begin.")


def wall_load(runs: list[Run]) -> Figure | None:
    """Who carries the load: the force along the axis on the plates and the rod, and the porosity."""
    canvas, axes = panels(1, 2, 10.0, 3.7)
    rows = []
    for row, run in enumerate(runs):
        if not len(run.history):
            continue
        time, porosity = run.history.numbers("time"), run.history.numbers("porosity")
        for number, (wall, column) in enumerate(_load_columns(run)):
            value = run.history.numbers(column)
            rows += [[run.name, column, float(t), float(v)] for t, v in zip(time, value) if np.isfinite(v)]
            colour = palette.run_style(number if len(runs) == 1 else row)["color"]
            dash = "-" if len(runs) == 1 else palette.LINES[number % 4]
            axes[0].plot(time * 1e3, np.abs(value), color=colour, linestyle=dash, linewidth=1.3,
                         label=wall if len(runs) == 1 else f"{wall}, {run.name}")
        if np.isfinite(porosity).any():
            axes[1].plot(time * 1e3, porosity, label=run.label, **palette.run_style(row))
            rows += [[run.name, "porosity", float(t), float(v)] for t, v in zip(time, porosity) if np.isfinite(v)]
    if not rows:
        plt.close(canvas)
        return None
    axes[0].set(xlabel="time [ms]", ylabel="force along the axis [N]")
    axes[1].set(xlabel="time [ms]", ylabel="porosity of the sample")
    for panel in axes:
        if len(panel.get_legend_handles_labels()[1]) > 1:
            panel.legend(loc="best")
    return Figure("wall-load", "Load on the walls, and porosity",
                  "Force of the grains along the axis of the hole on the walls across it and on the rod, absolute values.",
                  as_png(canvas), ["run", "column", "time_s", "value"], rows)


def _load_columns(run: Run) -> list[tuple[str, str]]:
    """Name and column of the walls that can carry load along the axis; of all walls where there is no scene."""
    up = run.scene.section().up
    rod = (run.scene.rod() or {}).get("wall")
    across = {str(wall.get("name")) for wall in run.scene.walls if wall.get("name") == rod or wall.get("type") not in ("plane", "cylinder") or
              (wall.get("type") == "plane" and abs(wall.get("normal", [0, 0, 0])[up]) > 0.5)}
    found = [(name[6:-2], name) for name in run.history.names if re.fullmatch(rf"force_.*_{'xyz'[up]}", name)]
    return [(wall, column) for wall, column in found if wall in across or not run.scene.walls]


def margins(runs: list[Run]) -> Figure | None:
    """Largest overlap everywhere; Courant number and pressure iterations where there is a fluid."""
    columns = [("max_overlap_ratio", "largest overlap / radius"), ("courant", "Courant number"),
               ("pressure_iterations", "pressure iterations a step")]
    columns = [(column, label) for column, label in columns
               if any(len(run.history) and np.isfinite(run.history.numbers(column)).any() for run in runs)]
    if not columns:
        return None
    canvas, axes = panels(1, len(columns), 11.0, 3.5)
    rows = []
    for panel, (column, label) in zip(axes, columns):
        for row, run in enumerate(runs):
            time, value = run.history.numbers("time"), run.history.numbers(column)
            known = np.isfinite(value)
            panel.plot(time[known] * 1e3, value[known], label=run.label, **{**palette.run_style(row), "linewidth": 1.1})
            rows += [[run.name, column, float(t), float(v)] for t, v in zip(time[known], value[known])]
        panel.set(xlabel="time [ms]", ylabel=label)
        if column != "pressure_iterations":
            panel.set_yscale("log")
    below(canvas, axes[0])
    return Figure("margins", "Margins over time", "How near the run came to what it should not: overlaps of a few per cent of the radius, "
                  "a Courant number of one. The time-step and skin margins of each stage are in the table above.",
                  as_png(canvas), ["run", "column", "time_s", "value"], rows)
