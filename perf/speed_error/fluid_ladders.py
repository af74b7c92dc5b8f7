# SPDX-License-Identifier: MIT
"""Ladders of the water: coupling interval, cells, smoothing length, tolerance of the pressure solver."""
import closed_forms
import rows
import sample

HOLE = "flow through the hole"


def coupling(runs):
    """Grain steps per fluid step: a settling grain, water through held grains, and the production."""
    made = []
    for interval in (1, 3, 10, 30, 100, 300, 1000):
        error, run = closed_forms.settling(runs, interval)
        made.append(rows.exact("coupling", "C1, a grain settles", f"{interval}", interval,
                               "time to 63.2 % of the terminal speed", error, run, "closed form"))
    pressed, grain_step = sample.pressed(runs), sample.FRACTION * closed_forms.critical_step(friction=True)
    steady, _ = closed_forms.seepage(runs, pressed, 10, 2e-3)
    for step, count in ((1e-5, 300), (1e-4, 60), (1e-3, 30), (1e-2, 20)):
        value, run = closed_forms.seepage(runs, pressed, 10, 2e-3, step=step, count=count)
        made.append(rows.exact("coupling", "C13, steady seepage", f"{step:g} s", step / grain_step, HOLE,
                               value / steady - 1, run, "steps of 1 s", value))
    intervals = (1, 10, 36, 100, 1000)
    rungs = [sample.rung(f"{n}", sample.productions(runs, sample.FRACTION, interval=n)) for n in intervals]
    return made + rows.of_rungs("coupling", "sample, production", rungs, intervals, paired=True)


def _seepages(runs, ladder, settings, label, arguments, reference):
    """Rows of the seepage with one argument changed; the first setting is the reference."""
    made, first = [], None
    for setting in settings:
        value, run = closed_forms.seepage(runs, sample.pressed(runs), **arguments(setting))
        first = first or value
        error = value / first - 1 if made else None
        made.append(rows.exact(ladder, "seepage", label(setting), setting, HOLE, error, run, reference, value))
    return made


def cells(runs):
    made = _seepages(runs, "cells", (5 / 30, 0.25, 0.5, 1, 5 / 3), lambda size: f"{size:.3g} mm",
                     lambda size: {"cells": round(5 / size), "smoothing": 2e-3}, "0.167 mm")
    sizes = {"0.5 mm": 10, "1 mm": None, "1.67 mm": 3}  # the scene's own are of about 1 mm
    rungs = [sample.rung(label, sample.productions(runs, sample.FRACTION, cells=n)) for label, n in sizes.items()]
    return made + rows.of_rungs("cells", "sample, production", rungs, (0.5, 1, 5 / 3), paired=True)


def smoothing(runs):
    return _seepages(runs, "smoothing", (0.5e-3, 0.75e-3, 1e-3, 1.5e-3, 2e-3, 3e-3), lambda s: f"{s * 1e3:g} mm",
                     lambda s: {"cells": 20, "smoothing": s}, "0.5 mm")


def tolerance(runs):
    return _seepages(runs, "tolerance", (1e-12, 1e-10, 1e-8, 1e-6, 1e-4, 1e-2), lambda t: f"{t:g}",
                     lambda t: {"cells": 20, "smoothing": 2e-3, "tolerance": t, "count": 1}, "1e-12")
