# SPDX-License-Identifier: MIT
"""Colours that the colour-blind tell apart, the same in every figure. No drawing here: the 3-D pictures use them too."""

from __future__ import annotations

import numpy as np
from matplotlib import colormaps
from matplotlib.colors import BoundaryNorm, Colormap, ListedColormap, LogNorm, Normalize

# Okabe and Ito's colours, the yellow left out: too light for lines on white.
RUNS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#000000")
LINES = ("-", "--", "-.", ":")
MEASURED = "#444444"
BACKGROUND = "#ffffff"
WALL = "#3a3f47"
ROD = "#b8bcc2"

# As the paper's fig 6: blue has no bonds left, red has four or more.
BOND_LABELS = ("0", "1", "2", "3", "4 and more")
BOND_COLOURS = ListedColormap(["#2166ac", "#67a9cf", "#e8e0d8", "#ef8a62", "#b2182b"])
BOND_NORM = BoundaryNorm([-0.5, 0.5, 1.5, 2.5, 3.5, 1e9], 5)
GRAIN_SPEED_COLOURS: Colormap = colormaps["plasma"]
FLUID_SPEED_COLOURS: Colormap = colormaps["viridis"]
GRAIN_DECADES, FLUID_DECADES = 3.0, 2.0  # that the speeds' colours span


def run_style(row: int) -> dict[str, str]:
    """Line colour and dash of a run by its place on the command line."""
    return {"color": RUNS[row % len(RUNS)], "linestyle": LINES[row // len(RUNS) % len(LINES)]}


def speed_norm(highest: float, decades: float) -> Normalize:
    """Logarithmic: grains in the hole are a thousand times faster than those in the pack. Slower is drawn as the lowest."""
    top = highest if np.isfinite(highest) and highest > 0 else 1.0
    return LogNorm(top * 10**-decades, top, clip=True)


def rgb(values: np.ndarray, colours: Colormap, norm: Normalize) -> np.ndarray:
    """Bytes [value][red, green, blue]."""
    return (colours(norm(values))[:, :3] * 255).astype(np.uint8)
