# SPDX-License-Identifier: MIT
"""The packs that everything is measured on, made where they are not there yet. perf/packs/README.md says what they are."""

from __future__ import annotations

import gzip
import subprocess
from dataclasses import dataclass
from pathlib import Path

import measure

FOLDER = measure.ROOT / "build/packs"

# Packs made from the smallest: grains, tiles along x and y, steps of relaxation where the planes between the tiles meet.
TILED = {101256: (3, 4, 2500), 1021000: (11, 11, 2500)}
TILED_FROM = 8438
SIDE = {8438: (9e-3, 9e-3), 33752: (18e-3, 18e-3), 101256: (27e-3, 36e-3), 1021000: (99e-3, 99e-3)}  # m, of the box
GRAINS = tuple(SIDE)


@dataclass(frozen=True)
class Pack:
    grains: int
    file: Path  # "x y z radius" lines, m
    side: tuple[float, float]

    def lines(self) -> list[list[float]]:
        lines = self.file.read_text().splitlines()
        return [[float(field) for field in line.split()] for line in lines if not line.startswith("#")]


def get(grains: int, program: Path) -> Pack:
    """The pack of so many grains; `program` is the arenite that tiles and relaxes."""
    if grains not in SIDE:
        raise ValueError(f"there is no pack of {grains} grains, but of {', '.join(map(str, GRAINS))}")
    FOLDER.mkdir(parents=True, exist_ok=True)
    pack = Pack(grains, FOLDER / f"pack{grains}.txt", SIDE[grains])
    if pack.file.exists():
        return pack
    if grains in TILED:
        along_x, along_y, steps = TILED[grains]
        print(f"making {pack.file.name}: {along_x} x {along_y} mirrored tiles, {steps} steps of relaxation", flush=True)
        tiles = ["--pack", get(TILED_FROM, program).file, "--tile", str(along_x), str(along_y)]
        least = ["--steps", "1", "--warm-up", "0", "--repeats", "1"]
        subprocess.run([program, "bench", *tiles, "--relax", str(steps), "--save", pack.file, *least], check=True,
                       stdout=subprocess.DEVNULL)
    else:
        pack.file.write_bytes(gzip.decompress((measure.ROOT / f"perf/packs/pack{grains}.txt.gz").read_bytes()))
    return pack


def lammps_data(pack: Pack) -> Path:
    """The pack as a LAMMPS (and LIGGGHTS) data file beside it."""
    path = pack.file.with_suffix(".data")
    if path.exists():
        return path
    rows = pack.lines()
    with open(path, "w") as file:
        file.write(f"{path.stem}\n\n{len(rows)} atoms\n1 atom types\n\n")
        file.write(f"0 {pack.side[0]:.9g} xlo xhi\n0 {pack.side[1]:.9g} ylo yhi\n0 0.02 zlo zhi\n\nAtoms\n\n")
        file.writelines(f"{n} 1 {2 * r:.9g} 2605 {x:.15g} {y:.15g} {z:.15g}\n" for n, (x, y, z, r) in enumerate(rows, 1))
    return path
