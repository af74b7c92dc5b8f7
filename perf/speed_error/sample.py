# SPDX-License-Identifier: MIT
"""The small bonded sample: pressed once, then perforated and produced as a rung of a ladder says, several times over.

A dense pack is chaotic: a change of the step by 1e-6 of itself gives another result after some hundred collisions. So a
rung is one run of each of a few packs, and is compared with another rung pack by pack: two rungs differ only if their mean
difference is more than the scatter of the differences explains.
"""

import dataclasses
import math
import statistics

from closed_forms import critical_step
from runs import HERE

SCENE = HERE / "sample.toml"
FRACTION = 0.4  # of the critical step, where a ladder is not about it
FLUID_STEP = 2e-6  # s
PACKS = (1, 2, 3, 4)  # random seeds


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


def perforations(runs, fraction):
    """The perforation of every pressed pack."""
    made = []
    for seed in PACKS:
        settings = {"random_seed": seed, "stages.perforation.time_step_fraction": fraction}
        made.append(runs.scene(f"perforation-{fraction:g}-{seed}", SCENE, settings,
                               resume=pressed(runs, seed).last_checkpoint(), until="perforation"))
    return made


def productions(runs, fraction, interval=None, cells=None):
    """The production of every pack, perforated with FRACTION. A fluid step is `interval` grain steps, or the number nearest
    to FLUID_STEP; `cells` are those of each axis."""
    interval = interval or round(FLUID_STEP / (fraction * critical_step(friction=True)))
    made = []
    for seed, perforated in zip(PACKS, perforations(runs, FRACTION)):
        settings = {"random_seed": seed, "stages.perforation.time_step_fraction": FRACTION,
                    "stages.production.time_step_fraction": fraction, "fluid.coupling_interval": interval,
                    "fluid.time_step": 0}
        if cells: settings["fluid.cells"] = [cells] * 3
        made.append(runs.scene(f"production-{fraction:g}-{interval}-{cells or 'scene'}-{seed}", SCENE, settings,
                               resume=perforated.last_checkpoint()))
    return made


def _pooled(groups):
    """Standard deviation of values about the mean of their group, over all groups."""
    squares = [(value - statistics.fmean(group)) ** 2 for group in groups for value in group]
    freedom = sum(len(group) - 1 for group in groups)
    return math.sqrt(sum(squares) / freedom)


def scatter(rungs, quantity):
    """Standard deviation of a run about the mean of its rung."""
    return _pooled([rung.values[quantity] for rung in rungs])


def difference(rung, reference, quantity, deviation):
    """(mean - reference's mean) / reference's mean, and its standard error where runs of two rungs have nothing in common."""
    base = reference.mean(quantity)
    error = deviation * math.sqrt(1 / len(rung.runs) + 1 / len(reference.runs)) / abs(base)
    return (rung.mean(quantity) - base) / base, error


def _changes(rung, reference, quantity):
    """Relative difference from the reference, pack by pack."""
    return [(value - base) / base for value, base in zip(rung.values[quantity], reference.values[quantity], strict=True)]


def paired_scatter(rungs, reference, quantity):
    """Standard deviation of a pack's difference from the reference about the mean of its rung."""
    return _pooled([_changes(rung, reference, quantity) for rung in rungs if rung is not reference])


def paired_difference(rung, reference, quantity, deviation):
    """Mean over the packs of the relative difference from the reference, and its standard error."""
    return statistics.fmean(_changes(rung, reference, quantity)), deviation / math.sqrt(len(rung.runs))
