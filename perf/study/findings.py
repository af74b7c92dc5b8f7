# SPDX-License-Identifier: MIT
"""What the study's rows say: sentences and the table against the paper, each made from the numbers."""

from __future__ import annotations

import statistics

from cases import CASES
from results import EARLY, Row, early_column, number  # and perf/ on the path

import measure
from page_parts import table

FIGURES = {  # of `arenite report`, as the page shows them
    "drawdown-figure-10-produced-mass.png": "Produced mass over time at the drawdowns of `drawdown.toml`.",
    "drawdown-figure-11-mass-by-class.png": "Produced mass by size class.",
    "figure-6-bonds.png": "Section through the axis of the paper's sample: bonds a grain at 0, 50 and 100 % of the perforation.",
    "figure-9-fluid.png": "Half section of the paper's sample in the production: fluid speed and streamlines.",
    "figure-9-grains.png": "The same with the speed of the grains.",
    "original-figure-9-fluid.png": "The original, 270 000 grains: fluid speed and streamlines 10 ms into the production.",
    "original-figure-9-grains.png": "The same with the speed of the grains: what the rod broke loose fills its hole.",
}


def find(rows: list[Row], case: str) -> Row | None:
    return next((row for row in rows if row["case"] == case), None)


def value(row: Row | None, column: str) -> float:
    """0 where there is none."""
    return row and number(row, column) or 0.0


def length_ms(row: Row) -> str:
    return f"{1e3 * value(row, 'production_s'):.3g} ms"


def paper_scene(rows: list[Row]) -> str:
    """Whether the paper's scene gives sand, and what the controls change."""
    cases = [row for row in rows if row["case"].split("-")[0] in ("original", "ssw", "ssp")]
    lines = []
    dry = [row for row in cases if value(row, "produced_grains") == 0]
    if dry:
        lines.append("- **The paper's scene, as these runs understand it, gives next to no sand**: none in " +
                     ", ".join(f"`{row['case']}` ({length_ms(row)})" for row in dry) +
                     ". The water's force on a grain is an eighth of its weight in water, and a millionth of a bond's strength "
                     "(`scenes/drawdown.toml` has the figures), the rod's withdrawal has relaxed what it pressed, and the opened hole's rim is held by bonds.")
    for row in cases:
        if value(row, "produced_grains") > 0:
            lines.append(f"- `{row['case']}` ({row['what']}) gives {1e6 * value(row, 'produced_kg'):.3g} mg, "
                         f"{row['produced_grains']} grain{'s' if row['produced_grains'] != '1' else ''}, in {length_ms(row)}, the last at "
                         f"{1e3 * value(row, 'last_grain_s'):.3g} ms.")
    lines += water(rows) + paper_step(rows) + crushed(rows)
    return "\n".join(lines)


def water(rows: list[Row]) -> list[str]:
    """With and without water, sample by sample."""
    pairs = [(wet, dry) for base in CASES if (wet := find(rows, base)) and (dry := find(rows, f"{base}-no-fluid")) and "drawdown" not in base]
    if not pairs:
        return []
    grains = [int(value(row, "produced_grains")) for pair in pairs for row in pair]
    line = "- **With and without water**: " + "; ".join(
        f"`{wet['case']}` {mass_and_grains(wet)} with, {mass_and_grains(dry)} without" for wet, dry in pairs) + "."
    neither = find(rows, "ssw-k4-neither")
    if neither:
        line += f" With neither water nor gravity `ssw-k4` gives {mass_and_grains(neither)}."
    if any(value(dry, "produced_grains") > 0 for _, dry in pairs):
        line += " So the water is not needed for a grain to leave."
    more, less = (sum(sign * (value(dry, "produced_kg") - value(wet, "produced_kg")) > 0 for wet, dry in pairs) for sign in (1, -1))
    if more == len(pairs) > 2:
        line += (f" In each of the {len(pairs)} samples more leaves without it than with it: its drag takes energy from the grains (table above), "
                 f"it brakes what the stored stress throws up. {sum(grains)} grains are few, but all say the same.")
    elif sum(grains) < 100:
        line += (f" Without it more leaves in {more} and less in {less} of {len(pairs)} sample{'s' if len(pairs) > 1 else ''}: "
                 f"{sum(grains)} grains in all do not tell whether the water drives them or holds them back.")
    return [line]


def mass_and_grains(row: Row) -> str:
    return f"{1e6 * value(row, 'produced_kg'):.3g} mg ({row['produced_grains']})"


def paper_step(rows: list[Row]) -> list[str]:
    """What the paper's time step changes over what both runs have simulated."""
    own, small = find(rows, "ssw-k4"), find(rows, "ssw-k4-paper-step")
    named = {"loss_tangential": "what is lost in contact planes", "loss_damping": "in dashpots", "work_drag": "and the work of drag"}
    terms = {early_column(term): name for term, name in named.items()}
    if not own or not small or not all(value(row, term) for row in (own, small) for term in terms):
        return []
    changes = ", ".join(f"{name} by {100 * (value(small, term) / value(own, term) - 1):+.2g} %" for term, name in terms.items())
    same = "; as many bonds and as much sand" if all(own[c] == small[c] for c in ("bonds_end", "produced_kg")) else ""
    return [f"- **The paper's step** (1e-8 s against {value(own, 'time_step_s'):g} s at k = 4) changes, over {1e3 * EARLY:g} ms, {changes}{same}."]


def crushed(rows: list[Row]) -> list[str]:
    """Samples that the rod squeezes beyond what a contact law holds for."""
    found = {row["case"]: value(row, "largest_overlap_perforation") for row in rows if f"{row['case']}-perforated" == CASES[row["case"]].start}
    beyond = {case: overlap for case, overlap in found.items() if overlap > 0.4}
    if not beyond:
        return []
    within = [overlap for case, overlap in found.items() if case not in beyond and overlap > 0]
    return ["- **The rod stops 0.5 mm above the bottom plate**, less than a grain of k = 4. Grains that it catches there overlap by " +
            ", ".join(f"{overlap:.2f} R (`{case}`)" for case, overlap in beyond.items()) +
            "; contact laws hold to 0.1" + (f" (which no sample keeps: the others reach {min(within):.2f} to {max(within):.2f})" if within else "") +
            ". So the bottom of a hole at k = 4 is none to believe, one more way in which so coarse a sample fails."]


def drawdown_cases() -> list[str]:
    """The series with water, by pressure."""
    wet = [name for name, case in CASES.items() if case.scene == "drawdown.toml" and not case.until and case.note.endswith("kPa")]
    return sorted(wet, key=lambda name: float(CASES[name].note.split()[0]))


def drawdowns(rows: list[Row]) -> str:
    series = [row for case in drawdown_cases() if (row := find(rows, case))]
    if not series:
        return ""
    lines = ["- **Where seepage begins to matter** (`scenes/drawdown.toml`, bonds a hundredth of the paper's): " + "; ".join(
        f"{row['what']}: {1e6 * value(row, 'produced_kg'):.3g} mg" for row in series) + "."]
    control = find(rows, "drawdown-20-no-fluid")
    base = find(rows, "drawdown-20")
    if control and base:
        share = value(control, "produced_kg") / value(base, "produced_kg") if value(base, "produced_kg") else 0
        lines.append(f"- Without water the sample of `drawdown-20` gives {1e6 * value(control, 'produced_kg'):.3g} mg, "
                     f"{100 * share:.2g} % of what it gives at 20 kPa: the rest is owed to the flow.")
    for row in series:
        by_3, end = value(row, "produced_at_3ms_kg"), value(row, "produced_kg")
        t90 = 1e3 * value(row, "t90_s")
        if end > 0:
            kind = "transient" if t90 < 0.6e3 * value(row, "production_s") else "continuous"
            lines.append(f"- {row['what']}: {100 * by_3 / end:.0f} % of it within 3 ms, nine tenths by {t90:.3g} ms of {length_ms(row)}: {kind}.")
    return "\n".join(lines)


def produced(row: Row) -> str:
    """Mass at the moments that the run reached."""
    moments = [(moment, row.get(f"produced_at_{moment}ms_kg")) for moment in (3, 15, 40)]
    return ", ".join(f"{1e6 * float(mass):.3g} mg by {moment} ms" for moment, mass in moments if mass)


def speed_up_of_two() -> str:
    """k = 2 over k = 1 from perf/scaling, whose runs of the two have the same volume of sand and steps in proportion to k."""
    parts = []
    for path in sorted((measure.ROOT / "perf/scaling").glob("*.csv"))[:1]:
        comments, rows = measure.read_table(path)
        for threads in sorted({row["threads"] for row in rows}):
            seconds = {k: [float(row["wall_time"]) for row in rows if row["k"] == k and row["threads"] == threads] for k in ("1", "2")}
            if all(seconds.values()):
                ratio = statistics.median(seconds["1"]) / statistics.median(seconds["2"])
                parts.append(f"{ratio:.3g} on {threads} thread{'s' if threads != '1' else ''} ({ratio / 2:.2g} at one time step)")
    return ", ".join(parts) + f"; `perf/scaling`, {comments[0]}, {comments[1].split(',')[0]}" if parts else "not timed side by side: `perf/scaling/run.py`"


def against_paper(rows: list[Row]) -> str:
    ssw, ssp, original = (find(rows, case) for case in ("ssw", "ssp", "original"))
    lines = [("the injected water carries the sand out (section 4)",
              "no: see above and the controls without water" if ssw and value(ssw, "produced_grains") < 100 else
              "see the controls without water"),
             ("production is transient and over before 0.04 s (fig 10)",
              f"in `drawdown.toml` at 20 kPa nine tenths come by {1e3 * value(find(rows, 'drawdown-20'), 't90_s'):.3g} ms"
              if find(rows, "drawdown-20") else "not run")]
    three = "; ".join(f"`{name}` " + ("not run" if row is None else produced(row)) for name, row in
                      (("original", original), ("ssw", ssw), ("ssp", ssp)))
    handful = all(value(row, "produced_grains") < 100 for row in (original, ssw, ssp))
    lines.append(("SSW is closer to the original than SSP (RMSRE 13 % and 20 %)",
                  three + (": too few grains for an RMSRE to mean anything" if handful else "; RMSRE: `arenite report`")))
    lines.append(("SSP equals the original at first, then exceeds it (fig 10)", "the same masses" + (", a handful of grains each" if handful else "")))
    lines.append(("speed-ups of 8.1 and 9.4 by k = 2 (table 5)", speed_up_of_two()))
    return table(["the paper", "here"], lines) + "\n"


def text(rows: list[Row]) -> str:
    parts = ["\n## What it shows\n", paper_scene(rows), drawdowns(rows)]
    return "\n".join(part for part in parts if part) + "\n\n## Against the paper's statements\n\n" + against_paper(rows)
