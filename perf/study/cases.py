# SPDX-License-Identifier: MIT
"""The cases of the study: a scene, what is changed in it, and where a case that shares another's sample begins."""

from __future__ import annotations

from dataclasses import dataclass, field


@dataclass(frozen=True)
class Case:
    scene: str                      # in scenes/paper
    changes: dict[str, str] = field(default_factory=dict)  # --set of `arenite run`
    sample: str = ""                # the case whose sample is taken over, or this one makes its own
    since: str = ""                 # the stage at whose end it is taken over
    until: str = ""                 # --until: where it stops before the scene's end
    note: str = ""

    def commands(self) -> str:
        return " ".join(f"--set {key}={value}" for key, value in self.changes.items())


def coarse(k: int, **changes: str) -> dict[str, str]:
    """ssw.toml or ssp.toml at another k: as many grains as fill the same sample, and a step that grows with them."""
    return {"coarse_graining.factor": str(k), "particles.distribution.count": str(round(270000 / k**3)),
            "stages.production.time_step": f"{k}e-8", **changes}


def seed(number: int) -> dict[str, str]:
    return {"random_seed": str(number)}


CASES: dict[str, Case] = {
    "original": Case("original.toml", note="270 000 grains of their own size"),
    "ssw": Case("ssw.toml", note="k = 2, sizes kept apart"),
    "ssp": Case("ssp.toml", note="k = 2, one size"),
    "ssw-k4": Case("ssw.toml", coarse(4), note="k = 4: too coarse for the hole"),
    "ssw-k4-seed2": Case("ssw.toml", coarse(4) | seed(2), note="another sample"),
    "ssw-k4-seed3": Case("ssw.toml", coarse(4) | seed(3), note="another sample"),
    "ssp-k4": Case("ssp.toml", coarse(4), note="k = 4, one size"),
}


def add_controls(sample: str) -> None:
    """The same sample with one thing changed in the production, or from the perforation on."""
    base = CASES[sample]
    productions = {
        "no-fluid": ({"stages.production.fluid": "false"}, "no water"),
        "no-gravity": ({"stages.production.gravity": "[0,0,0]"}, "no gravity"),
        "no-fluid-no-gravity": ({"stages.production.fluid": "false", "stages.production.gravity": "[0,0,0]"}, "neither"),
        "literal-drag": ({"fluid.drag": "di_felice_literal"}, "eq 8 as printed"),
    }
    perforations = {
        "paper-friction": ({"stages.perforation.contact.friction_limit": "paper", "stages.production.contact.friction_limit": "paper"},
                           "friction limit mu |F_n|"),
        "break-at-A": ({"stages.perforation.contact.break_point": "A", "stages.production.contact.break_point": "A"},
                       "bonds break at no overlap"),
    }
    for since, controls in (("perforation", productions), ("compression", perforations)):
        for name, (changes, note) in controls.items():
            CASES[f"{sample}-{name}"] = Case(base.scene, base.changes | changes, sample, since, note=note)


for made in ("ssw", "ssw-k4"):
    add_controls(made)
CASES["ssw-fine-step"] = Case("ssw.toml", {"stages.production.time_step": "1e-8"}, "ssw", "perforation",
                              note="the paper's time step, 1e-8 s")
CASES["ssw-k4-fine-step"] = Case("ssw.toml", coarse(4) | {"stages.production.time_step": "1e-8"}, "ssw-k4", "perforation",
                                 note="the paper's time step, 1e-8 s")
