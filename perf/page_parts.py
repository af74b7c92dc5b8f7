# SPDX-License-Identifier: MIT
"""What the pages that are made from runs share: machine, commit, numbers and tables as text."""

import subprocess

import measure
from measure import ROOT


def machine():
    """The processor's model and the number of cores."""
    return f"{measure.cpu_model()}, {measure.cores()} cores"


def commit(marked=False):
    """Short hash of the working tree's commit; marked: with -modified where tracked files differ from it."""
    command = ["git", "-C", ROOT, "describe", "--always", "--exclude=*", *(["--dirty=-modified"] if marked else [])]
    shown = subprocess.run(command, capture_output=True, text=True).stdout.strip()
    return shown or "unknown"


def number(value, digits):
    return "–" if value is None else f"{value:.{digits}g}"


def table(columns, rows):
    """Markdown. Columns are titles, those of numbers with a leading >; cells are texts."""
    lines = [
        "| " + " | ".join(title.lstrip(">") for title in columns) + " |",
        "| " + " | ".join("--:" if title.startswith(">") else "---" for title in columns) + " |",
    ]
    lines += ["| " + " | ".join(cell.replace("|", "\\|") for cell in row) + " |" for row in rows]
    return "\n".join(lines)
