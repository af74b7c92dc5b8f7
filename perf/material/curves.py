# SPDX-License-Identifier: MIT
"""Stress-strain curves from histories, and what is read from them. Compression is positive, strains are logarithmic."""

from __future__ import annotations

import dataclasses

import numpy as np

from cases import Test

WINDOW = (
    0.0025  # strain over which a curve is averaged before a peak is read: rows of a history scatter by some per cent
)


@dataclasses.dataclass
class Curve:
    """Rows of a stage: axial strain, stresses in Pa, porosity, bonds left."""

    strain: np.ndarray
    axial: np.ndarray
    lateral: np.ndarray
    porosity: np.ndarray
    bonds: np.ndarray

    @property
    def deviator(self) -> np.ndarray:
        return self.axial - self.lateral


def curve(history: dict[str, list[float]], start_height: float | None = None) -> Curve:
    """Of a stage's history; strains count from its first row or from the given height of the box in m."""
    column = {
        name: np.array(history[name]) for name in ("box_z", "stress_x", "stress_y", "stress_z", "porosity", "bonds")
    }
    height = start_height or column["box_z"][0]
    return Curve(
        np.log(height / column["box_z"]),
        column["stress_z"],
        (column["stress_x"] + column["stress_y"]) / 2,
        column["porosity"],
        column["bonds"],
    )


def smooth(values: np.ndarray, strain: np.ndarray) -> np.ndarray:
    """Running mean over WINDOW, only where the whole window lies inside the curve."""
    rows = max(1, round(WINDOW / (strain[-1] - strain[0]) * (len(strain) - 1)))
    return np.convolve(values, np.ones(rows) / rows, "valid")


@dataclasses.dataclass
class Row:
    """What is read from a triaxial test; stresses in Pa."""

    series: str
    stress: float  # confining, as asked for
    friction: float
    surface_energy: float
    scheme: str
    k: int
    grains: int
    seed: int
    slowness: float
    confined_friction: float
    peak_axial: float
    peak_lateral: float
    peak_strain: float
    late_axial: float  # mean over the last fifth of the strain
    late_lateral: float
    modulus: float  # half of the peak deviator over its strain
    porosity: float  # before the shear
    bonds_start: int  # per grain: 2 bonds / grains
    bonds_peak: float  # share of bonds that are left
    bonds_end: float
    lateral_error: float  # largest |lateral / asked - 1| of a row after the first tenth
    cpu_seconds: float


def row(test: Test, history: dict[str, list[float]], grains: int, cpu_seconds: float) -> Row:
    c = curve(history)
    strain, axial, lateral, bonds = (smooth(v, c.strain) for v in (c.strain, c.axial, c.lateral, c.bonds))
    deviator = axial - lateral
    top, late = int(np.argmax(deviator / (axial + lateral))), strain > 0.8 * strain[-1]
    half = int(np.argmax(c.deviator >= deviator[top] / 2))
    settled = c.strain > 0.1 * c.strain[-1]
    whole = c.bonds[0] or np.nan
    return Row(
        test.series,
        test.stress,
        test.friction,
        test.surface_energy,
        test.scheme,
        test.k,
        grains,
        test.seed,
        test.slowness,
        test.confined_friction,
        axial[top],
        lateral[top],
        strain[top],
        axial[late].mean(),
        lateral[late].mean(),
        c.deviator[half] / c.strain[half],
        c.porosity[0],
        int(c.bonds[0]),
        bonds[top] / whole,
        c.bonds[-1] / whole,
        float(np.abs(c.lateral[settled] / test.stress - 1).max()),
        cpu_seconds,
    )


def angle(axial: float, lateral: float) -> float:
    """Friction angle of one state without cohesion, degrees."""
    return float(np.degrees(np.arcsin((axial - lateral) / (axial + lateral))))


@dataclasses.dataclass
class Envelope:
    """Mohr-Coulomb: t = c cos(phi) + s sin(phi), s and t half the sum and half the difference of the principal stresses."""

    angle: float  # degrees
    cohesion: float  # Pa
    r2: float  # 1 - squared misfit / squared deviation of t from its mean


def envelope(axial: list[float], lateral: list[float], cohesive: bool) -> Envelope:
    a, l = np.array(axial), np.array(lateral)
    s, t = (a + l) / 2, (a - l) / 2
    if cohesive:
        sine, intercept = np.polyfit(s, t, 1)
    else:
        sine, intercept = (s @ t) / (s @ s), 0.0
    misfit = t - intercept - sine * s
    return Envelope(
        float(np.degrees(np.arcsin(sine))),
        float(intercept / np.sqrt(1 - sine**2)),
        float(1 - misfit @ misfit / ((t - t.mean()) @ (t - t.mean()))),
    )


def gap(curves: list[tuple[np.ndarray, np.ndarray]], reference: list[tuple[np.ndarray, np.ndarray]]) -> float:
    """L2 norm of the mean of some curves (x, y) less the mean of the reference, over the norm of the latter."""
    both = curves + reference
    grid = np.linspace(max(x[0] for x, _ in both), min(x[-1] for x, _ in both), 200)
    mean, other = (np.mean([np.interp(grid, x, y) for x, y in group], axis=0) for group in (curves, reference))
    return float(np.linalg.norm(mean - other) / np.linalg.norm(other))
