#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes docs/study.md, docs/study.csv and the figures in docs/study/ from the run folders of perf/study/run.py:

    perf/study/page.py [--folder runs/study]

Every number of the page comes from docs/study.csv; --from-csv writes the page anew from it, without the folders and the figures.
"""

from __future__ import annotations

import argparse
import datetime
import pathlib
import shutil
import subprocess
import sys
import tempfile

from PIL import Image

import findings
import results
from cases import CASES
from results import Row, number  # and perf/ on the path

from measure import DEFAULT_PROGRAM, ROOT
from page_parts import commit, machine, table

LARGEST = 300_000  # bytes of a figure
PAGE, CSV, FIGURES = ROOT / "docs/study.md", ROOT / "docs/study.csv", ROOT / "docs/study"
HEAD = """# The study: what comes out of the hole, and why

Made by `perf/study/page.py` from the runs of `perf/study/run.py`; do not edit. Page: {date}, commit {commit}, {machine}. The
numbers are in [study.csv](study.csv), with the commit of every run and what it ran on (a CPU's runs take one thread). The
paper is arXiv 2211.06142; its measured points and the data behind its curves are not available to us, so nothing here claims to match
them.

    perf/study/run.py --list                  # the cases
    perf/study/run.py ssw-k4                  # one of them, with what it starts from; into runs/study/ssw-k4
    perf/study/page.py                        # this page

## Set-up

Scenes: `scenes/paper/*.toml`; every choice that the paper leaves open is marked there ("Choice:"), the reasons are in `physics.md`. In short: a
sample of 18 × 18 × 9 mm is made and pressed to 1 MPa at a porosity of 0.41; all touching grains are bonded (modified JKR, γ = 30 J/m² times k,
a broken bond stays broken); a rod of 1.7 mm goes in 8.5 mm deep and out again; then the hole of 2.6 mm in the top plate opens, with water
injected from both sides at 0.1 mm/s (Di Felice's drag, fluid step 1 µs). Grains that pass the hole are counted. Time steps:
`speed_error.md`. k = 4 is the whole study with 4 219 grains: it is cheap, so controls and other samples are run there first:
three seeds at k = 4, one at k = 2 and at k = 1 (the perforation alone of another at k = 2 takes half an hour of one thread).
`drawdown-*` is `scenes/drawdown.toml` (4 200 grains, k = 2, bonds a hundredth of the paper's), one perforated sample under a series of pressures of
the reservoir above the well's.
"""


def shown(value: float | None, form: str, scale: float = 1) -> str:
    return "–" if value is None else format(scale * value, form)


def bonds_lost(row: Row, since: str, until: str) -> float | None:
    before, after = number(row, f"bonds_{since}"), number(row, f"bonds_{until}")
    return before - after if before is not None and after is not None else None


def samples(rows: list[Row]) -> str:
    lines = []
    for row in rows:
        bonds, lost = number(row, "bonds_pressed"), bonds_lost(row, "pressed", "perforated")
        lines.append([f"`{row['case']}`", row["what"], shown(number(row, "grains"), ".0f"), row["porosity"], row["contacts_per_grain"],
                      shown(bonds, ".0f"), shown(lost / bonds if bonds and lost is not None else None, ".1f", 100),
                      shown(number(row, "largest_overlap_perforation"), ".2f"), shown(number(row, "wall_pressing_s"), ".0f"),
                      shown(number(row, "wall_perforation_s"), ".0f")])
    return table(["case", "what", ">grains", ">porosity", ">contacts a grain", ">bonds", ">broken by the rod [%]", ">largest overlap / R",
                  ">pressing [s]", ">perforation [s]"], lines) + "\n"


def productions(rows: list[Row]) -> str:
    lines = []
    for row in rows:
        mass = number(row, "produced_kg")
        lines.append([f"`{row['case']}`", row["what"], shown(number(row, "production_s"), ".4g", 1e3), shown(mass, ".2f", 1e6),
                      row["produced_grains"], shown(number(row, "share_of_sample"), ".3f", 100),
                      *(shown(number(row, f"produced_at_{moment}ms_kg"), ".2f", 1e6) for moment in (3, 15)),
                      shown(number(row, "t50_s"), ".2f", 1e3), shown(number(row, "t90_s"), ".2f", 1e3),
                      shown(bonds_lost(row, "perforated", "end"), ".0f"), shown(number(row, "wall_production_s"), ".0f"),
                      row.get("on", "").replace(" 80GB HBM3", "")])
    return table(["case", "what", ">simulated [ms]", ">produced [mg]", ">grains", ">of the sample [%]", ">by 3 ms [mg]", ">by 15 ms [mg]",
                  ">t50 [ms]", ">t90 [ms]", ">bonds broken", ">wall time [s]", "on"], lines) + "\n"


def energy(rows: list[Row]) -> str:
    """µJ over the production: where the energy came from and where it went."""
    terms = [("stored in contacts, change", ("change_elastic_energy_J", "change_adhesive_energy_J", "change_tangential_energy_J")),
             ("work of gravity", ("work_gravity_J",)), ("work of drag", ("work_drag_J",)), ("work of the pressure gradient", ("work_pressure_J",)),
             ("work of walls", ("work_walls_J",)), ("lost in normal dashpots", ("loss_damping_J",)),
             ("lost in contact planes", ("loss_tangential_J",)), ("lost as bonds broke", ("loss_adhesion_J",)),
             ("left with the produced grains", ("energy_removed_J",)), ("residual", ("energy_residual_J",))]
    known = [row for row in rows if number(row, "work_gravity_J") is not None]
    if not known:
        return ""
    lines = []
    for name, columns in terms:
        cells = []
        for row in known:
            values = [number(row, column) for column in columns]
            cells.append(shown(sum(value for value in values if value is not None), ".4g", 1e6))
        lines.append([name, *cells])
    return table(["[µJ]", *(f">`{row['case']}`" for row in known)], lines) + "\n"


SAMPLES = [name for name, case in CASES.items() if case.start == f"{name}-perforated"]
K4_SAMPLES = [name for name in SAMPLES if name.startswith("ssw-k4")]
CONTROLLED = {"ssw": "Controls of `ssw`: one thing changed", "ssw-k4": "Controls of `ssw-k4`: one thing changed",
              "drawdown-20": "A series of drawdowns"}


def controls_of(base: str) -> list[str]:
    """The case and all that share its pressed or perforated sample."""
    return [name for name, case in CASES.items() if case.start in (f"{base}-pressed", f"{base}-perforated") and not case.until]


def store(picture: pathlib.Path, path: pathlib.Path) -> None:
    """A copy of at most LARGEST bytes, for the repository: with fewer colours, then smaller."""
    if picture.stat().st_size <= LARGEST:
        shutil.copyfile(picture, path)
        return
    image = Image.open(picture).convert("RGB")
    for width in (1300, 1100, 900, 700):
        image.resize((width, round(image.height * width / image.width)), Image.LANCZOS).quantize(128).save(path, optimize=True)
        if path.stat().st_size <= LARGEST:
            return


def draw(folder: pathlib.Path, program: str, cases: list[str], prefix: str, wanted: tuple[str, ...]) -> None:
    """Figures of `arenite report` of these cases, into docs/study."""
    if not cases:
        return
    FIGURES.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory() as scratch:
        report = pathlib.Path(scratch) / "report.html"
        subprocess.run([program, "report", *(str(folder / case) for case in cases), "-o", str(report)], check=True)
        for picture in sorted(report.with_suffix("").glob("*.png")):
            if any(word in picture.name for word in wanted):
                store(picture, FIGURES / (prefix + picture.name))


def page(rows: list[Row], where: dict[str, str]) -> str:
    parts = [HEAD.format(**where)]
    parts.append("\n## Samples\n\n" + samples([row for row in rows if row["case"] in SAMPLES]))
    parts.append("\n## Production: the paper's scene\n\n" + productions([row for row in rows if row["case"] in SAMPLES and "drawdown" not in row["case"]])
                 + "\nt50 and t90: when half and nine tenths of what came in the simulated time had come. Wall times of the CPU's runs are of a machine "
                 "that had other work to do as well. `original` was cut off by the end of its time on the card. The two cases on the card ran at a commit "
                 "whose deposit adds up in another order than today's on a GPU: today's program does not give the same bits, and single grains may differ.\n")
    for base, title in CONTROLLED.items():
        controls = [row for row in rows if row["case"] in controls_of(base)]
        if len(controls) < 2:
            continue
        parts.append(f"\n## {title}\n\n" + productions(controls))
        balance = energy(controls)
        if balance:
            parts.append("\nEnergy over the production:\n\n" + balance)
    others = [row for case in K4_SAMPLES for row in rows if row["case"].removesuffix("-no-fluid") == case]
    if any("seed" in row["case"] for row in others):
        parts.append("\n## Samples of k = 4, with and without water\n\n" + productions(others))
    for name, caption in findings.FIGURES.items():
        if (FIGURES / name).exists():
            parts.append(f"\n![{caption}](study/{name})\n\n*{caption}*\n")
    parts.append(findings.text(rows))
    return "".join(parts)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--folder", type=pathlib.Path, default=ROOT / "runs/study")
    parser.add_argument("--program", default=str(DEFAULT_PROGRAM))
    parser.add_argument("--from-csv", action="store_true", help="only the page, from docs/study.csv")
    options = parser.parse_args()
    if not options.from_csv:
        rows = results.collect(options.folder)
        if not rows:
            parser.error(f"no case of the study with a production in {options.folder}")
        results.write(rows, CSV)
        have = [row["case"] for row in rows]
        draw(options.folder, options.program, [case for case in have if case == "ssw"], "", ("figure-6", "figure-9"))
        draw(options.folder, options.program, [case for case in have if case == "original"], "original-", ("figure-9",))
        draw(options.folder, options.program, [case for case in controls_of("drawdown-20") if case in have], "drawdown-", ("figure-10", "figure-11"))
    PAGE.write_text(page(results.read(CSV), {"date": datetime.date.today().isoformat(), "commit": commit(), "machine": machine()}), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
