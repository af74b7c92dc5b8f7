# SPDX-License-Identifier: MIT
"""What the series' runs say together: envelopes, cohesions, trends, curves of scaled samples."""

import dataclasses
import math

import numpy as np

import curves
from cases import MPA, SCALINGS, SEEDS, STRESSES, SURFACE_ENERGIES, Test
from curves import curve, envelope

DIAMETER = 0.23e-3  # m, mean-volume: Rumpf's d


class Results:
    """Runs of the series that are there, and the rows of the triaxial ones."""

    def __init__(self, made: dict[str, dict[Test, object]]) -> None:
        self.runs = {test: run for tests in made.values() for test, run in tests.items() if run}
        self.tests = {name: [test for test in tests if test in self.runs] for name, tests in made.items()}
        self.missing = [test for tests in made.values() for test in tests if test not in self.runs]
        self.rows = {}
        for test, run in self.runs.items():
            if test.scene == "oedometer":
                continue
            grains = run.summary()["stages"][-1]["end_state"]["grains"]
            self.rows[test] = curves.row(test, self.history(test, "shear"), grains, run.cpu_seconds)

    def history(self, test: Test, stage: str) -> dict[str, list[float]]:
        return self.runs[test].history(stage)

    def of(self, series: str, **wanted) -> list[Test]:
        return [
            test for test in self.tests[series] if all(getattr(test, key) == value for key, value in wanted.items())
        ]


def of_seeds(
    results: Results, series: str, seed: int, cohesive: bool, late: bool = False, **wanted
) -> curves.Envelope | None:
    rows = [results.rows[test] for test in results.of(series, seed=seed, **wanted)]
    if len(rows) < len(STRESSES):
        return None
    axial, lateral = ("late_axial", "late_lateral") if late else ("peak_axial", "peak_lateral")
    return envelope([getattr(row, axial) for row in rows], [getattr(row, lateral) for row in rows], cohesive)


def rumpf(energy: float, row: curves.Row) -> float:
    """Tensile strength after Rumpf, Pa: (1 - n) Z F_C / (pi d^2), F_C = 3 pi gamma R*, and Z bonds a grain."""
    bonds = 2 * row.bonds_start / row.grains
    return (1 - row.porosity) * bonds * 3 * math.pi * energy * DIAMETER / 4 / (math.pi * DIAMETER**2)


def cohesions(results: Results) -> dict[int, list[curves.Envelope]]:
    made = {
        energy: [fit for seed in SEEDS if (fit := of_seeds(results, "bonded", seed, True, surface_energy=energy))]
        for energy in SURFACE_ENERGIES
    }
    return {energy: fits for energy, fits in made.items() if fits}


@dataclasses.dataclass
class Line:
    slope: float
    intercept: float
    r2: float


def line(x, y) -> Line:
    x, y = np.array(x, float), np.array(y, float)
    slope, intercept = np.polyfit(x, y, 1)
    return Line(slope, intercept, 1 - ((y - intercept - slope * x) ** 2).sum() / ((y - y.mean()) ** 2).sum())


def cohesion_line(results: Results) -> Line:
    fits = cohesions(results)
    return line(list(fits), [np.mean([fit.cohesion for fit in of]) for of in fits.values()])


def rises(results: Results, value, along: str) -> list[str]:
    """Steps in stress or surface energy at which the mean over the seeds of what should rise does not."""
    other = "surface_energy" if along == "stress" else "stress"
    steps, fixed = (STRESSES, SURFACE_ENERGIES) if along == "stress" else (SURFACE_ENERGIES, STRESSES)
    falls = []
    for held in fixed:
        means = []
        for step in steps:
            made = [value(results.rows[test]) for test in results.of("bonded", **{along: step, other: held})]
            means.append((step, np.mean(made)) if made and not np.isnan(made).any() else None)
        for before, after in zip(means, means[1:]):
            if before and after and after[1] <= before[1]:
                names = {"stress": lambda v: f"{v / MPA:g} MPa", "surface_energy": lambda v: f"{v:g} J/m²"}
                falls.append(f"{names[along](before[0])} to {names[along](after[0])} at {names[other](held)}")
    return falls


def averaged(of):
    return lambda c: (curves.smooth(c.strain, c.strain), curves.smooth(of(c), c.strain))


def scaled_curves(
    results: Results, series: str, scene: str
) -> dict[tuple[str, int], list[tuple[np.ndarray, np.ndarray]]]:
    """Strain and stress of every scaling and seed: the deviator, or the axial stress of the oedometer's loading."""
    stage, made = ("load" if scene == "oedometer" else "shear"), {}
    for scheme, k in SCALINGS:
        tests = results.of(series, scene=scene, scheme=scheme, k=k)
        made[scheme, k] = [
            averaged(lambda c: c.axial if scene == "oedometer" else c.deviator)(curve(results.history(test, stage)))
            for test in tests
        ]
    return {scaling: of for scaling, of in made.items() if of}
