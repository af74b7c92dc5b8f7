# SPDX-License-Identifier: MIT
"""The small bonded sample: pressed once, then perforated and produced as a rung of a ladder says, several times over.

A dense pack is chaotic: a change of the step by 1e-6 of itself gives another result after some hundred collisions. So a
rung is a few such runs, and two rungs differ only if their means differ by more than the scatter of the runs explains.
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


# name, stage, value from the history of that stage
QUANTITIES = [
    ("broken bonds", "perforation", lambda rows: rows["bonds"][0] - rows["bonds"][-1]),
    ("work of the rod, J", "perforation", _last("work_walls")),
    ("energy stored at its end, J", "perforation", lambda rows: _stored(rows, -1)),
    ("broken bonds", "production", lambda rows: rows["bonds"][0] - rows["bonds"][-1]),
    ("released energy, J", "production", lambda rows: _stored(rows, 0) - _stored(rows, -1)),
    ("produced mass, kg", "production", _last("produced_mass")),
]


@dataclasses.dataclass
class Rung:
    label: str
    runs: list  # of runs.Run
    values: dict  # quantity: list of a value a run
    residual: float | None  # largest |energy residual| / work of the rod, or energy held at the start without one

    def mean(self, quantity):
        return statistics.fmean(self.values[quantity])

    def cpu_seconds(self):
        return statistics.fmean(run.cpu_seconds for run in self.runs)

    def grain_steps_per_second(self):
        return sum(r.grain_steps() for r in self.runs) / sum(r.cpu_seconds for r in self.runs)


def pressed(runs, seed=1):
    """The sample after its compression."""
    return runs.scene(f"pressed-{seed}", SCENE, {"random_seed": seed}, until="compression")


def rung(label, made):
    """`made` are runs of the perforation, or of the production."""
    stage = made[0].summary()["stages"][-1]["name"]
    histories = [run.history(stage) for run in made]
    values = {name: [value(rows) for rows in histories] for name, of, value in QUANTITIES if of == stage}
    held = [rows["work_walls"][-1] or _stored(rows, 0) for rows in histories]
    residual = max(max(abs(x) for x in rows["energy_residual"]) / whole for rows, whole in zip(histories, held))
    return Rung(label, made, values, residual)


def perforations(runs, fraction, count, seed=1):
    """`count` runs of the perforation from the pressed sample, their steps apart by 1e-6."""
    start, made = pressed(runs, seed).last_checkpoint(), []
    for n in range(count):
        settings = {"random_seed": seed, "stages.perforation.time_step_fraction": fraction * (1 + 1e-6 * n)}
        name = f"perforation-{fraction:g}-{seed}-{n}"
        made.append(runs.scene(name, SCENE, settings, resume=start, until="perforation"))
    return made


def productions(runs, fraction, count, seed=1, interval=None, cells=None):
    """`count` runs of the production from one perforated sample, the grains' steps apart by 1e-6. A fluid step is
    `interval` grain steps, or the number nearest to FLUID_STEP; `cells` are those of each axis."""
    start = perforations(runs, FRACTION, 1, seed)[0].last_checkpoint()
    interval = interval or round(FLUID_STEP / (fraction * critical_step(friction=True)))
    settings = {"random_seed": seed, "stages.perforation.time_step_fraction": FRACTION}
    made = []
    for n in range(count):
        settings["stages.production.time_step_fraction"] = fraction * (1 + 1e-6 * n)
        settings |= {"fluid.coupling_interval": interval, "fluid.time_step": 0}
        if cells: settings["fluid.cells"] = [cells] * 3
        name = f"production-{fraction:g}-{interval}-{cells or 'scene'}-{seed}-{n}"
        made.append(runs.scene(name, SCENE, settings, resume=start))
    return made


def scatter(rungs, quantity):
    """Standard deviation of a run about the mean of its rung, pooled over rungs of several runs."""
    squares = [(value - r.mean(quantity)) ** 2 for r in rungs for value in r.values[quantity] if len(r.runs) > 1]
    freedom = sum(len(r.runs) - 1 for r in rungs)
    return math.sqrt(sum(squares) / freedom)


def difference(r, reference, quantity, deviation):
    """(mean - reference's mean) / reference's mean, and its standard error."""
    base = reference.mean(quantity)
    return (r.mean(quantity) - base) / base, deviation * math.sqrt(1 / len(r.runs) + 1 / len(reference.runs)) / abs(
        base
    )
