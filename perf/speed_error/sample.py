# SPDX-License-Identifier: MIT
"""The small bonded sample: pressed once, then perforated and produced as a rung of a ladder says, several times over.

A dense pack is chaotic: a change of the step by 1e-6 of itself gives another result after some hundred collisions. So a rung is a
few such runs, and two rungs differ only if their means differ by more than the scatter of the runs explains.
"""
import dataclasses
import math
import statistics

from closed_forms import critical_step
from runs import HERE

SCENE = HERE / "sample.toml"
FRACTION = 0.4  # of the critical step, where a ladder is not about it
FLUID_STEP = 2e-6  # s


def _last(column):
    return lambda rows: rows[column][-1]


def _stored(rows, row):
    return sum(rows[name][row] for name in ("elastic_energy", "adhesive_energy", "tangential_energy"))


# name, unit, stage, value from the history of that stage
QUANTITIES = [
    ("bonds broken in the perforation", "", "perforation", lambda rows: rows["bonds"][0] - rows["bonds"][-1]),
    ("work of the rod", "J", "perforation", _last("work_walls")),
    ("energy stored after the perforation", "J", "perforation", lambda rows: _stored(rows, -1)),
    ("bonds broken in the production", "", "production", lambda rows: rows["bonds"][0] - rows["bonds"][-1]),
    ("energy released in the production", "J", "production", lambda rows: _stored(rows, 0) - _stored(rows, -1)),
    ("produced mass", "kg", "production", _last("produced_mass")),
]


@dataclasses.dataclass
class Rung:
    label: str
    runs: list  # of runs.Run
    values: dict  # quantity: list of a value a run
    residual: dict  # stage: largest |energy residual| / work done in the stage

    def mean(self, quantity): return statistics.fmean(self.values[quantity])

    def cpu_seconds(self): return statistics.fmean(run.cpu_seconds for run in self.runs)

    def grain_steps_per_second(self): return sum(r.grain_steps() for r in self.runs) / sum(r.cpu_seconds for r in self.runs)


def pressed(runs, seed=1):
    """The sample after its compression."""
    return runs.scene(f"pressed-{seed}", SCENE, {"random_seed": seed}, until="compression")


def rung(label, made):
    """`made` are runs of the perforation and the production, or of one of them."""
    values, residual = {}, {}
    stages = [stage["name"] for stage in made[0].summary()["stages"]]
    histories = [{stage: run.history(stage) for stage in stages} for run in made]
    for name, _, stage, value in QUANTITIES:
        if stage in stages: values[name] = [value(history[stage]) for history in histories]
    for stage in stages:
        residual[stage] = max(max(abs(x) for x in h[stage]["energy_residual"]) / (h[stage]["work_walls"][-1] or _stored(h[stage], 0))
                              for h in histories)
    return Rung(label, made, values, residual)


def perforations(runs, fraction, count, seed=1):
    """`count` runs of the perforation from the pressed sample, their steps apart by 1e-6."""
    start = pressed(runs, seed).last_checkpoint()
    return [runs.scene(f"perforation-{fraction:g}-{seed}-{n}", SCENE,
                       {"random_seed": seed, "stages.perforation.time_step_fraction": fraction * (1 + 1e-6 * n)}, resume=start,
                       until="perforation") for n in range(count)]


def productions(runs, name, count, settings, fraction=FRACTION, seed=1):
    """`count` runs of the production from one perforated sample, the grains' steps apart by 1e-6. Fluid steps are whole numbers of
    grain steps, so the interval is given, not the fluid's step: FLUID_STEP in the nearest number of them."""
    start = perforations(runs, FRACTION, 1, seed)[0].last_checkpoint()
    interval = round(FLUID_STEP / (fraction * critical_step(friction=True)))
    return [runs.scene(f"production-{name}-{seed}-{n}", SCENE,
                       {"random_seed": seed, "stages.perforation.time_step_fraction": FRACTION,
                        "stages.production.time_step_fraction": fraction * (1 + 1e-6 * n), "fluid.coupling_interval": interval,
                        "fluid.time_step": 0} | settings, resume=start) for n in range(count)]


def scatter(rungs, quantity):
    """Standard deviation of a run about the mean of its rung, pooled over rungs of several runs."""
    squares = [(value - r.mean(quantity))**2 for r in rungs for value in r.values[quantity] if len(r.runs) > 1]
    freedom = sum(len(r.runs) - 1 for r in rungs)
    return math.sqrt(sum(squares) / freedom)


def difference(r, reference, quantity, deviation):
    """(mean - reference's mean) / reference's mean, and its standard error."""
    base = reference.mean(quantity)
    return (r.mean(quantity) - base) / base, deviation * math.sqrt(1 / len(r.runs) + 1 / len(reference.runs)) / abs(base)
