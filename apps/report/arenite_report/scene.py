# SPDX-License-Identifier: MIT
"""What the report needs of the resolved scene (scene.toml): sizes, the stages' roles, and where the axis of the hole is."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import Any

import numpy as np

Vector = np.ndarray


@dataclass(frozen=True)
class Section:
    """The plane through the axis of the hole that pictures show: `lateral` to the right, `up` upwards, `normal` to the eye."""

    centre: Vector  # m, a point of the axis
    up: int  # coordinate axis along the hole
    lateral: int
    normal: int


@dataclass(frozen=True)
class Scene:
    """Everything has an answer where the file is missing: the names that most scenes use, no sizes."""

    data: dict[str, Any] = field(default_factory=dict)

    @property
    def title(self) -> str:
        return str(self.data.get("title", ""))

    @property
    def scheme(self) -> str:
        return str(self.data.get("coarse_graining", {}).get("scheme", "none"))

    @property
    def factor(self) -> float:
        return float(self.data.get("coarse_graining", {}).get("factor", 1)) if self.scheme != "none" else 1.0

    @property
    def walls(self) -> list[dict[str, Any]]:
        return self.data.get("walls", [])

    @property
    def stages(self) -> list[dict[str, Any]]:
        return self.data.get("stages", [])

    @property
    def has_fluid(self) -> bool:
        return "fluid" in self.data

    @property
    def class_diameters(self) -> list[float]:
        """m, of the original grains, in the order of the class numbers."""
        return [float(d) for d in self.data.get("particles", {}).get("distribution", {}).get("diameters", [])]

    @property
    def class_mass_shares(self) -> list[float]:
        distribution = self.data.get("particles", {}).get("distribution", {})
        shares = np.array(distribution.get("fractions", []), dtype=float)
        if distribution.get("basis") == "number":
            shares = shares * np.array(self.class_diameters) ** 3
        return list(shares / shares.sum()) if shares.size and shares.sum() > 0 else []

    def production(self) -> dict[str, Any]:
        """The stage that grains leave in: the one with an outlet, or of that name, or the last one with fluid."""
        for stage in reversed(self.stages):
            if stage.get("outlet_wall"):
                return stage
        named = [stage for stage in self.stages if stage.get("name") == "production"]
        wet = [stage for stage in self.stages if stage.get("fluid")]
        return (named or wet or [{"name": "production"}])[-1]

    def perforation(self) -> dict[str, Any]:
        """The stage in which a rod travels into the sample."""
        for stage in self.stages:
            if any(action.get("travel") and self._is_rod(action.get("wall", "")) for action in stage.get("walls", [])):
                return stage
        return next((stage for stage in self.stages if stage.get("name") == "perforation"), {"name": "perforation"})

    def rod(self) -> dict[str, Any] | None:
        """What the perforation stage says about the rod: wall, velocity, travel, and_back."""
        actions = self.perforation().get("walls", [])
        return next((action for action in actions if action.get("travel") and self._is_rod(action.get("wall", ""))), None)

    def wall_row(self, name: str) -> int | None:
        return next((row for row, wall in enumerate(self.walls) if wall.get("name") == name), None)

    def _is_rod(self, name: str) -> bool:
        row = self.wall_row(name)
        return row is not None and (self.walls[row].get("type") in ("cylinder", "mesh", "box") and not self.walls[row].get("inside"))

    def section(self) -> Section:
        outlet = self.wall_row(str(self.production().get("outlet_wall", "")))
        domain = self.data.get("domain", {})
        lower, upper = (np.array(domain.get(key, [0, 0, 0]), dtype=float) for key in ("lower", "upper"))
        centre, up = (lower + upper) / 2, 2
        if outlet is not None:
            up = int(np.argmax(np.abs(self.walls[outlet].get("normal", [0, 0, 1]))))
            holes = self.walls[outlet].get("holes", [])
            if holes:
                centre = np.array(holes[0]["center"], dtype=float)
        elif np.any(domain.get("gravity", [0, 0, 0])):
            up = int(np.argmax(np.abs(domain["gravity"])))
        lateral = self._flow_axis(up)
        return Section(centre, up, lateral, ({0, 1, 2} - {up, lateral}).pop())

    def _flow_axis(self, up: int) -> int:
        """The horizontal axis that the water comes along: that of the seeds' line, or of the inlets."""
        line = self.data.get("output", {}).get("streamlines", {}).get("line")
        if line:
            span = np.abs(np.array(line["to"]) - np.array(line["from"]))
            span[up] = 0
            if span.any():
                return int(np.argmax(span))
        for patch in self.data.get("fluid", {}).get("patches", []):
            axis = "xyz".find(str(patch.get("face", ""))[:1])
            if axis not in (-1, up) and patch.get("type") in ("velocity", "pressure"):
                return axis
        return (up + 1) % 3


def part_of(label: str, stage_name: str) -> bool:
    """Whether a label of the history (compression/relax) belongs to a stage of the scene (compression)."""
    return re.sub(r"/[^/]*$", "", label) == stage_name or label == stage_name
