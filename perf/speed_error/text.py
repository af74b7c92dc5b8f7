# SPDX-License-Identifier: MIT
"""What docs/speed_error.md says around its tables."""

HEAD = """# Speed against error

Made by `perf/speed_error/run.py`; do not edit. {date}; {version}; {machine}, some of it beside
other programs. {minutes:.0f} minutes of one core in all. A cost is the processor time of a whole run on one thread,
start and output included. All rows: `perf/results/{name}/speed_error.csv`.

The sample (`perf/speed_error/sample.toml`) has the paper's grains, stiffness and bonds, but 1600 grains of k = 2 in a
box of 5 mm; it is pressed to 1 MPa, perforated and produced under 20 kPa. **A dense pack is chaotic**: a step longer by
1e-6 of itself gives another result. So a rung is a run of each of four random packs of the same sand, and its difference from
the first rung is the mean over the packs, each compared with itself; "±" is the standard error of that mean, from the
scatter of the differences in all rungs. A difference within twice its "±" is none that these runs can show. "One run ±" is
how far one pack stands for another.
"""

# title, figure, ladder, title of the settings, words
SECTIONS = [
    ("Time step", "time_step", "time step", "step / critical", """
The critical step is the lattice limit that `arenite check` prints: 1.389e-7 s for the sample, of which the paper's step
(1e-8 s at k = 1, so 2e-8 s at k = 2) is 0.144. The pairs are grains of 0.3 mm that meet at 2 m/s, 16 of them so that the
step falls differently into each contact. The lattice is 256 bonded grains without friction, at fractions of a limit of
its own. The energy balance is the largest residual over the work of the rod, or over the energy that the sample held.
Every production of a pack starts from the same perforated sample.
"""),
    ("Coupling interval", "coupling", "coupling", "grain steps per fluid step", """
Between fluid steps a grain keeps the fluid that the last one left. Steps of the settling grain are 2 us, those of the
sample 0.056 us; the seepage is that of the sections below.
"""),
    ("Coarse graining", "front", "k", "grains", """
Dry sand runs out of a hole of 2.6 mm in the floor (`discharge.toml`), where Beverloo's law, (1 - 1.4 d43/D)^2.5, says
what finite size costs. One random seed at k = 1, means over four of the others. The bonded sample at k = 1 takes too
long for a ladder.
"""),
    ("Cells", None, "cells", "cell", """
Seepage: water under 10 Pa through the pressed sample, its grains held, out of the hole (`bed.toml`); smoothing length
2 mm. The costs are those of four fluid steps.
"""),
    ("Smoothing length", None, "smoothing", "smoothing", """
Seepage with 20^3 cells. The largest grain is 0.71 mm.
"""),
    ("Pressure tolerance", None, "tolerance", "tolerance", """
Seepage with 20^3 cells, one step from rest. Later steps start from the pressure before them, so a steady flow converges
at any tolerance.
"""),
    ("Skin", None, "skin", "skin / smallest grain", """
A loose cloud of 512 sticky grains falls and piles up; its end state is hashed. No key of a scene sets the skin: it
follows how long lists last. In a box with periodic axes the bits depend on when lists are made (docs/physics.md), in
others nothing does.
"""),
]

# cases whose error is to fall with the setting: the slope of log error against log setting is shown
SLOPED = {"pair, Hertz, e = 0.8", "pair, JKR, e = 1", "elastic lattice", "sample, perforation", "sample, production",
          "C1, a grain settles"}

# what it is called, (ladder, case, quantity) of the error, (ladder, case, quantity) of the cost
FRONTS = [
    ("time step: Hertz rebound, worst", ("time step", "pair, Hertz, e = 0.8", "the same, worst of 16"),
     ("time step", "sample, production", "energy balance")),
    ("time step: energy balance", ("time step", "sample, production", "energy balance"),
     ("time step", "sample, production", "energy balance")),
    ("coupling: C1", ("coupling", "C1, a grain settles", "time to 63.2 % of the terminal speed"),
     ("coupling", "sample, production", "produced mass, kg")),
    ("k: discharge", ("k", "discharge", "discharged mass, kg"), ("k", "discharge", "discharged mass, kg")),
    ("cells: seepage", ("cells", "seepage", "flow through the hole"), ("cells", "seepage", "flow through the hole")),
    ("tolerance: seepage", ("tolerance", "seepage", "flow through the hole"),
     ("tolerance", "seepage", "flow through the hole")),
]

FRONT = """## Pareto front

On the front: no rung of the ladder is both cheaper and nearer. Drawn above, beside the discharge.
"""

BEHIND = """## No ladder

JKR is evaluated in one way (rational start and one Newton step, error 3e-13 F_C: docs/verification.md) and all numbers
are in double precision: there is nothing to choose.
"""
