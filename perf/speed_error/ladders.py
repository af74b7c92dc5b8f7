# SPDX-License-Identifier: MIT
"""The ladders: each gives rows of what was set, what it cost and how far named quantities are from their reference."""
import dataclasses
import json
import math
import random

import closed_forms
import sample
from runs import HERE, SCENES


GRAIN_STEP = sample.FRACTION * closed_forms.critical_step(friction=True)  # s


@dataclasses.dataclass
class Row:
    ladder: str
    case: str
    setting: str
    position: float  # of the setting on the axis of a figure
    quantity: str
    value: float
    error: float  # relative to the reference, or absolute where that is 0; None: this row is the reference
    uncertainty: float | None  # standard error of `error`, where runs scatter
    cpu_seconds: float
    grain_steps_per_second: float | None
    reference: str


def rows_of_rungs(ladder, case, rungs, positions, reference_at):
    """Rows of every quantity of ensembles against the rung `reference_at`."""
    reference, rows = rungs[reference_at], []
    for quantity in reference.values:
        deviation = sample.scatter(rungs, quantity)
        for n, (rung, position) in enumerate(zip(rungs, positions)):
            is_reference = n == reference_at
            error, uncertainty = sample.difference(rung, reference, quantity, deviation)
            rows.append(Row(ladder, case, rung.label, position, quantity, rung.mean(quantity), None if is_reference else error,
                            deviation / abs(rung.mean(quantity)) if is_reference else uncertainty, rung.cpu_seconds(),
                            rung.grain_steps_per_second(), f"mean of {len(reference.runs)} at {reference.label}"))
    return rows


def balance_rows(ladder, rungs, positions):
    return [Row(ladder, "sample", rung.label, position, f"energy balance of the {stage}", None, residual, None, rung.cpu_seconds(),
                rung.grain_steps_per_second(), "conserved")
            for rung, position in zip(rungs, positions) for stage, residual in rung.residual.items()]


def time_step(runs):
    """Fractions of the critical step: closed forms, and each stage of the sample against its finest rung."""
    rows = []
    for fraction in (0.05, 0.1, 0.2, 0.3, 0.4, 0.6, 0.8):
        for name, law in (("Hertz, e = 0.8", "hertz"), ("JKR, e = 1", "jkr")):
            mean, worst, run = closed_forms.rebound_errors(runs, fraction, law)
            for quantity, error in (("rebound speed / impact speed, mean of 16", mean), ("the same, worst of 16", worst)):
                rows.append(Row("time step", f"pair, {name}", f"{fraction:g}", fraction, quantity, None, error, None, run.cpu_seconds,
                                None, "closed form"))
        error, run = closed_forms.lattice_energy_error(runs, fraction)
        rows.append(Row("time step", "elastic lattice", f"{fraction:g}", fraction, "energy / kinetic energy at the start", None, error,
                        None, run.cpu_seconds, run.grain_steps() / run.cpu_seconds, "conserved"))
    counts = {0.1: 2, 0.2: 3, 0.4: 4, 0.6: 4, 0.8: 4}
    for make in (lambda f, n: sample.perforations(runs, f, n), lambda f, n: sample.productions(runs, f"step-{f:g}", n, {}, f)):
        rungs = [sample.rung(f"{fraction:g}", make(fraction, count)) for fraction, count in counts.items()]
        rows += rows_of_rungs("time step", "sample", rungs, counts, 0) + balance_rows("time step", rungs, counts)
    return rows


def seeds(runs):
    """Other packs of the same sand: how far one sample stands for another."""
    rows = []
    for stage in ("perforation", "production"):
        made = [run for seed in (1, 2, 3, 4)
                for run in (sample.perforations(runs, sample.FRACTION, 1, seed) if stage == "perforation"
                            else sample.productions(runs, f"step-{sample.FRACTION:g}", 1, {}, seed=seed))]
        rung = sample.rung("4 seeds", made)
        rows += [Row("seeds", "sample", rung.label, 0, quantity, rung.mean(quantity), None,
                     sample.scatter([rung], quantity) / abs(rung.mean(quantity)), rung.cpu_seconds(), rung.grain_steps_per_second(),
                     "their mean") for quantity in rung.values]
    return rows


def coupling(runs):
    """Grain steps per fluid step: a settling grain against the closed form, and the production."""
    rows = []
    for interval in (1, 3, 10, 30, 100, 300, 1000):
        error, run = closed_forms.settling(runs, interval)
        rows.append(Row("coupling", "C1, 0.3 mm grain settles", f"{interval}", interval, "time to 63.2 % of the terminal speed", None,
                        error, None, run.cpu_seconds, run.grain_steps() / run.cpu_seconds, "closed form"))
    steady, _ = closed_forms.seepage(runs, sample.pressed(runs), 10, 2e-3)
    for step, count in ((1e-5, 300), (1e-4, 60), (1e-3, 30), (1e-2, 20)):
        value, run = closed_forms.seepage(runs, sample.pressed(runs), 10, 2e-3, step=step, count=count)
        rows.append(Row("coupling", "C13, water through held grains", f"{step:g} s", step / GRAIN_STEP, "steady flow", value,
                        value / steady - 1, None, run.cpu_seconds, None, "steps of 1 s"))
    intervals = (1, 10, 36, 100, 1000)
    rungs = [sample.rung(f"{n}", sample.productions(runs, f"interval-{n}", 3, {"fluid.coupling_interval": n})) for n in intervals]
    return rows + rows_of_rungs("coupling", "sample", rungs, intervals, 0) + balance_rows("coupling", rungs, intervals)


SCHEMES = [("k = 1", "ssw", 1, 12800), ("k = 2", "ssw", 2, 1600), ("SSP 2", "ssp", 2, 1600), ("k = 4", "ssw", 4, 200)]
BEVERLOO = {"k = 1": 0.690, "k = 2": 0.447, "SSP 2": 0.491, "k = 4": 0.135}  # (1 - 1.4 d43 / D)^2.5, D = 2.6 mm


def coarse_graining(runs):
    """Dry discharge against Beverloo's law, and the sample, softer so that k = 1 can be paid: all relative to k = 1."""
    rates, rows = {}, []
    for label, scheme, k, _ in SCHEMES:
        made = [runs.scene(f"discharge-{scheme}-{k}-{seed}", HERE / "discharge.toml",
                           {"coarse_graining.scheme": scheme, "coarse_graining.factor": k, "random_seed": seed})
                for seed in ((1, 2) if k == 1 else (1, 2, 3, 4))]
        rates[label] = [run.history("discharge")["produced_mass"][-1] for run in made], made
    rung_of = {label: sample.Rung(label, made, {"discharged mass": values}, {}) for label, (values, made) in rates.items()}
    ks = [k for _, _, k, _ in SCHEMES]
    rows += rows_of_rungs("k", "discharge", list(rung_of.values()), ks, 0)
    rows += [Row("k", "Beverloo 1961", label, k, "discharged mass", None, BEVERLOO[label] / BEVERLOO["k = 1"] - 1, None, math.nan, None,
                 "Beverloo at k = 1") for label, _, k, _ in SCHEMES[1:]]
    soft = {"materials.sand.youngs_modulus": 2e9, "materials.sand.surface_energy": 3}
    soft |= {f"stages.{stage}.time_step_fraction": sample.FRACTION for stage in ("compression", "perforation", "production")}
    rungs = [sample.rung(label, [runs.scene(f"coarse-{scheme}-{k}-{seed}", sample.SCENE,
                                            soft | {"coarse_graining.scheme": scheme, "coarse_graining.factor": k, "random_seed": seed,
                                                    "particles.distribution.count": count})
                                 for seed in ((1,) if k == 1 else (1, 2, 3, 4))]) for label, scheme, k, count in SCHEMES]
    return rows + rows_of_rungs("k", "softer sample", rungs, ks, 0)


def fluid_grid(runs):
    """Cells and smoothing length: flow through the held sample, and the production."""
    def flow(cells, smoothing, tolerance=1e-8):
        return closed_forms.seepage(runs, sample.pressed(runs), cells, smoothing, tolerance=tolerance)

    rows = []
    finest, _ = flow(40, 2e-3)
    for cells in (3, 5, 10, 20):
        value, run = flow(cells, 2e-3)
        rows.append(Row("cells", "seepage", f"{5 / cells:.3g} mm", 5 / cells, "flow through the hole", value, value / finest - 1, None,
                        run.cpu_seconds, None, "40^3 cells"))
    for smoothing in (0.5e-3, 0.75e-3, 1e-3, 1.5e-3, 2e-3, 3e-3):
        value, run = flow(20, smoothing)
        rows.append(Row("smoothing", "seepage", f"{smoothing * 1e3:g} mm", smoothing * 1e3, "flow through the hole", value,
                        value / flow(20, 0.5e-3)[0] - 1, None, run.cpu_seconds, None, "0.5 mm, 20^3 cells"))
    tightest, _ = flow(20, 2e-3, 1e-12)
    for tolerance in (1e-2, 1e-4, 1e-6, 1e-8, 1e-10):
        value, run = flow(20, 2e-3, tolerance)
        rows.append(Row("tolerance", "seepage", f"{tolerance:g}", tolerance, "flow through the hole", value, value / tightest - 1, None,
                        run.cpu_seconds, None, "1e-12"))
    grids = (10, 5, 3)
    rungs = [sample.rung(f"{5 / n:.3g} mm", sample.productions(runs, f"cells-{n}", 3, {"fluid.cells": [n, n, n]})) for n in grids]
    return rows + rows_of_rungs("cells", "sample", rungs, [5 / n for n in grids], 0)


def skin(runs):
    """A loose cloud falls and piles up; the state after it as a hash, which no skin may change."""
    chance, pitch, side = random.Random(1), 0.8e-3, 8
    pack = runs.folder / "grains/cloud.txt"
    pack.parent.mkdir(parents=True, exist_ok=True)
    radii = [(0.15 + 0.2 * chance.random()) * 1e-3 for _ in range(side**3)]
    sites = [(i, j, k) for k in range(side) for j in range(side) for i in range(side)]
    pack.write_text("".join(" ".join(f"{(x + 0.5) * pitch + chance.uniform(-1, 1) * (pitch / 2 - r):.9g}" for x in site) + f" {r:.9g}\n"
                            for site, r in zip(sites, radii)))
    rows = []
    for share in (0.03, 0.1, 0.2, 0.3, 0.5):
        result = json.loads(runs.text("bench", "--pack", str(pack), "--law", "jkr", "--steps", "40000", "--warm-up", "0", "--repeats",
                                      "1", "--gravity", "20000", "--skin", f"{share * 0.3e-3:g}"))
        reference = rows[0].value if rows else int(result["state_hash"], 16)
        rows.append(Row("skin", "falling cloud", f"{share:g} d", share, "hash of the state", int(result["state_hash"], 16),
                        float(int(result["state_hash"], 16) != reference), None, side**3 * 40000 / result["particle_steps_per_s"],
                        result["particle_steps_per_s"], f"{result['searches']} searches"))
    return rows


LADDERS = {"time_step": time_step, "seeds": seeds, "coupling": coupling, "k": coarse_graining, "fluid": fluid_grid, "skin": skin}
