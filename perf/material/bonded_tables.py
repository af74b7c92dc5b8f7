# SPDX-License-Identifier: MIT
"""Tables of docs/material.md: cemented sand, and coarse graining."""

import math

import numpy as np

import curves
import page_parts
from cases import MPA, SCALINGS, STRESSES, SURFACE_ENERGIES
from curves import curve
from results import Results, cohesion_line, cohesions, rises, rumpf, scaled_curves
from tables import spread, verdict


def bonded_table(results: Results) -> str:
    lines = []
    for energy, fits in cohesions(results).items():
        rows = [results.rows[test] for test in results.of("bonded", surface_energy=energy)]
        strength = np.mean([rumpf(energy, row) for row in rows])
        cohesion = np.mean([fit.cohesion for fit in fits])
        tensile = [fit.cohesion / math.tan(math.radians(fit.angle)) for fit in fits]
        lines.append(
            [
                f"{energy}",
                spread([fit.cohesion for fit in fits], 1, 1e-3),
                spread([fit.angle for fit in fits], 1),
                f"{min(fit.r2 for fit in fits):.4f}",
                spread(tensile, 0, 1e-3),
                f"{strength / 1e3:.0f}",
                f"{cohesion / strength:.2f}" if energy else "–",
            ]
        )
    return page_parts.table(
        [
            ">γ [J/m²]",
            ">c′ [kPa]",
            ">φ′ [deg]",
            ">least R² of the envelope",
            ">c′ cot φ′ [kPa]",
            ">Rumpf [kPa]",
            ">c′ / Rumpf",
        ],
        lines,
    )


def bonded_cases(results: Results) -> str:
    lines = []
    for energy in SURFACE_ENERGIES:
        for stress in STRESSES:
            rows = [results.rows[test] for test in results.of("bonded", surface_energy=energy, stress=stress)]
            if not rows:
                continue
            lost = lambda share: spread([1 - getattr(row, share) for row in rows], 1, 100) if energy else "–"
            lines.append(
                [
                    f"{energy}",
                    f"{stress / MPA:g}",
                    spread([row.porosity for row in rows], 4),
                    spread([(row.peak_axial - row.peak_lateral) for row in rows], 3, 1e-6),
                    spread([row.peak_strain for row in rows], 2, 100),
                    spread([row.modulus for row in rows], 0, 1e-6),
                    spread([2 * row.bonds_start / row.grains for row in rows], 2) if energy else "–",
                    lost("bonds_peak"),
                    lost("bonds_end"),
                    f"{100 * max(row.lateral_error for row in rows):.0f}",
                ]
            )
    return page_parts.table(
        [
            ">γ [J/m²]",
            ">confinement [MPa]",
            ">porosity before",
            ">peak deviator [MPa]",
            ">at strain [%]",
            ">E50 [MPa]",
            ">bonds a grain",
            ">broken at the peak [%]",
            ">broken at 6 % strain [%]",
            ">lateral stress off by at most [%]",
        ],
        lines,
    )


def trends(results: Results) -> str:
    lines = []
    for what, value, along in (
        ("peak deviator rises with γ", lambda row: row.peak_axial - row.peak_lateral, "surface_energy"),
        ("peak deviator rises with the confinement", lambda row: row.peak_axial - row.peak_lateral, "stress"),
        ("E50 rises with γ", lambda row: row.modulus, "surface_energy"),
        ("E50 rises with the confinement", lambda row: row.modulus, "stress"),
        ("bonds broken at the peak rise with the confinement", lambda row: 1 - row.bonds_peak, "stress"),
        ("bonds broken at the end rise with the confinement", lambda row: 1 - row.bonds_end, "stress"),
    ):
        falls = rises(results, value, along)
        lines.append([what, verdict(not falls), "; ".join(falls) or "–"])
    fit = cohesion_line(results)
    lines.insert(
        0,
        [
            f"c′ linear in γ, R² > 0.98: {fit.slope / 1e3:.2f} kPa per J/m², {fit.intercept / 1e3:+.1f} kPa at 0, "
            f"R² = {fit.r2:.4f}",
            verdict(fit.r2 > 0.98),
            "–",
        ],
    )
    return page_parts.table(["expected", "holds", "not from"], lines)


def scaled_table(results: Results, series: str) -> str:
    lines = []
    for scene in ("oedometer", "triaxial_bonded"):
        made = scaled_curves(results, series, scene)
        if ("ssw", 1) not in made:
            continue
        reference = made.pop(("ssw", 1))
        scatter = max(curves.gap([one], reference) for one in reference) if len(reference) > 1 else None
        lines.append(
            [scene, "k = 1", f"{len(reference)}", "–", "–" if scatter is None else f"{100 * scatter:.1f}", "–", "–"]
        )
        for (scheme, k), of in made.items():
            mean, most = curves.gap(of, reference), max(curves.gap([one], of) for one in of)
            gate = verdict(mean < 0.05) if k == 2 else "–"
            within = "–" if scatter is None else verdict(mean < max(scatter, most))
            lines.append(
                [
                    scene,
                    f"k = {k}, {scheme.upper()}",
                    f"{len(of)}",
                    f"{100 * mean:.1f}",
                    f"{100 * most:.1f}",
                    gate,
                    within,
                ]
            )
    return page_parts.table(
        [
            "test",
            "grains",
            ">seeds",
            ">L2 gap of the mean curve to k = 1 [%]",
            ">largest gap of one seed to its mean [%]",
            "below 5 %",
            "within the scatter of the seeds",
        ],
        lines,
    )


def oedometer_table(results: Results, series: str) -> str:
    lines = []
    for scheme, k in SCALINGS:
        rest, most, modulus = [], [], []
        for test in results.of(series, scene="oedometer", scheme=scheme, k=k):
            c = curve(results.history(test, "load"))
            rest.append(c.lateral[-1] / c.axial[-1])
            most.append(c.axial[-1])
            half = len(c.strain) // 2
            modulus.append((c.axial[-1] - c.axial[half]) / (c.strain[-1] - c.strain[half]))
        if rest:
            lines.append(
                [f"k = {k}, {scheme.upper()}", spread(most, 2, 1e-6), spread(modulus, 0, 1e-6), spread(rest, 3)]
            )
    return page_parts.table(
        ["grains", ">σz at 3 % strain [MPa]", ">tangent modulus, 1.5 to 3 % [MPa]", ">K0 = σx / σz there"], lines
    )
