#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes docs/performance.md from the tables in perf/results/<machine> and perf/scaling, and perf/did_not_pay.md.

    perf/performance_page.py [--machine NAME]

Nothing is measured here: the tables' own comments say when, where and with which command they were. What has not been
measured yet is said on the page. Pictures need matplotlib and go to docs/performance_*.png."""

from __future__ import annotations

import argparse
import collections
import itertools
from pathlib import Path

import measure
import page_parts

PAGE = measure.ROOT / "docs/performance.md"
Rows = list[dict[str, str]]

HEAD = """# Performance

Made by `perf/performance_page.py` from the tables of `perf/results/{machine}`; do not edit. Above every table: when and on what it was
measured, at which commit, and the command that measures it again. `perf/measure.sh` runs all of them.

A particle-step is one grain moved by one time step. The packs (sand of 0.30 to 0.71 mm at rest under a confining load) are described in
`perf/packs/README.md`; dt = 1e-8 s, history on.
"""


class Tables:
    """The tables of one machine; what is asked for is not listed among the others."""

    def __init__(self, folder: Path) -> None:
        self._tables = {path.stem: measure.read_table(path) for path in sorted(folder.glob("*.csv"))}
        self._used = {"material"}  # on a page of its own, docs/material.md

    def get(self, name: str) -> tuple[list[str], Rows]:
        self._used.add(name)
        return self._tables.get(name, ([], []))

    def others(self) -> list[str]:
        return [name for name in self._tables if name not in self._used]


def quote(comments: list[str]) -> str:
    return "\n".join(f"> {line}  " for line in comments) + "\n"


def table(head: list[str], rows: list[list[str]]) -> str:
    """Columns with a number in them are columns of numbers."""
    numbers = [any(cell.replace(".", "").replace("–", "").strip("-").isdigit() for cell in column) for column in zip(*rows)]
    return page_parts.table([">" * right + title for right, title in zip(numbers, head)], rows) + "\n"


def number(text: str, digits: int = 3, scale: float = 1.0) -> str:
    return f"{float(text) * scale:.{digits}g}" if text else ""


def missing(command: str) -> str:
    return f"Not measured here yet: `{command}`.\n"


def peers(tables: Tables) -> str:
    comments, rows = tables.get("peers")
    tables.get("peers_runs")
    if not rows:
        return missing("perf/peers/run.sh")
    body = []
    for row in sorted(rows, key=lambda row: (row["grains"], row["law"], row["cores"], -float(row["Mparticle_steps_per_s"]))):
        ratio = f"{number(row['arenite_over_it'])} ({number(row['ratio_least'])}–{number(row['ratio_most'])})"
        body.append([row["grains"], row["law"], row["cores"], row["by"], row["program"], number(row["Mparticle_steps_per_s"]),
                     "" if row["program"] == "arenite" else ratio, number(row["contacts_per_grain"])])
    head = ["grains", "law", "cores", "by", "program", "M particle-steps/s", "Arenite's speed over it (range)", "contacts a grain"]
    return (quote(comments) + "\n" + table(head, body) +
            "\nWhat is and is not the same in these runs: `perf/peers/README.md`. Every timed run: `peers_runs.csv`.\n")


STEPS_IN_PARTS = """
From 262 144 grains on the step is made tile by tile (`kernels/contact_passes.hpp`): most rows of forces never leave the caches then, and
a step moves little more than half the bytes. "In one part" is the same pack without tiles (`arenite bench --whole-steps`): the same
state, a larger share of the copy, and slower.
"""


def in_one_part(row: dict[str, str]) -> bool:
    """A pack that is otherwise stepped tile by tile; older tables have none."""
    return row.get("whole_steps") == "1"


def roofline(tables: Tables) -> str:
    comments, rows = tables.get("roofline")
    if not rows:
        return missing("perf/roofline/run.py")
    body = []
    for row in rows:
        used = float(row["bytes_per_particle_step"]) * float(row["particle_steps_per_s"]) / 1e9
        body.append([row["grains"] + (", in one part" if in_one_part(row) else ""), row["law"], row["threads"],
                     number(row["particle_steps_per_s"], 3, 1e-6), number(row["candidates_per_grain"]),
                     number(row["contacts_per_grain"]), number(row["bytes_per_particle_step"]),
                     number(row["flops_per_particle_step"]), f"{used:.3g}", number(row["copy_bytes_per_s"], 3, 1e-9),
                     f"{100 * float(row['share_of_copy']):.0f} %", f"{100 * float(row['share_of_copy_beyond_caches']):.0f} %",
                     f"{100 * float(row['share_of_multiply_add']):.0f} %"])
    head = ["grains", "law", "threads", "M/s", "candidates", "contacts", "bytes", "flops", "GB/s used", "copy GB/s", "of copy",
            "of memory copy", "of multiply-add"]
    return quote(comments) + "\n" + table(head, body) + """
Bytes and flops of a particle-step are counted by hand, kernel by kernel, in `apps/bench_limits.cpp`. "Copy" is a stream copy of as much memory
as the pack takes, so from the cache where the pack fits; "memory copy" is one of 512 MiB. A share of more than 100 % of the memory
copy means that the pack lives in the cache.
""" + (STEPS_IN_PARTS if any(map(in_one_part, rows)) else "")


def growth(tables: Tables) -> str:
    _, rows = tables.get("roofline")
    if not rows:
        return missing("perf/roofline/run.py")
    rows = [row for row in rows if not in_one_part(row)]
    cost = {(row["law"], row["threads"], int(row["grains"])): 1e9 / float(row["particle_steps_per_s"]) for row in rows}
    sizes = sorted({key[2] for key in cost})
    body = []
    for law, threads in sorted({key[:2] for key in cost}):
        own = [cost.get((law, threads, size)) for size in sizes]
        cells = [f"{value:.1f} ({value / own[0]:.2f})" if value and own[0] else "" for value in own]
        body.append([law, threads, *cells])
    search = {int(row["grains"]): row for row in rows if row["law"] == "jkr" and row["threads"] == rows[0]["threads"]}
    searches = [f"{float(search[size]['one_search_s']) * float(search[size]['particle_steps_per_s']) / size:.1f}" for size in sizes
                if size in search]
    return ("ns a particle-step, and in brackets over that of the smallest pack:\n\n" +
            table(["law", "threads", *(f"{size} grains" for size in sizes)], body) +
            f"\nA search costs as much as {', '.join(searches)} steps (JKR, {rows[0]['threads']} thread; packs in the order above); lists last some "
            "hundred steps in a moving sample and as long as you like in one at rest.\n")


def memory(tables: Tables) -> str:
    comments, rows = tables.get("memory")
    _, runs = tables.get("roofline")
    if not rows:
        return missing("perf/roofline/run.py")
    grains = "33752" if any(row["grains"] == "33752" for row in rows) else rows[0]["grains"]
    parts = [row for row in rows if row["grains"] == grains and row["law"] == "jkr"]
    large = [row for row in parts if float(row["bytes_per_grain"]) >= 4]
    rest = sum(float(row["bytes_per_grain"]) for row in parts) - sum(float(row["bytes_per_grain"]) for row in large)
    total = sum(float(row["bytes_per_grain"]) for row in parts)
    body = [[row["view"], number(row["bytes_per_grain"])] for row in large] + [["all others", f"{rest:.3g}"], ["sum", f"{total:.0f}"]]
    peak = next((number(row["peak_memory_bytes_per_grain"]) for row in runs if row["grains"] == grains and row["law"] == "jkr"), "")
    return (quote(comments[:3]) + f"\nBytes a grain of the pack of {grains} grains under JKR, by Kokkos View; {peak} at most, in a "
            "search.\n\n" + table(["View", "bytes a grain"], body))


def threads(tables: Tables, machine: str) -> str:
    comments, rows = tables.get("threads")
    text = missing("perf/scaling/run.py")
    if rows:
        body = [[row["kind"], row["law"], row["threads"], row["grains"], number(row["Mparticle_steps_per_s"]),
                 f"{number(row['least'])}–{number(row['most'])}", number(row["speed_up"])] for row in rows]
        text = quote(comments) + "\n" + table(["kind", "law", "threads", "grains", "M particle-steps/s", "range", "speed-up"], body)
    path = measure.ROOT / f"perf/scaling/{machine}.csv"
    if not path.exists():
        return text
    comments, rows = measure.read_table(path)
    fastest: dict[tuple, dict] = {}
    for row in rows:
        key = row["case"], row["k"], row["threads"]
        if key not in fastest or float(row["wall_time"]) < float(fastest[key]["wall_time"]):
            fastest[key] = row
    body = []
    for (case, k, count), row in fastest.items():
        whole = next((other for key, other in fastest.items() if key[1] == "1" and key[2] == count), row)
        body.append([case, k, count, row["grains"], number(row["wall_time"]), number(row["particle_steps_per_s"], 3, 1e-6),
                     f"{float(whole['wall_time']) / float(row['wall_time']):.1f}"])
    return text + "\nThe same production, coarse-grained:\n\n" + quote(comments) + "\n" + table(
        ["case", "k", "threads", "grains", "wall time (s)", "M particle-steps/s", "over k = 1"], body)


def prediction(tables: Tables) -> str:
    comments, rows = tables.get("prediction")
    if not rows:
        return missing("perf/prediction/run.py")
    searches = [row.get("search_share", "") for row in rows]  # not in older tables
    body = [[row["scene"], row["stage"], row["threads"], row["expected_steps"], row["steps"], number(row["expected_s"]), number(row["measured_s"]),
             number(row["expected_over_measured"]), f"{100 * float(share):.1f} %" if share else ""] for row, share in zip(rows, searches)]
    pressed = sum(float(row["measured_s"]) for row in rows if row["scene"] == "ssw" and row["stage"].startswith("compression"))
    return ("`arenite check SCENE` predicts this from a fraction of a second of each stage, with the scene's own law, number of grains, fluid "
            "and balance sheet. In searches: the share of the time taken that goes into lists of neighbours.\n\n" + quote(comments) + "\n" +
            table(["scene", "stage", "threads", "steps expected", "taken", "s expected", "taken", "ratio", "in searches"], body) +
            f"\nFrom grains at random to SSW's relaxed pack (33 750 grains, 1 MPa): {pressed:.0f} s.\n" * (pressed > 0))


OWN_PAGES = ("speed_error",)  # tables that docs/ has a page for


def others(tables: Tables) -> str:
    parts = []
    for name in tables.others():
        if name in OWN_PAGES: continue
        comments, rows = tables.get(name)
        if rows and None not in rows[0]:
            parts.append(f"### {name}\n\n{quote(comments)}\n{table(list(rows[0]), [[value or '' for value in row.values()] for row in rows])}")
    return "\n".join(parts)


def gpus(own: str) -> str:
    """A part for every card that perf/gpu.sh left tables of."""
    parts = []
    for folder in sorted((measure.ROOT / "perf/results").iterdir()):
        if folder.name == own or not (folder / "grains.csv").exists():
            continue
        parts.append(f"### {folder.name}\n")
        for name in ("grains", "pack33752", "largest", "launches", "fluid", "coupling", "verify"):
            if not (folder / f"{name}.csv").exists():
                continue
            comments, rows = measure.read_table(folder / f"{name}.csv")
            shown = [column for column in rows[0] if column not in ("state_hash", "backend", "concurrency")]
            body = [[f"{float(row[c]):.4g}" if is_decimal(row[c]) else row[c] for c in shown] for row in rows]
            parts.append(f"{quote(comments)}\n{table([column.replace('_', ' ') for column in shown], body)}")
    return "\n".join(parts) if parts else missing("perf/gpu.sh, where there is a GPU")


def other_processors(own: str) -> str:
    """Speed and growth on every other processor that perf/measure.sh left tables of."""
    parts = []
    for folder in sorted((measure.ROOT / "perf/results").iterdir()):
        tables = Tables(folder)
        if folder.name == own or not (tables.get("peers")[1] or tables.get("roofline")[1]):
            continue
        parts += [f"### {folder.name}\n", peers(tables), roofline(tables), growth(tables)]
    if parts:
        parts.insert(0, "A row is measured after the other: on a shared host a neighbour that comes or goes moves some of them "
                        "(`roofline.csv` has the least and most of the repeats). Ratios to peers are taken within a round.\n")
    return "\n".join(parts) if parts else "None was measured yet.\n"


def is_decimal(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return not text.lstrip("-").isdigit()


def pictures(tables: Tables, machine: str) -> dict[str, str]:
    """Section to picture; none without matplotlib."""
    try:
        import matplotlib
        matplotlib.use("Agg")
        import matplotlib.pyplot as plt
    except ImportError:
        print("no matplotlib: the page has no pictures")
        return {}
    drawn = {}
    _, rows = tables.get("roofline")
    if rows:
        figure, axes = plt.subplots(figsize=(6, 3.4))
        series = collections.defaultdict(list)
        for row in itertools.filterfalse(in_one_part, rows):
            series[row["law"], row["threads"]].append((int(row["grains"]), 1e9 / float(row["particle_steps_per_s"])))
        for (law, count), points in sorted(series.items()):
            axes.plot(*zip(*sorted(points)), "o-", label=f"{law}, {count} thread{'s' if count != '1' else ''}")
        axes.set(xscale="log", xlabel="grains", ylabel="ns a particle-step", ylim=(0, None))
        drawn["growth"] = save(figure, axes, "growth")
    _, rows = tables.get("threads")
    if rows:
        figure, axes = plt.subplots(figsize=(6, 3.4))
        series = collections.defaultdict(list)
        for row in rows:
            series[row["kind"], row["law"]].append((int(row["threads"]), float(row["speed_up"])))
        for (kind, law), points in sorted(series.items()):
            axes.plot(*zip(*sorted(points)), "o-", label=f"{kind}, {law}")
        most = max(int(row["threads"]) for row in rows)
        axes.plot([1, most], [1, most], "k:", linewidth=0.8)
        axes.set(xlabel="threads", ylabel="speed-up", xticks=sorted({int(row["threads"]) for row in rows}), ylim=(0, None))
        drawn["threads"] = save(figure, axes, "threads")
    return drawn


def save(figure, axes, name: str) -> str:
    axes.legend(frameon=False)
    figure.tight_layout()
    figure.savefig(measure.ROOT / f"docs/performance_{name}.png", dpi=110)
    return f"\n![{name}](performance_{name}.png)\n"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--machine", default=measure.machine_name(), help="folder of perf/results")
    machine = parser.parse_args().machine
    tables = Tables(measure.ROOT / "perf/results" / machine)
    drawn = pictures(tables, machine)
    sections = [("Against peers", peers(tables)), ("Against the machine", roofline(tables)),
                ("From cache to memory", growth(tables) + drawn.get("growth", "")),
                ("Over threads and k", threads(tables, machine) + drawn.get("threads", "")), ("Memory", memory(tables)),
                ("On other processors", other_processors(machine)), ("On a GPU", gpus(machine)),
                ("What a case costs", prediction(tables)), ("Other measurements", others(tables)),
                ("Tried, and did not pay", (measure.ROOT / "perf/did_not_pay.md").read_text())]
    page = HEAD.format(machine=machine) + "".join(f"\n## {title}\n\n{text}" for title, text in sections)
    PAGE.write_text(page)
    print(f"wrote {PAGE.relative_to(measure.ROOT)}")


if __name__ == "__main__":
    main()
