# SPDX-License-Identifier: MIT
"""What docs/speed_error.md says around its tables; numbers in it come from the rows."""
import page_parts

HEAD = """# Speed against error

Made by `perf/speed_error/run.py build/openmp/apps/arenite`; do not edit. {date}; {version}; {machine}, other programs running.
{minutes:.0f} minutes of one core in all. Cost is the processor time of a whole run on one thread, start and output included. All rows:
`perf/results/epyc-2core/speed_error.csv`.

The sample (`perf/speed_error/sample.toml`) has the paper's grains, stiffness and bonds, but 1600 grains at k = 2 in a box of 5 mm:
it is pressed to 1 MPa, perforated and produced under 20 kPa. **A dense pack is chaotic**: a step longer by 1e-6 of itself gives another
result. So a rung is the mean of 2 to 4 such runs; "±" is the standard error of its difference from the reference, from the
scatter of all rungs; the reference's own row shows the scatter of a single run. A difference within twice its "±" is not one.
"""

# title, figure, ladder, title of the settings, words
SECTIONS = [
    ("Time step", "time_step", "time step", "step / critical step",
     "The critical step is the lattice limit that `arenite check` prints (1.389e-7 s for the sample; 0.144 of it is the paper's step). "
     "The pairs are grains of 0.3 mm at 2 m/s, the lattice 256 bonded grains without friction, on the limit of its own. An energy "
     "balance is the residual over the work of the rod, or over the energy that the sample held.\n"),
    ("Another sample", None, "seeds", "packs", "The same ladder's rung 0.4 with four random packs: how far one sample stands for another.\n"),
    ("Coupling interval", "coupling", "coupling", "grain steps per fluid step",
     "Between fluid steps a grain feels the drag of the last one. The settling grain's steps are 2 us, the sample's 0.056 us.\n"),
    ("Coarse graining", "front", "k", "grains",
     "Discharge by weight through a hole of 2.6 mm in the floor (`discharge.toml`), where Beverloo's law says what finite size costs; then the "
     "whole of the sample's stages at a tenth of the stiffness and surface energy, so that 12 800 grains of k = 1 can be paid. "
     "Rungs are means over random seeds, 1 or 2 of them at k = 1.\n"),
    ("Cells", None, "cells", "cell",
     "Seepage: water under 10 Pa through the pressed sample, its grains held, out of the hole (`bed.toml`); smoothing length 2 mm.\n"),
    ("Smoothing length", None, "smoothing", "mm", "Seepage with 20^3 cells. The largest grain is 0.71 mm.\n"),
    ("Pressure tolerance", None, "tolerance", "tolerance", "Seepage with 20^3 cells.\n"),
    ("Skin", None, "skin", "skin / smallest grain",
     "A loose cloud of 512 sticky grains falls and piles up. The error is 0 where the hash of the end state is that of the first row. In a run "
     "the skin follows how long lists last; in a box with periodic axes the bits depend on when lists are made "
     "(docs/physics.md, Determinism), in others nothing does.\n"),
]

# ladder and quantity in words, (ladder, case, quantity) of the error, and of the cost
FRONTS = [
    ("time step: Hertz rebound, worst", ("time step", "pair, Hertz, e = 0.8", "the same, worst of 16"),
     ("time step", "sample", "produced mass")),
    ("time step: energy balance", ("time step", "sample", "energy balance of the production"), ("time step", "sample", "produced mass")),
    ("coupling: C1 time", ("coupling", "C1, 0.3 mm grain settles", "time to 63.2 % of the terminal speed"),
     ("coupling", "sample", "produced mass")),
    ("k: discharged mass", ("k", "discharge", "discharged mass"), ("k", "discharge", "discharged mass")),
    ("cells: seepage", ("cells", "seepage", "flow through the hole"), ("cells", "seepage", "flow through the hole")),
    ("tolerance: seepage", ("tolerance", "seepage", "flow through the hole"), ("tolerance", "seepage", "flow through the hole")),
]

BEHIND = """## No ladder

JKR is evaluated in one way (closed start and one Newton step, error 3e-13 F_C: docs/verification.md) and everything in double precision:
there is nothing to choose.
"""


def defaults(rows):
    return ""
