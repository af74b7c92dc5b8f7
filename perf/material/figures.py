# SPDX-License-Identifier: MIT
"""Figures of docs/material.md."""

import math

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

import measure
from cases import FRICTIONS, MPA, STRESSES, SURFACE_ENERGIES, Test
from curves import curve, envelope
from results import Results, averaged, cohesion_line, cohesions, rumpf, scaled_curves

FOLDER = measure.ROOT / "docs/material"


def plot_curves(axes, results: Results, tests: list[Test], label: str, value, color=None) -> None:
    """Mean over the seeds, and their range as a band."""
    if not tests:
        return
    made = [value(curve(results.history(test, "shear"))) for test in tests]
    grid = np.linspace(max(x[0] for x, _ in made), min(x[-1] for x, _ in made), 150)
    values = np.array([np.interp(grid, x, y) for x, y in made])
    (line,) = axes.plot(100 * grid, values.mean(axis=0), label=label, color=color, linewidth=1.2)
    axes.fill_between(
        100 * grid, values.min(axis=0), values.max(axis=0), color=line.get_color(), alpha=0.25, linewidth=0
    )


def draw_envelopes(axes, results: Results, series: str, key: str, values, cohesive: bool, label: str) -> None:
    for n, value in enumerate(values):
        tests = results.of(series, **{key: value})
        rows = [results.rows[test] for test in tests]
        if not rows:
            continue
        fit = envelope([row.peak_axial for row in rows], [row.peak_lateral for row in rows], cohesive)
        axes.plot(
            [(row.peak_axial + row.peak_lateral) / 2 / MPA for row in rows],
            [(row.peak_axial - row.peak_lateral) / 2 / MPA for row in rows],
            ".",
            color=f"C{n}",
        )
        most = max((row.peak_axial + row.peak_lateral) / 2 / MPA for row in rows)
        s, sine = np.array([0, most]), math.sin(math.radians(fit.angle))
        axes.plot(
            s,
            fit.cohesion / MPA * math.cos(math.radians(fit.angle)) + sine * s,
            color=f"C{n}",
            linewidth=0.8,
            label=label.format(value) + f": {fit.angle:.1f}°" + (f", {fit.cohesion / MPA:.3f} MPa" if cohesive else ""),
        )
    axes.set(xlabel="(σz + σx) / 2 at the peak [MPa]", ylabel="(σz − σx) / 2 [MPa]", xlim=(0, None), ylim=(0, None))
    axes.legend(fontsize=7)
    axes.grid(alpha=0.3)


def finish(figure, name: str) -> None:
    figure.tight_layout()
    figure.savefig(FOLDER / f"{name}.png", dpi=100)
    plt.close(figure)


def draw_dry(results: Results) -> None:
    figure, axes = plt.subplots(1, 3, figsize=(12, 3.8))
    for n, friction in enumerate(FRICTIONS):
        for style, stress in enumerate(STRESSES):
            tests, shade = results.of("dry", friction=friction, stress=stress), plt.cm.tab20c(4 * n + style)
            label = f"μ {friction}, {stress / MPA:g} MPa"
            plot_curves(axes[0], results, tests, label, averaged(lambda c: c.deviator / c.lateral), shade)
            plot_curves(axes[1], results, tests, label, lambda c: (c.strain, c.porosity), shade)
    axes[0].set(xlabel="axial strain [%]", ylabel="(σz − σx) / σx")
    axes[1].set(xlabel="axial strain [%]", ylabel="porosity")
    for one in axes[:2]:
        one.legend(fontsize=7)
        one.grid(alpha=0.3)
    draw_envelopes(axes[2], results, "dry", "friction", FRICTIONS, False, "μ = {:g}")
    finish(figure, "dry")


def draw_bonded(results: Results) -> None:
    figure, axes = plt.subplots(2, 2, figsize=(11, 7.5))
    for n, energy in enumerate(SURFACE_ENERGIES):
        tests = results.of("bonded", surface_energy=energy, stress=0.5 * MPA)
        plot_curves(axes[0, 0], results, tests, f"γ = {energy} J/m²", averaged(lambda c: c.deviator / MPA), f"C{n}")
    for n, stress in enumerate(STRESSES):
        tests = results.of("bonded", surface_energy=30, stress=stress)
        plot_curves(
            axes[0, 1],
            results,
            tests,
            f"{stress / MPA:g} MPa",
            lambda c: (c.strain, 100 * (1 - c.bonds / c.bonds[0])),
            f"C{n}",
        )
    axes[0, 0].set(xlabel="axial strain [%]", ylabel="σz − σx [MPa] at 0.5 MPa")
    axes[0, 1].set(xlabel="axial strain [%]", ylabel="bonds broken [%], γ = 30 J/m²")
    for one in axes[0]:
        one.legend(fontsize=7)
        one.grid(alpha=0.3)
    draw_envelopes(axes[1, 0], results, "bonded", "surface_energy", SURFACE_ENERGIES, True, "{:g} J/m²")
    fits, fit = cohesions(results), cohesion_line(results)
    for energy, of in fits.items():
        axes[1, 1].plot([energy] * len(of), [one.cohesion / 1e3 for one in of], "k.")
    x = np.array([0, max(fits)])
    axes[1, 1].plot(x, (fit.intercept + fit.slope * x) / 1e3, label=f"R² = {fit.r2:.4f}")
    rows = [results.rows[test] for test in results.of("bonded", surface_energy=30)]
    axes[1, 1].plot(
        x, x / 30 * np.mean([rumpf(30, row) for row in rows]) / 1e3, "--", label="tensile strength after Rumpf"
    )
    axes[1, 1].set(xlabel="γ [J/m²]", ylabel="c′ [kPa]")
    axes[1, 1].legend(fontsize=7)
    axes[1, 1].grid(alpha=0.3)
    finish(figure, "bonded")


def draw_scaled(results: Results, series: str) -> None:
    figure, axes = plt.subplots(1, 2, figsize=(11, 4))
    for one, scene, title in (
        (axes[0], "oedometer", "σz [MPa], oedometer"),
        (axes[1], "triaxial_bonded", "σz − σx [MPa], triaxial, γ = 30 J/m²"),
    ):
        for n, ((scheme, k), of) in enumerate(scaled_curves(results, series, scene).items()):
            grid = np.linspace(max(x[0] for x, _ in of), min(x[-1] for x, _ in of), 150)
            values = np.array([np.interp(grid, x, y) for x, y in of]) / MPA
            one.plot(
                100 * grid,
                values.mean(axis=0),
                color=f"C{n}",
                label=f"k = {k}" + (f", {scheme.upper()}" if k > 1 else ""),
            )
            one.fill_between(100 * grid, values.min(axis=0), values.max(axis=0), color=f"C{n}", alpha=0.2, linewidth=0)
        one.set(xlabel="axial strain [%]", ylabel=title)
        if one.lines:
            one.legend(fontsize=7)
        one.grid(alpha=0.3)
    finish(figure, series)
