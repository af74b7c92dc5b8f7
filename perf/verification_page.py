#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes docs/verification.md from one run of `arenite verify`; every number in the page comes from that run.

    perf/verification_page.py build/openmp/apps/arenite [--mutations FILE] [--rows FILE ...]

--mutations: the table that tests/mutations/run.py --out wrote. --rows: JSON of `arenite verify GROUP --json` made
before, instead of running it here. Figures are drawn to docs/verification_*.png where matplotlib is there.
"""
import argparse
import collections
import datetime
import json
import pathlib
import subprocess
import time

import page_parts
from page_parts import ROOT, number

PAGE = ROOT / "docs/verification.md"

HEAD = """# Verification

Made by `perf/verification_page.py`; do not edit. {date}, commit {commit}, {machine}.
{count} checks, {failed} failed{seconds}. `arenite verify` prints the same rows; ctest runs the same functions, a test a group
(`ctest -R verify_`). An error is relative, or absolute where the reference is 0; for a bound (an order, a count) it is what
is missing.
"""

FINDINGS = """
## What the runs taught

- **Cavity at Re 100.** A finer grid comes no nearer to Ghia's table (F1): the table itself is off in v by up to 0.9 % of the
  lid's speed (row `v at x = 0.8594`). So v is held against values by stream function and vorticity, and the table serves
  for u only.
- **Slope at a wall.** The straight slope over half a cell had left Brinkman's layer with a pointwise error of
  (lambda h)^2/8 in the first cell, beyond the gate at 8 cells per 1/lambda (F3). The slope is now that of the parabola
  through the wall and two nodes; Poiseuille's profile is exact on any grid.
- **Coarse grains at an end of the fluid's box.** The random packs of C4c and G4 are periodic along the flow. Cut at an inlet
  and an outlet, where the kernel mirrors the grains, a pack of k = 4 (0.7 cells to a grain) has an uneven porosity within the
  kernel's radius of both ends and resists a few per cent more; a lattice whose sites take the sizes at random, without
  having been pressed, is uneven everywhere and resists far more.
- **Free surfaces.** Within the kernel's radius (1.5 cells) of a bed's surface grains feel a porosity mixed with the clear
  fluid: a fluidised bed has a dense cap there. Its mean height is right (C5b), its top cell is not.
- **Holes on the paper's grid.** The flux through a hole is exact, the pressure that drives it is not: F8's last row has as its
  limit the change of the inlet pressure from 12 to 24 cells, as its value that from 24 to 48.

## Left out

| case | why |
| --- | --- |
| D9: MFIX DEM01 | its contact is a linear spring; no law of a scene is. D10 is run with Hertz contacts for the same reason |
| F1: Re 400 | in the convergence test `converge_cavity`, 32^2 and 64^2 |
| F1: Re 400 to 128^2, Re 1000 to 160^2 | minutes on one core: in the convergence test `converge_cavity_gates`, run by name (`ctest -C long -L long`) |
| F5: viscous forms A1, A3 | the solver has n div(tau) (A2) only |
| F9: 128^3 cells | in the convergence test `converge_pressure_solver` |
| C2: d/x = 4 | 1e5 cells for one grain; d/x = 2 shows the same slip as 1 |
| C6, C8 to C12, D18 to D20, G5 | studies of scenes, not closed forms |
| D16, D17, G3 | [material.md](material.md), by `perf/material/run.py`; in small `verify_triaxial` in ctest |
| D15 | `verify_walls` in ctest |
| H1 to H11, H13 to H20 | hard cases, not closed forms: `ctest -L 'stability|determinism'`; `grep -rw H16 tests` finds the test of one |
| H18: several ranks | the program refuses to start as one of several: it has no domain decomposition |
| H18: GPU | `ctest -L determinism` compares a GPU's runs with each other; a CPU's bits are others, its sums round elsewhere |
| H20: 1e6 steps | 4e4 of them: a test of seconds |
| H21: fp32 | a number is a double everywhere: no scene uses another precision, and 4 digits of an overlap in 18 mm are too few; the laws alone in single precision would save a fifth of a step ([performance.md](performance.md), what did not pay) |
"""


def run(program, files):
    if files:
        return [row for file in files for row in json.loads(pathlib.Path(file).read_text())], None
    start = time.time()
    output = subprocess.run([program, "verify", "--json"], capture_output=True, text=True).stdout
    return json.loads(output), time.time() - start


def table(rows):
    return page_parts.table(
        ["case", "quantity", ">value", ">reference", ">error", ">limit", "source"],
        [[row["name"], row["quantity"], number(row["value"], 8), number(row["reference"], 8), number(row["error"], 2),
          number(row["limit"], 2) + ("" if row["pass"] else " **FAIL**"), row["source"]] for row in rows])


def draw(rows):
    """Margin of every row, and the observed orders; names of the files that were written."""
    try:
        import matplotlib
        matplotlib.use("Agg")
        import matplotlib.pyplot as plt
    except ImportError:
        return []
    written = []
    shares = collections.defaultdict(list)
    for row in rows:
        if row["limit"] and row["error"]:
            shares[row["group"]].append(row["error"] / row["limit"])
    figure, axes = plt.subplots(figsize=(8, 3.2))
    for place, (group, values) in enumerate(shares.items()):
        axes.plot(values, [place] * len(values), "|", markersize=14)
    axes.axvline(1, color="k", linewidth=0.8)
    axes.set_xscale("log")
    axes.set_yticks(range(len(shares)), list(shares))
    axes.set_xlabel("error / limit")
    figure.tight_layout()
    figure.savefig(ROOT / "docs/verification_margins.png", dpi=110, bbox_inches="tight")
    written.append(("verification_margins.png", "Error over limit of every row"))
    orders = [row for row in rows if "order" in row["quantity"]]
    figure, axes = plt.subplots(figsize=(8, 0.22 * len(orders) + 0.8))
    axes.plot([row["value"] for row in orders], range(len(orders)), "o", markersize=4)
    axes.plot([row["reference"] for row in orders], range(len(orders)), "|", color="k", markersize=9)
    axes.set_yticks(range(len(orders)), [f"{row['name']}: {row['quantity']}" for row in orders], fontsize=6)
    axes.set_xlabel("observed order (dot); expected, or the least allowed (bar)")
    axes.invert_yaxis()
    figure.tight_layout()
    figure.savefig(ROOT / "docs/verification_orders.png", dpi=110, bbox_inches="tight")
    written.append(("verification_orders.png", "Observed orders"))
    return written


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", help="the arenite program")
    parser.add_argument("--mutations", type=pathlib.Path)
    parser.add_argument("--rows", nargs="*")
    arguments = parser.parse_args()
    rows, seconds = run(arguments.program, arguments.rows)
    page = [HEAD.format(date=datetime.date.today().isoformat(), commit=page_parts.commit(), machine=page_parts.machine(),
                        count=len(rows), failed=sum(not row["pass"] for row in rows),
                        seconds=f", {seconds:.0f} s" if seconds else "")]
    page += [f"![{title}]({name})\n" for name, title in draw(rows)]
    for group in dict.fromkeys(row["group"] for row in rows):
        page.append(f"\n## {group}\n\n" + table([row for row in rows if row["group"] == group]))
    page.append(FINDINGS)
    page.append("## Mutations\n\n`tests/mutations/run.py` breaks the physics in one place at a time and asks `arenite verify` whether it "
                "notices. It is run by name (half an hour), not by ctest, and fails if a mutation survives.\n")
    page.append(arguments.mutations.read_text() if arguments.mutations else "Not part of this page's run.\n")
    PAGE.write_text("\n".join(page))


if __name__ == "__main__":
    main()
