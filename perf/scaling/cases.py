# SPDX-License-Identifier: MIT
"""A production of the same sand as k = 1, 2 and 4: the same volume, k^3 times fewer grains, steps k times longer, the fluid's
step and cells the same. Bonded grains (modified JKR) with water through them, as in scenes/paper; no grain leaves."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path

import measure
import packs

FOLDER = measure.ROOT / "build/scaling"
SOURCE = 8438                              # grains of the pack that is k = 4
TILES = {4: (1, 1), 2: (2, 4), 1: (8, 8)}  # grains of k / 4 the size, so 1, 8 and 64 tiles fill the same volume
FLUID_STEP = 1e-6                          # s: 100 grain steps at k = 1, as the paper has it
CELL = 1.125e-3                            # m
FACTORS = tuple(TILES)

SCENE = """title = "Production, k = {k}"
[domain]
lower = [0, 0, 0]
upper = [{x}, {y}, {z}]
gravity = [0, 0, {gravity}]
[materials.sand]
density = 2605
youngs_modulus = 2e10
poissons_ratio = 0.3
restitution = 0.8
friction = 0.2
surface_energy = 30
[coarse_graining]
scheme = "ssw"
factor = {k}
[particles]
source = "file"
material = "sand"
file = "k{k}.csv"
[[walls]]
name = "box"
type = "box"
inside = true
material = "sand"
lower = [0, 0, 0]
upper = [{x}, {y}, {z}]
[fluid]
cells = [{nx}, {ny}, {nz}]
density = 998.2
viscosity = 1e-3
time_step = {fluid_step}
smoothing_length = {smoothing}
initial_pressure = 101325
[[fluid.patches]]
face = "y_lower"
type = "velocity"
velocity = [0, 1e-4, 0]
[[fluid.patches]]
face = "y_upper"
type = "velocity"
velocity = [0, -1e-4, 0]
[[fluid.patches]]
face = "z_upper"
type = "pressure"
pressure = 101325
[[stages]]
name = "production"
duration = 1e-6
time_step = {dt}
contact = {{ law = "modified_jkr" }}
form_bonds = true
fluid = true
"""


def grains_of(k: int) -> int:
    return SOURCE * TILES[k][0] * TILES[k][1]


def write_case(k: int, program: Path) -> Path:
    """The scene's path; its grains are the pack's, scaled and mirrored in turn along x and y."""
    scene = FOLDER / f"k{k}.toml"
    scale, (along_x, along_y) = k / 4, TILES[k]
    pack = packs.get(SOURCE, program)
    side = [scale * length for length in pack.side]
    FOLDER.mkdir(parents=True, exist_ok=True)
    height = 0.0
    with open(FOLDER / f"k{k}.csv", "w") as file:
        file.write("x,y,z,radius\n")
        grains = [[scale * number for number in line] for line in pack.lines()]
        for i in range(along_x):
            for j in range(along_y):
                for x, y, z, radius in grains:
                    px = i * side[0] + (x if i % 2 == 0 else side[0] - x)
                    py = j * side[1] + (y if j % 2 == 0 else side[1] - y)
                    height = max(height, z + radius)
                    file.write(f"{px:.12g},{py:.12g},{z:.12g},{radius:.9g}\n")
    box = [along_x * side[0], along_y * side[1], 1.02 * height]
    cells = [max(2, round(length / CELL)) for length in box]
    scene.write_text(SCENE.format(k=k, x=box[0], y=box[1], z=box[2], gravity=-9810 / scale, nx=cells[0], ny=cells[1], nz=cells[2],
                                  fluid_step=FLUID_STEP, smoothing=2 * CELL, dt=1e-8 * k))
    return scene


def run_stage(program: Path, scene: Path, threads: int, duration: float) -> float:
    """Seconds of the stage, its output included."""
    output = FOLDER / f"run-{scene.stem}"
    environment = measure.environment_of(threads)
    command = [program, "run", scene, "-o", output, "--quiet", "--set", f"stages.production.duration={duration:g}"]
    run = subprocess.run(command, env=environment, capture_output=True, text=True)
    if run.returncode != 0:
        raise RuntimeError(f"{scene.name}: {run.stderr}")
    return json.loads((output / "summary.json").read_text())["stages"][-1]["wall_time"]


def seconds_per_second(program: Path, scene: Path, threads: int, fluid_steps: int) -> float:
    """Wall time over simulated time, from the difference of two lengths, so that start and output drop out."""
    short, long = (run_stage(program, scene, threads, count * FLUID_STEP) for count in (fluid_steps, 2 * fluid_steps))
    return (long - short) / (fluid_steps * FLUID_STEP)
