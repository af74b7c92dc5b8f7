# SPDX-License-Identifier: MIT
"""A row of the table: what was set, what it cost, how far a named quantity is from its reference."""
import dataclasses

import sample


@dataclasses.dataclass
class Row:
    ladder: str
    case: str
    setting: str
    position: float  # of the setting on the axis of a figure
    quantity: str
    value: float | None
    error: float | None  # relative to the reference, or absolute where that is 0; None: this row is the reference
    uncertainty: float | None  # relative standard error of `error` where runs scatter; the reference's: of one run
    cpu_seconds: float | None
    grain_steps_per_second: float | None
    reference: str


def exact(ladder, case, setting, position, quantity, error, run, reference, value=None):
    """Of a case without scatter."""
    speed = run.grain_steps() / run.cpu_seconds if "seepage" not in case else None  # held grains make no steps
    return Row(ladder, case, setting, position, quantity, value, error, None, run.cpu_seconds, speed, reference)


def of_rungs(ladder, case, rungs, positions, paired=False):
    """Every quantity of ensembles against the first of them; paired: pack by pack."""
    reference, rows = rungs[0], []
    for quantity in reference.values:
        deviation = sample.scatter(rungs, quantity)
        doubt = sample.paired_scatter(rungs, reference, quantity) if paired else deviation
        compare = sample.paired_difference if paired else sample.difference
        for rung, position in zip(rungs, positions):
            error, uncertainty = compare(rung, reference, quantity, doubt)
            if rung is reference:
                error, uncertainty = None, deviation / abs(rung.mean(quantity))
            rows.append(Row(ladder, case, rung.label, position, quantity, rung.mean(quantity), error, uncertainty,
                            rung.cpu_seconds(), rung.grain_steps_per_second(), f"mean of {len(reference.runs)} runs"))
    return rows


def of_balances(ladder, case, rungs, positions):
    """What is missing in the energy balances of the same runs."""
    return [Row(ladder, case, rung.label, position, "energy balance", None, rung.residual, None, rung.cpu_seconds(),
                rung.grain_steps_per_second(), "conserved") for rung, position in zip(rungs, positions)]
