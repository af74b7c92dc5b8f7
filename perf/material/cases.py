# SPDX-License-Identifier: MIT
"""The tests of the series: a scene, its confining stress, its seed, and what is changed in the stages after the confinement.
Tests that share scene, stress, seed and grains go on from one confined sample."""

from __future__ import annotations

import dataclasses
import math

MPA = 1e6
STRESSES = (0.1 * MPA, 0.5 * MPA, 1 * MPA)  # Pa
FRICTIONS = (0.2, 0.5)
SURFACE_ENERGIES = (0, 10, 30, 60)  # J/m2
SEEDS = (1, 2, 3)
SCALINGS = (("ssw", 1), ("ssw", 2), ("ssp", 2), ("ssw", 4), ("ssp", 4))
AXES = "xyz"


@dataclasses.dataclass(frozen=True)
class Test:
    series: str
    scene: str
    stress: float  # confining, Pa
    seed: int = 1
    friction: float = 0.2  # in the shear
    surface_energy: float = 0  # J/m2, of the original grains
    scheme: str = "ssw"
    k: int = 1
    grains: int = 2000  # at k = 1
    strain: float = 0.06  # logarithmic, at the end
    slowness: float = 1  # rates of the scene over those of the test
    confined_friction: float = 0

    @property
    def sample(self) -> str:
        """Name of the confined sample."""
        words = [
            self.scene,
            f"{self.stress / MPA:g}MPa",
            f"seed{self.seed}",
            f"{self.scheme}{self.k}",
            f"{self.grains}grains",
        ]
        if self.confined_friction:
            words.append(f"loose{self.confined_friction:g}")
        return "-".join(words)

    @property
    def name(self) -> str:
        return f"{self.sample}-mu{self.friction:g}-gamma{self.surface_energy:g}" + (
            f"-slow{self.slowness:g}" if self.slowness != 1 else ""
        )

    @property
    def rate(self) -> float:
        """Axial strain rate, 1/s: at an inertial number of 1e-3 / slowness for every stress and grain size."""
        return 27 * math.sqrt(self.stress / 1e5) / self.k / self.slowness

    def sample_settings(self) -> dict[str, object]:
        """What makes the confined sample; the box holds as many grains at every k as fill the same volume."""
        edge = 3.8e-3 * (self.grains / 2000) ** (1 / 3)
        made = {
            "random_seed": self.seed,
            "particles.distribution.count": round(self.grains / self.k**3),
            "domain.upper": [round(edge, 8)] * 3,
            "stages.confine.materials.sand.friction": self.confined_friction,
        }
        if self.k > 1:
            made |= {"coarse_graining.scheme": self.scheme, "coarse_graining.factor": self.k}
        return made | self.holding("confine", AXES, 100 * math.sqrt(self.stress / 1e5) / self.k)

    def holding(self, stage: str, axes: str, gain: float) -> dict[str, object]:
        return {f"stages.{stage}.box.{axis}.stress": self.stress for axis in axes} | {
            f"stages.{stage}.box.max_strain_rate": gain
        }

    def settings(self) -> dict[str, object]:
        return self.sample_settings() | (self.oedometer() if self.scene == "oedometer" else self.shear())

    def shear(self) -> dict[str, object]:
        duration = self.strain / self.rate
        made = {
            "stages.shear.materials.sand.friction": self.friction,
            "stages.shear.duration": duration,
            "stages.shear.history_interval": duration / 500,
            "stages.shear.box.z.strain_rate": -self.rate,
        }
        if self.scene == "triaxial":
            return made | self.holding("shear", "xy", 74 * self.rate)
        made |= {f"stages.{stage}.materials.sand.surface_energy": self.surface_energy for stage in ("cement", "shear")}
        made |= {"stages.cement.materials.sand.friction": self.friction}
        return (
            made
            | self.holding("cement", AXES, 100 * math.sqrt(self.stress / 1e5) / self.k)
            | self.holding("shear", "xy", 15 * self.rate)
        )

    def oedometer(self) -> dict[str, object]:
        made = {}
        for stage, sign, share in (("load", -1, 1), ("unload", 1, 0.4)):
            duration = share * self.strain / self.rate
            made |= {
                f"stages.{stage}.materials.sand.friction": self.friction,
                f"stages.{stage}.duration": duration,
                f"stages.{stage}.history_interval": duration / 200,
                f"stages.{stage}.box.z.strain_rate": sign * self.rate,
            }
        return made


def dry() -> list[Test]:
    """D16: confinement and friction."""
    return [
        Test("D16", "triaxial", stress, seed, friction, strain=0.15)
        for seed in SEEDS
        for stress in STRESSES
        for friction in FRICTIONS
    ]


def dry_stiff() -> list[Test]:
    """The same with the paper's stiffness: cemented samples without surface energy."""
    return [
        Test("D16 stiff", "triaxial_bonded", stress, seed, friction)
        for seed in SEEDS
        for stress in STRESSES
        for friction in FRICTIONS
    ]


def dry_large() -> list[Test]:
    """The same with as many grains as the case asks for."""
    return [dataclasses.replace(test, series="D16 large", grains=5000) for test in dry()]


def dry_checks() -> list[Test]:
    """The same at a third of the rate, with four times the grains, and from a loose sample."""
    base = Test("D16 checks", "triaxial", 0.5 * MPA, 1, 0.5, strain=0.15)
    return [
        dataclasses.replace(base, **change)
        for change in (
            {},
            {"slowness": 3, "strain": 0.06},
            {"grains": 8000, "strain": 0.06},
            {"confined_friction": 0.1},
        )
    ]


def bonded() -> list[Test]:
    """D17: confinement and surface energy."""
    return [
        Test("D17", "triaxial_bonded", stress, seed, surface_energy=energy)
        for seed in SEEDS
        for stress in STRESSES
        for energy in SURFACE_ENERGIES
    ]


def bonded_checks() -> list[Test]:
    base = Test("D17 checks", "triaxial_bonded", 0.5 * MPA, surface_energy=30)
    return [base, dataclasses.replace(base, slowness=3, strain=0.03)]


def scaled() -> list[Test]:
    """G3: the same sample of ever fewer grains; k = 4 would leave 31 of these."""
    tests = [
        Test("G3", "triaxial_bonded", 0.5 * MPA, surface_energy=30),
        Test("G3", "oedometer", 0.1 * MPA, strain=0.03),
    ]
    return [
        dataclasses.replace(test, scheme=scheme, k=k, seed=seed)
        for test in tests
        for seed in SEEDS
        for scheme, k in SCALINGS
        if k < 4
    ]


def scaled_large() -> list[Test]:
    """The same in four times the volume, so that k = 4 has 125 grains."""
    tests = [dataclasses.replace(test, series="G3 large", grains=8000) for test in scaled() if test.k == 1]
    return [dataclasses.replace(test, scheme=scheme, k=k) for test in tests for scheme, k in SCALINGS]


SERIES = {
    "dry": dry,
    "dry-stiff": dry_stiff,
    "bonded": bonded,
    "scaled": scaled,
    "dry-checks": dry_checks,
    "bonded-checks": bonded_checks,
    "dry-large": dry_large,
    "scaled-large": scaled_large,
}
