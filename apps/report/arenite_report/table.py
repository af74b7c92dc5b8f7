# SPDX-License-Identifier: MIT
"""CSV tables as a run writes them: one header, comma separated, an empty cell where there is no value."""

from __future__ import annotations

import csv
import io
from dataclasses import dataclass
from pathlib import Path

import numpy as np


@dataclass(frozen=True)
class Table:
    """Columns by name. `cut_rows` counts rows that a kill left incomplete; they are not in the columns."""

    columns: dict[str, list[str]]
    cut_rows: int = 0

    def __contains__(self, name: str) -> bool:
        return name in self.columns

    def __len__(self) -> int:
        return len(next(iter(self.columns.values()), []))

    @property
    def names(self) -> list[str]:
        return list(self.columns)

    def texts(self, name: str) -> list[str]:
        return self.columns[name]

    def numbers(self, name: str) -> np.ndarray:
        """Not-a-number where a cell is empty or holds no number; all so where there is no such column."""
        if name not in self.columns:
            return np.full(len(self), np.nan)
        return np.array([_number(cell) for cell in self.columns[name]], dtype=float)


def _number(cell: str) -> float:
    try:
        return float(cell)
    except ValueError:
        return float("nan")


def read_table(path: Path) -> Table:
    """Raises OSError where the file cannot be read, ValueError where it has no header."""
    text = path.read_text(encoding="utf-8", errors="replace")
    rows = [row for row in csv.reader(io.StringIO(text)) if row and not row[0].startswith("#")]
    if not rows:
        raise ValueError(f"{path.name} is empty")
    header = [name.strip() for name in rows[0]]
    body = rows[1:]
    cut = 0
    if body and not text.endswith("\n"):  # the last value may be half of a number
        body, cut = body[:-1], 1
    whole = [row for row in body if len(row) == len(header)]
    cut += len(body) - len(whole)
    return Table({name: [row[column] for row in whole] for column, name in enumerate(header)}, cut)
