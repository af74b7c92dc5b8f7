# SPDX-License-Identifier: MIT
"""Ladders of the grains: time step, random seed, coarse graining, skin."""
import random

import closed_forms
import rows
import sample
from runs import HERE


def time_step(runs):
    """Fractions of the critical step: closed forms, and each stage of the sample against its finest rung."""
    made = []
    for fraction in (0.05, 0.1, 0.2, 0.3, 0.4, 0.6, 0.8):
        def add(case, quantity, error, run, reference):
            made.append(rows.exact("time step", case, f"{fraction:g}", fraction, quantity, error, run, reference))

        for case, law in (("pair, Hertz, e = 0.8", "hertz"), ("pair, JKR, e = 1", "jkr")):
            mean, worst, run = closed_forms.rebound_errors(runs, fraction, law)
            add(case, "rebound speed / impact speed, mean of 16", mean, run, "closed form")
            add(case, "the same, worst of 16", worst, run, "closed form")
        swing, run = closed_forms.lattice_energy_error(runs, fraction)
        add("elastic lattice", "energy / kinetic energy at the start", swing, run, "conserved")
    fractions = (0.2, 0.4, 0.6, 0.8)
    for case, make in (("sample, perforation", sample.perforations), ("sample, production", sample.productions)):
        rungs = [sample.rung(f"{fraction:g}", make(runs, fraction)) for fraction in fractions]
        made += rows.of_rungs("time step", case, rungs, fractions, paired=True)
        made += rows.of_balances("time step", case, rungs, fractions)
    return made


SCHEMES = [("k = 1", "ssw", 1), ("k = 2", "ssw", 2), ("SSP, k = 2", "ssp", 2), ("k = 4", "ssw", 4)]
BEVERLOO = {"k = 1": 0.690, "k = 2": 0.447, "SSP, k = 2": 0.491, "k = 4": 0.135}  # (1 - 1.4 d43 / D)^2.5, D = 2.6 mm


def coarse_graining(runs):
    """Dry discharge through a hole, relative to k = 1, beside what Beverloo's law says of the same sizes."""
    rungs = []
    for label, scheme, k in SCHEMES:
        settings = {"coarse_graining.scheme": scheme, "coarse_graining.factor": k}
        discharges = []
        for seed in (1,) if k == 1 else (1, 2, 3, 4):
            settings["random_seed"] = seed
            discharges.append(runs.scene(f"discharge-{scheme}-{k}-{seed}", HERE / "discharge.toml", settings))
        masses = [run.history("discharge")["produced_mass"][-1] for run in discharges]
        rungs.append(sample.Rung(label, discharges, {"discharged mass, kg": masses}, None))
    made = rows.of_rungs("k", "discharge", rungs, range(len(SCHEMES)))
    for place, (label, factor) in enumerate(BEVERLOO.items()):
        loss = factor / BEVERLOO["k = 1"] - 1
        if place: made.append(rows.Row("k", "discharge", label, place, "Beverloo 1961", None, loss, None, None, None,
                                       "Beverloo at k = 1"))
    return made


def skin(runs, side=8, steps=100000):
    """A loose cloud falls and piles up; the state after it as a hash, which no skin may change."""
    chance, pitch, text = random.Random(1), 0.8e-3, ""
    for site in [(i, j, k) for k in range(side) for j in range(side) for i in range(side)]:
        radius = chance.uniform(0.15e-3, 0.35e-3)
        place = [(x + 0.5) * pitch + chance.uniform(-1, 1) * (pitch / 2 - radius) for x in site]
        text += " ".join(f"{x:.9g}" for x in (*place, radius)) + "\n"
    pack = runs.folder / "cloud.txt"
    pack.write_text(text)
    made, first = [], None
    for share in (0.03, 0.1, 0.2, 0.3, 0.5):
        result, run = runs.bench(f"skin-{share:g}", pack, "--law", "jkr", "--steps", str(steps), "--warm-up", "0",
                                 "--repeats", "1", "--gravity", "20000", "--skin", f"{share * 0.3e-3:g}")
        first = first or result["state_hash"]
        for quantity, value in (("searches", result["searches"]), ("candidates a grain", result["candidates_per_grain"]),
                                ("hashes unlike the first row's", int(result["state_hash"] != first))):
            made.append(rows.Row("skin", "falling cloud", f"{share:g}", share, quantity, value, None, None, run.cpu_seconds,
                                 side**3 * steps / run.cpu_seconds, "hash of the state"))
    return made
