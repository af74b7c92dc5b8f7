# SPDX-License-Identifier: MIT
"""The cases of the study: a scene, what is changed in it, and the case whose sample it goes on from."""

from __future__ import annotations

from dataclasses import dataclass, field

ORIGINAL_COUNT = 270000


@dataclass(frozen=True)
class Case:
    scene: str                      # in scenes
    note: str                       # what it is, for tables
    changes: dict[str, str] = field(default_factory=dict)  # --set of `arenite run`
    start: str = ""                 # the case whose folder it is a copy of; made if it is not there
    until: str = ""                 # the stage after which it stops


CASES: dict[str, Case] = {}


def add_sample(name: str, scene: str, note: str, changes: dict[str, str] | None = None) -> None:
    """Three cases: the pressed sample, the perforated one, and its production. Controls share the first two."""
    changes = changes or {}
    CASES[f"{name}-pressed"] = Case(scene, "pressed sample", changes, until="compression")
    CASES[f"{name}-perforated"] = Case(scene, "perforated sample", changes, f"{name}-pressed", "perforation")
    CASES[name] = Case(scene, note, changes, f"{name}-perforated")


def add_control(sample: str, name: str, note: str, start: str, changes: dict[str, str]) -> None:
    base = CASES[sample]
    CASES[f"{sample}-{name}"] = Case(base.scene, note, base.changes | changes, f"{sample}-{start}")


def in_both(key: str, value: str) -> dict[str, str]:
    return {f"stages.{stage}.contact.{key}": value for stage in ("perforation", "production")}


def coarse(k: int, seed: int = 1) -> dict[str, str]:
    """ssw.toml or ssp.toml at another k: as many grains as fill the same sample, and a step that grows with them."""
    return {"coarse_graining.factor": str(k), "particles.distribution.count": str(round(ORIGINAL_COUNT / k**3)),
            "stages.production.time_step": f"{2.5 * k:g}e-8", "random_seed": str(seed)}


DRY, WEIGHTLESS = {"stages.production.fluid": "false"}, {"stages.production.gravity": "[0,0,0]"}

add_sample("original", "paper/original.toml", "270 000 grains of their own size")
add_sample("ssw", "paper/ssw.toml", "k = 2, each size times k")
add_sample("ssp", "paper/ssp.toml", "k = 2, one size")
add_sample("ssw-k4", "paper/ssw.toml", "k = 4, each size times k", coarse(4))
add_sample("ssw-k4-seed2", "paper/ssw.toml", "k = 4, another sample", coarse(4, seed=2))
add_sample("ssw-k4-seed3", "paper/ssw.toml", "k = 4, a third sample", coarse(4, seed=3))
add_sample("ssp-k4", "paper/ssp.toml", "k = 4, one size", coarse(4))
for made in ("ssw-k4-seed2", "ssw-k4-seed3"):
    add_control(made, "no-fluid", "the same without water", "perforated", DRY)
for made in ("ssw", "ssw-k4"):
    add_control(made, "no-fluid", "no water", "perforated", DRY)
    add_control(made, "no-gravity", "no gravity", "perforated", WEIGHTLESS)
    add_control(made, "neither", "neither water nor gravity", "perforated", DRY | WEIGHTLESS)
    add_control(made, "literal-drag", "drag as eq 8 is printed", "perforated", {"fluid.drag": "di_felice_literal"})
    add_control(made, "paper-friction", "friction limit μ|Fn|, not μ(Fn + 2Fc)", "pressed", in_both("friction_limit", "paper"))
    add_control(made, "break-at-A", "bonds break at no overlap (A)", "pressed", in_both("break_point", "A"))
    add_control(made, "paper-step", "the paper's time step, 1e-8 s", "perforated", {"stages.production.time_step": "1e-8"})


def drawdown(kilopascals: float) -> dict[str, str]:
    """The reservoir's pressure above the well's."""
    pressure = f"{101325 + 1e3 * kilopascals:g}"
    return {"fluid.initial_pressure": pressure, "fluid.patches.0.pressure": pressure, "fluid.patches.1.pressure": pressure}


add_sample("drawdown-20", "drawdown.toml", "20 kPa", drawdown(20))
add_control("drawdown-20", "no-fluid", "no water", "perforated", DRY)
for kilopascals in (1, 5, 10, 40, 80, 160):
    CASES[f"drawdown-{kilopascals}"] = Case("drawdown.toml", f"{kilopascals} kPa", drawdown(kilopascals), "drawdown-20-perforated")
