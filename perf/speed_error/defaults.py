# SPDX-License-Identifier: MIT
"""The table of values that the ladders support, with the numbers that say so."""
import page_parts

STEP = ("time step",)
PRODUCTION = "sample, production"
HOLE = "flow through the hole"
FALL = "time to 63.2 % of the terminal speed"
MASS = "produced mass, kg"
DISCHARGE = "discharged mass, kg"
BALANCE = "energy balance"
SWING = "energy / kinetic energy at the start"


def defaults(rows):
    def row(ladder, case, setting, quantity):
        found, = [r for r in rows if (r.ladder, r.case, r.setting, r.quantity) == (ladder, case, setting, quantity)]
        return found

    def error(*where):
        error, uncertainty = row(*where).error, row(*where).uncertainty
        return f"{100 * error:.2g} %" if uncertainty is None else f"{100 * error:+.1f} ± {100 * uncertainty:.1f} %"

    def share(ladder, case, setting, other, quantity):
        return f"{row(ladder, case, setting, quantity).cpu_seconds / row(ladder, case, other, quantity).cpu_seconds:.2f}"

    lines = [
        ("`time_step_fraction`", "0.4", f"""
         Against 0.2, at {share(*STEP, PRODUCTION, "0.4", "0.2", BALANCE)} of its cost: work of the rod
         {error(*STEP, "sample, perforation", "0.4", "work of the rod, J")}, bonds that it breaks
         {error(*STEP, "sample, perforation", "0.4", "broken bonds")}; produced mass {error(*STEP, PRODUCTION, "0.4", MASS)},
         released energy {error(*STEP, PRODUCTION, "0.4", "released energy, J")}, bonds that break meanwhile
         {error(*STEP, PRODUCTION, "0.4", "broken bonds")}; the balance lacks {error(*STEP, PRODUCTION, "0.4", BALANCE)}.
         One pack differs from another by far more (below).
         Hertz's rebound is off by {error(*STEP, "pair, Hertz, e = 0.8", "0.4", "the same, worst of 16")} at worst. At 0.6
         the rod's work is off by {error(*STEP, "sample, perforation", "0.6", "work of the rod, J")} and the energy of an
         elastic lattice swings by {error(*STEP, "elastic lattice", "0.6", SWING)} of the kinetic energy
         ({error(*STEP, "elastic lattice", "0.4", SWING)} at 0.4)"""),
        ("`fluid.time_step`", "at most 0.02 ms", f"""
         A settling grain's time is off by {error("coupling", "C1, a grain settles", "10", FALL)} with it, by
         {error("coupling", "C1, a grain settles", "100", FALL)} with 0.2 ms; 0.056 ms changes the produced mass by
         {error("coupling", PRODUCTION, "1000", MASS)}. A steady state depends on no step"""),
        ("`coarse_graining.factor`", "1 where it can be paid", f"""
         k = 2 discharges {error("k", "discharge", "k = 2", DISCHARGE)}
         (Beverloo {error("k", "discharge", "k = 2", "Beverloo 1961")}) at
         {share("k", "discharge", "k = 2", "k = 1", DISCHARGE)} of the cost, SSP
         {error("k", "discharge", "SSP, k = 2", DISCHARGE)}, k = 4 {error("k", "discharge", "k = 4", DISCHARGE)}"""),
        ("`fluid.cells`", "0.5 mm at a hole of 2.6 mm", f"""
         The flow is off by {error("cells", "seepage", "1 mm", HOLE)} at 1 mm,
         {error("cells", "seepage", "0.5 mm", HOLE)} at 0.5 mm, {error("cells", "seepage", "0.25 mm", HOLE)} at
         0.25 mm"""),
        ("`fluid.smoothing_length`", "1.4 of the largest grain or more", f"""
         Against 0.5 mm, the flow changes by {error("smoothing", "seepage", "1 mm", HOLE)} with 1 mm (1.4 of the largest
         grain), by {error("smoothing", "seepage", "2 mm", HOLE)} with 2 mm, by {error("smoothing", "seepage", "3 mm", HOLE)}
         with 3 mm: no longer a matter of the length"""),
        ("`fluid.pressure_tolerance`", "1e-8", f"""
         1e-4 is off by {error("tolerance", "seepage", "0.0001", HOLE)} at
         {share("tolerance", "seepage", "0.0001", "1e-08", HOLE)} of the cost"""),
    ]
    columns = ["key", "value that the ladders support", "why"]
    cells = [[key, value, " ".join(why.split())] for key, value, why in lines]
    return "## Defaults\n\n" + page_parts.table(columns, cells) + "\n"
