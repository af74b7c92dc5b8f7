# SPDX-License-Identifier: MIT
"""What the pages that are made from runs share: machine, commit, numbers and tables as text."""

import os
import pathlib
import platform
import re
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[1]


def machine():
    """The processor's model and the number of cores."""
    model = platform.processor() or platform.machine()
    try:
        model = re.search(r"model name\s*: (.*)", pathlib.Path("/proc/cpuinfo").read_text()).group(1)
    except (OSError, AttributeError):
        pass
    return f"{model}, {os.cpu_count()} cores"


def commit():
    """Short hash of the working tree's commit."""
    shown = subprocess.run(
        ["git", "-C", ROOT, "rev-parse", "--short", "HEAD"], capture_output=True, text=True
    ).stdout.strip()
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
