# SPDX-License-Identifier: MIT
"""docs/material.md from the runs of the series, and the CSV of all triaxial tests."""

import dataclasses
import datetime

import bonded_tables
import curves
import figures
import measure
import page_parts
import tables
import text
from results import Results, cohesions


def write(work, made) -> None:
    """docs/material.md, its figures and the CSV of all rows."""
    results = Results(made)
    figures.FOLDER.mkdir(exist_ok=True)
    comments = measure.header(measure.program_info(work.program))[:2] + ["perf/material/run.py, one thread a run"]
    columns = [field.name for field in dataclasses.fields(curves.Row)]
    measure.write_table(
        measure.results_folder() / "material.csv", comments, columns, map(dataclasses.astuple, results.rows.values())
    )
    parts = [
        text.HEAD.format(
            date=datetime.date.today().isoformat(),
            version=work.version,
            machine=page_parts.machine(),
            minutes=work.cpu_seconds() / 60,
            name=measure.machine_name(),
        )
    ]
    if results.missing:
        parts.append(f"Not run: {len(results.missing)} of the tests, the first `{results.missing[0].name}`.\n")
    for section in (dry, bonded, scaled):
        parts += section(results)
    (measure.ROOT / "docs/material.md").write_text("\n".join(parts), encoding="utf-8")


def dry(results: Results) -> list[str]:
    if not results.tests["dry"]:
        return []
    figures.draw_dry(results)
    parts = [
        text.DRY,
        "![Curves and envelope of dry sand](material/dry.png)\n",
        tables.dry_table(results, "dry") + "\n",
        tables.dry_cases(results, "dry") + "\n",
    ]
    for series, words in (("dry-stiff", text.DRY_STIFF), ("dry-large", text.DRY_LARGE)):
        if results.tests[series]:
            parts += [words, tables.dry_table(results, series) + "\n", tables.dry_cases(results, series) + "\n"]
    if results.tests["dry-checks"]:
        parts += [text.DRY_CHECKS, tables.checks_table(results, "dry-checks") + "\n"]
    return parts


def bonded(results: Results) -> list[str]:
    if not cohesions(results):
        return []
    figures.draw_bonded(results)
    parts = [
        text.BONDED,
        "![Curves and envelopes of cemented sand](material/bonded.png)\n",
        bonded_tables.bonded_table(results) + "\n",
        bonded_tables.trends(results) + "\n",
        bonded_tables.bonded_cases(results) + "\n",
    ]
    if results.tests["bonded-checks"]:
        parts += [text.BONDED_CHECKS, tables.checks_table(results, "bonded-checks") + "\n"]
    return parts


def scaled(results: Results) -> list[str]:
    parts = []
    for series, words in (("scaled", text.SCALED), ("scaled-large", text.SCALED_LARGE)):
        if not results.tests[series]:
            continue
        figures.draw_scaled(results, series)
        parts += [
            words,
            f"![Curves at every k](material/{series}.png)\n",
            bonded_tables.scaled_table(results, series) + "\n",
            bonded_tables.oedometer_table(results, series) + "\n",
        ]
    return parts
