# SPDX-License-Identifier: MIT
"""Tables of docs/material.md: dry sand, and what all tables share."""

import numpy as np

import page_parts
from cases import FRICTIONS, MPA, SEEDS, STRESSES
from curves import angle
from results import Results, of_seeds


def spread(values: list[float], digits: int = 1, scale: float = 1) -> str:
    """Mean, and half the range over the seeds."""
    if not values:
        return "–"
    return f"{np.mean(values) * scale:.{digits}f} ± {(max(values) - min(values)) / 2 * scale:.{digits}f}"


def verdict(passes: bool) -> str:
    return "yes" if passes else "**no**"


def dry_table(results: Results, series: str) -> str:
    lines = []
    for friction in FRICTIONS:
        for late, what in ((False, "peak"), (True, "last fifth of the strain")):
            seeds = [seed for seed in SEEDS if of_seeds(results, series, seed, False, late, friction=friction)]
            if not seeds:
                continue
            forced, free = (
                [of_seeds(results, series, seed, cohesive, late, friction=friction) for seed in seeds]
                for cohesive in (False, True)
            )
            angles, straightness = [fit.angle for fit in forced], min(fit.r2 for fit in forced)
            range_ = max(angles) - min(angles)
            in_band = verdict(25 <= np.mean(angles) <= 33) if friction == 0.5 and not late else "–"
            gates = ["–", "–"] if late else [verdict(straightness > 0.99), verdict(range_ < 1) if len(seeds) > 1 else "–"]
            lines.append(
                [
                    f"{friction}",
                    what,
                    str(len(seeds)),
                    spread(angles, 2),
                    f"{range_:.2f}",
                    f"{straightness:.5f}",
                    spread([fit.cohesion for fit in free], 1, 1e-3),
                    *gates,
                    in_band,
                ]
            )
    columns = [">μ", "state", ">seeds", ">φ [deg]", ">range of φ [deg]", ">least R²", ">c′ if not forced to 0 [kPa]"]
    return page_parts.table([*columns, "R² > 0.99", "range < 1°", "25 to 33°"], lines)


def dry_cases(results: Results, series: str) -> str:
    lines = []
    for friction in FRICTIONS:
        for stress in STRESSES:
            rows = [results.rows[test] for test in results.of(series, friction=friction, stress=stress)]
            if not rows:
                continue
            lines.append(
                [
                    f"{friction}",
                    f"{stress / MPA:g}",
                    spread([row.porosity for row in rows], 4),
                    spread([angle(row.peak_axial, row.peak_lateral) for row in rows], 2),
                    spread([row.peak_strain for row in rows], 1, 100),
                    spread([angle(row.late_axial, row.late_lateral) for row in rows], 2),
                    spread([row.modulus for row in rows], 0, 1e-6),
                    f"{100 * max(row.lateral_error for row in rows):.1f}",
                ]
            )
    return page_parts.table(
        [
            ">μ",
            ">confinement [MPa]",
            ">porosity before",
            ">φ peak [deg]",
            ">at strain [%]",
            ">φ late [deg]",
            ">E50 [MPa]",
            ">lateral stress off by at most [%]",
        ],
        lines,
    )


def checks_table(results: Results, series: str) -> str:
    lines = []
    for test in results.tests[series]:
        row = results.rows[test]
        what = [f"{row.grains} grains"]
        if test.slowness != 1:
            what.append(f"a {test.slowness:g}rd of the rate")
        if test.confined_friction:
            what.append(f"confined with μ = {test.confined_friction:g}")
        lines.append(
            [
                ", ".join(what),
                f"{row.porosity:.4f}",
                f"{angle(row.peak_axial, row.peak_lateral):.2f}",
                f"{(row.peak_axial - row.peak_lateral) / MPA:.3f}",
                f"{100 * row.peak_strain:.1f}",
                f"{row.modulus / MPA:.0f}",
            ]
        )
    return page_parts.table(
        [
            "changed",
            ">porosity before",
            ">φ peak [deg], no cohesion",
            ">peak deviator [MPa]",
            ">at strain [%]",
            ">E50 [MPa]",
        ],
        lines,
    )
