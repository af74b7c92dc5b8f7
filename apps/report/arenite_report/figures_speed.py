# SPDX-License-Identifier: MIT
"""Wall time over threads and the speed-up of coarse grains (the paper's fig 12 and table 5), beside the paper's own figures."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from . import numbers, palette
from .figure import Figure, as_png, below, panels
from .run_folder import Run
from .table import read_table

# Table 5: cores, then the speed-up of SSW and SSP (k = 2) over the original, Xeon Gold 6230R.
PAPER_SPEED_UP = {"SSW": {8: 8.1, 16: 7.1, 32: 5.2}, "SSP": {8: 9.4, 16: 8.6, 32: 6.8}}


@dataclass(frozen=True)
class Timing:
    case: str
    threads: int
    wall_time: float  # s


def read_scaling(paths: list[Path]) -> list[Timing]:
    """Rows of CSVs with the columns case, threads (or cores) and wall_time (s); k, where given, becomes part of the case's name.
    Of repeated measurements the fastest counts. Raises ValueError where a column is missing."""
    fastest: dict[tuple[str, int], float] = {}
    for path in paths:
        table = read_table(path)
        threads = next((name for name in ("threads", "cores", "ranks") if name in table), None)
        seconds = next((name for name in ("wall_time", "wall_time_s", "seconds") if name in table), None)
        if "case" not in table or threads is None or seconds is None:
            raise ValueError(f"{path}: needs the columns case, threads and wall_time")
        factors = table.texts("k") if "k" in table else [""] * len(table)
        for case, k, count, time in zip(table.texts("case"), factors, table.numbers(threads), table.numbers(seconds)):
            if count > 0 and time > 0:
                key = (f"{case}, k = {k}" if k else case, int(count))
                fastest[key] = min(time, fastest.get(key, time))
    return [Timing(case, threads, time) for (case, threads), time in fastest.items()]


def timings_of_runs(runs: list[Run]) -> list[Timing]:
    """The production of each run, where all of them simulated the same time with known threads."""
    timings, lengths = [], []
    for run in runs:
        stage = run.scene.production()["name"]
        threads, seconds = run.summary.get("machine", {}).get("concurrency"), numbers.wall_time(run, stage)
        if threads and seconds:
            timings.append(Timing(run.label, int(threads), seconds))
            lengths.append(sum(float(part.get("simulated_time", 0)) for part in run.stage_summaries(stage)))
    same = len(timings) > 1 and max(lengths) <= 1.001 * min(lengths)
    return timings if same else []


def original_of(timings: list[Timing], reference: str | None) -> str | None:
    """The case that speed-ups are over: the reference run, or the one called original."""
    cases = list(dict.fromkeys(timing.case for timing in timings))
    return next((case for case in cases if case == reference or case.lower().startswith("original")), None)


def speed_ups(timings: list[Timing], original: str | None) -> dict[str, dict[int, float]]:
    base = {timing.threads: timing.wall_time for timing in timings if timing.case == original}
    result: dict[str, dict[int, float]] = {}
    for timing in timings:
        if timing.threads in base:
            result.setdefault(timing.case, {})[timing.threads] = base[timing.threads] / timing.wall_time
    return {case: dict(sorted(values.items())) for case, values in result.items()}


def scaling(timings: list[Timing], original: str | None, source: str) -> Figure | None:
    if not timings:
        return None
    canvas, axes = panels(1, 2, 10.0, 3.9)
    cases = list(dict.fromkeys(timing.case for timing in timings))
    gained = speed_ups(timings, original)
    rows = []
    for number, case in enumerate(cases):
        own = sorted((timing.threads, timing.wall_time) for timing in timings if timing.case == case)
        axes[0].plot(*zip(*own), "o-", color=palette.run_style(number)["color"], label=case)
        if case != original and gained.get(case):
            axes[1].plot(list(gained[case]), list(gained[case].values()), "o-", color=palette.run_style(number)["color"])
        rows += [[case, threads, time, gained.get(case, {}).get(threads)] for threads, time in own]
    for (name, values), marker in zip(PAPER_SPEED_UP.items(), "s^"):
        axes[1].plot(list(values), list(values.values()), marker + "--", color=palette.MEASURED, markerfacecolor="white",
                     label=f"paper, {name}, k = 2", linewidth=1.2)
        rows += [[f"paper, {name}, k = 2", threads, None, value] for threads, value in values.items()]
    axes[1].legend(loc="best")
    ticks = sorted({timing.threads for timing in timings})
    for panel, marks in ((axes[0], ticks), (axes[1], sorted({*ticks, 8, 16, 32}))):
        panel.set_xscale("log", base=2)
        panel.set_xticks(marks, [str(mark) for mark in marks])
        panel.minorticks_off()
    axes[0].set(xlabel="threads", ylabel="wall time [s]", yscale="log")
    axes[1].set(xlabel="threads (paper: cores)", ylabel="speed-up over the original", ylim=(0, None))
    below(canvas, axes[0])
    return Figure("figure-12-speed", "Wall time and speed-up (paper's fig 12 and table 5)",
                  f"{source} Speed-up: the original's wall time over the case's, with as many threads (eq 43). The paper ran on a Xeon "
                  "Gold 6230R; it prints speed-ups, not times.",
                  as_png(canvas), ["case", "threads", "wall_time_s", "speed_up"], rows)


def speed_up_table(timings: list[Timing], original: str | None) -> list[list[str]]:
    """Table 5 with a header row: threads, each case, the paper's two. Empty without timings."""
    if not timings:
        return []
    gained = {case: values for case, values in speed_ups(timings, original).items() if case != original}
    counts = sorted({timing.threads for timing in timings} | set(PAPER_SPEED_UP["SSW"]))
    table = [["threads", *gained, *(f"paper, {name}" for name in PAPER_SPEED_UP)]]
    for count in counts:
        values = [case.get(count) for case in [*gained.values(), *PAPER_SPEED_UP.values()]]
        table.append([str(count), *("–" if value is None else f"{value:.2f}" for value in values)])
    return table
