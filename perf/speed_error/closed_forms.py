# SPDX-License-Identifier: MIT
"""Small cases whose exact results are known: what they need, and their errors."""

import csv
import math
import random
import zlib

from runs import HERE, SCENES

DENSITY, E_STAR = 2605, 2e10 / (2 * (1 - 0.3**2))  # kg/m3, Pa: of two grains of the sand
G_STAR = 2e10 / (2 * (1 + 0.3)) / (2 * (2 - 0.3))  # Pa
DIAMETER, GAMMA = 0.3e-3, 60.0  # m, J/m2: the smallest grain of the sample and its surface energy at k = 2
MASS = DENSITY * math.pi / 6 * DIAMETER**3
PRESSURE = 1e6  # Pa


def contact_radius(force):
    """Of two such grains under JKR, m."""
    adhesion = 6 * math.pi * GAMMA * DIAMETER / 4
    return math.cbrt(0.75 * DIAMETER / 4 / E_STAR * (force + adhesion + math.sqrt(2 * adhesion * force + adhesion**2)))


def critical_step(friction):
    """2 / omega_max of a face-centred lattice of the grains at PRESSURE, s: core/critical_time_step.cpp."""
    radius = contact_radius(PRESSURE * DIAMETER**2 / (2 * math.sqrt(2)))
    if friction:
        return 2 * math.sqrt(3 * MASS / (10 * 12 * 8 * G_STAR * radius))
    return 2 / math.sqrt(8 * 2 * E_STAR * radius / MASS)


def write_grains(runs, name, rows):
    """A CSV of grains whose name changes with what it holds, as runs are known by their arguments."""
    lines = ["x,y,z,diameter,vx,vy,vz"] + [",".join(f"{value:.15g}" for value in row) for row in rows]
    text = "\n".join(lines) + "\n"
    path = runs.folder / f"grains/{name}-{zlib.crc32(text.encode()):08x}.csv"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    return path


def rebound_errors(runs, fraction, law, count=16, speed=2.0):
    """|mean rebound speed - exact| / impact speed of `count` pairs, the same of the worst pair, and the run. Hertz:
    e = 0.8. JKR without dashpot: sqrt(V^2 - V_s^2), V_s of Thornton & Ning 1998."""
    half = [DIAMETER / 2 + 5e-6 + 2e-7 * (n * 0.618034 % 1) for n in range(count)]
    rows = [(s * h, n * 1e-3, 0, DIAMETER, -s * speed / 2, 0, 0) for n, h in enumerate(half) for s in (-1, 1)]
    grains = write_grains(runs, "pairs", rows)
    probes = ", ".join(f'{{ name = "{n}", grain = {2 * n} }}' for n in range(count))
    settings = {"particles.file": f'"{grains}"', "stages.collision.time_step": fraction * critical_step(friction=True),
                "output.probes": f"[{probes}]", "stages.collision.contact.law": law}
    exact = 0.8 * speed
    if law == "jkr":
        settings |= {"materials.sand.surface_energy": GAMMA, "materials.sand.restitution": 1}
        work = 22.5163187 * math.cbrt(GAMMA**5 * (DIAMETER / 4) ** 4 / E_STAR**2)
        exact = math.sqrt(speed**2 - 2 * work / (MASS / 2))
    run = runs.scene(f"rebound-{law}-{fraction:g}", HERE / "pairs.toml", settings)
    after = []
    for n in range(count):
        with open(run.folder / f"probe-{n}.csv", newline="") as file:
            after.append(float(list(csv.DictReader(file))[-1]["vx"]))
    errors = [(abs(2 * v) - exact) / speed for v in after]
    return abs(sum(errors)) / count, max(abs(e) for e in errors), run


def lattice_energy_error(runs, fraction, cells=4, speed=0.02, periods=300):
    """Largest |energy - that at the start| / kinetic energy at the start, over 300 critical steps; and the run."""
    radius = contact_radius(PRESSURE * DIAMETER**2 / (2 * math.sqrt(2)))
    overlap = 4 * radius**2 / DIAMETER - math.sqrt(4 * math.pi * GAMMA * radius / E_STAR)
    half_pitch, chance, places = (DIAMETER - overlap) / math.sqrt(2), random.Random(1), range(2 * cells)
    sites = [(i, j, k) for i in places for j in places for k in places if (i + j + k) % 2 == 0]
    rows = [[(x + 0.25) * half_pitch for x in site] + [DIAMETER] + [chance.uniform(-speed, speed) for _ in range(3)]
            for site in sites]
    limit = critical_step(friction=False)
    settings = {"particles.file": f'"{write_grains(runs, "lattice", rows)}"', "domain.upper": [2 * cells * half_pitch] * 3,
                "stages.swing.duration": periods * limit, "stages.swing.time_step": fraction * limit,
                "output.history_interval": periods / 100 * limit}
    run = runs.scene(f"lattice-{fraction:g}", HERE / "lattice.toml", settings)
    history = run.history("swing")
    return max(abs(x) for x in history["energy_residual"]) / history["kinetic_energy"][0], run


def fall_times(diameter, share, steps=20000):
    """Time [s] in which a lone grain falls from rest to `share` of its terminal speed, and that speed [m/s]: Di Felice's
    drag with n = 1 (Dallavalle 1948), buoyancy, no added mass; water of scenes/settling.toml."""
    density, viscosity, gravity = 998.2, 1e-3, 9.81
    volume = math.pi / 6 * diameter**3
    weight = (DENSITY - density) * volume * gravity

    def drag(speed):
        root = 0.63 * speed + 4.8 * math.sqrt(viscosity * speed / (density * diameter))
        return math.pi / 8 * density * diameter**2 * root**2

    low, high = 0.0, 1.0
    for _ in range(100):
        middle = (low + high) / 2
        low, high = (middle, high) if drag(middle) < weight else (low, middle)
    width = share * low / steps
    return sum(DENSITY * volume * width / (weight - drag((n + 0.5) * width)) for n in range(steps)), low


def settling(runs, interval):
    """Relative error of the time to 63.2 % of the terminal speed, a fluid step per `interval` grain steps; and the run."""
    share = 1 - math.exp(-1)
    exact, terminal = fall_times(0.3e-3, share)
    settings = {"fluid.coupling_interval": interval, "stages.fall.duration": 0.012, "output.history_interval": 2e-5}
    run = runs.scene(f"settling-{interval}", SCENES / "settling.toml", settings)
    with open(run.folder / "probe-grain.csv", newline="") as file:
        rows = [(float(row["time"]), -float(row["vz"])) for row in csv.DictReader(file)]
    for (t0, v0), (t1, v1) in zip(rows, rows[1:]):
        if v1 >= share * terminal:
            return (t0 + (share * terminal - v0) / (v1 - v0) * (t1 - t0)) / exact - 1, run
    raise SystemExit(f"{run.folder}: the grain never fell at {share:.3f} of its terminal speed")


def seepage(runs, pressed, cells, smoothing, tolerance=1e-8, step=1, count=4):
    """Water's flow [m3/s] through the hole above the pressed sample, its grains held, under 10 Pa, after `count` fluid
    steps of `step` [s]; and the run. The water's own time is 0.2 ms."""
    porosity = pressed.history("compression/relax")["porosity"][-1]
    height = 1600 * math.pi / 6 * (2 * 0.22948e-3) ** 3 / (25e-6 * (1 - porosity))  # of 1600 grains of k d30
    settings = {"particles.file": f'"{pressed.last_checkpoint()}"', "fluid.cells": [cells] * 3,
                "fluid.box.upper": [2.5e-3, 2.5e-3, height], "fluid.patches.1.center": [0, 0, height],
                "fluid.smoothing_length": smoothing, "fluid.pressure_tolerance": tolerance,
                "stages.seepage.time_step": step, "stages.seepage.duration": count * step, "output.history_interval": step}
    run = runs.scene(f"seepage-{cells}-{smoothing:g}-{tolerance:g}-{step:g}-{count}", HERE / "bed.toml", settings)
    return run.history("seepage")["outflow"][-1], run
