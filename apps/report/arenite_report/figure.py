# SPDX-License-Identifier: MIT
"""A figure of the report: a picture, a caption, and the numbers in it as CSV."""

from __future__ import annotations

import csv
import io
from dataclasses import dataclass, field
from typing import Any, Iterable

import matplotlib

matplotlib.use("Agg")  # no display
import matplotlib.pyplot as plt
from matplotlib.figure import Figure as Canvas

plt.rcParams.update({
    "font.size": 10, "axes.titlesize": 10, "axes.titleweight": "bold", "axes.titlelocation": "left", "axes.labelsize": 10,
    "legend.fontsize": 9, "legend.frameon": False, "axes.spines.top": False, "axes.spines.right": False, "axes.grid": True,
    "grid.color": "#e3e6ea", "grid.linewidth": 0.8, "axes.axisbelow": True, "axes.edgecolor": "#5a6068", "lines.linewidth": 1.8,
    "figure.facecolor": "white", "figure.constrained_layout.use": True, "axes.formatter.limits": (-3, 4),
})


DOTS = 160  # an inch


@dataclass
class Figure:
    name: str  # of its files: figure-10-produced-mass
    title: str
    caption: str
    png: bytes
    header: list[str] = field(default_factory=list)
    rows: list[list[Any]] = field(default_factory=list)

    @property
    def inches(self) -> float:
        """Width as drawn: letters are as large in every figure of the page."""
        return int.from_bytes(self.png[16:20], "big") / DOTS

    def csv_text(self) -> str:
        out = io.StringIO()
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow(self.header)
        writer.writerows([_cell(value) for value in row] for row in self.rows)
        return out.getvalue()


def _cell(value: Any) -> str:
    """Reals with the fewest digits that read back to the same bits."""
    return "" if value is None else repr(float(value)) if isinstance(value, float) else str(value)


def as_png(canvas: Canvas) -> bytes:
    out = io.BytesIO()
    canvas.get_layout_engine().execute(canvas)
    canvas.set_layout_engine("none")  # once is enough, and takes a third of the time
    canvas.savefig(out, format="png", dpi=DOTS, pil_kwargs={"compress_level": 3})
    plt.close(canvas)
    return out.getvalue()


def panels(rows: int, columns: int, width: float = 10.0, height: float = 3.6) -> tuple[Canvas, list[plt.Axes]]:
    """A row of axes as wide as the report's text; height in inches for one row."""
    canvas, axes = plt.subplots(rows, columns, figsize=(width, height * rows), squeeze=False)
    return canvas, list(axes.flat)


def below(canvas: Canvas, axes: plt.Axes) -> None:
    """One legend for all panels, under them; none for a single entry."""
    handles, labels = axes.get_legend_handles_labels()
    if len(labels) > 1:
        canvas.legend(handles, labels, loc="outside lower center", ncols=min(len(labels), 4))


def columns_as_rows(label: str, *columns: Iterable[Any]) -> list[list[Any]]:
    """Rows for the CSV: the run's name, then one value of each column."""
    return [[label, *(float(value) for value in row)] for row in zip(*columns)]
