# SPDX-License-Identifier: MIT
"""Tables, figures and docs/speed_error.md from the ladders' rows."""
import datetime
import math

import measure
import page_parts
from defaults import defaults
from page_parts import ROOT
from text import BEHIND, FRONT, FRONTS, HEAD, SECTIONS, SLOPED


def chosen(rows, ladder, case=None, quantity=None):
    return [row for row in rows
            if row.ladder == ladder and case in (None, row.case) and quantity in (None, row.quantity)]


def percent(value, uncertainty=None):
    """A relative error as text; with an uncertainty, to the digits that this leaves."""
    if uncertainty is None: return f"{100 * value:.2g} %"
    digits = min(2, max(0, 1 - math.floor(math.log10(100 * uncertainty)))) if uncertainty > 0 else 2
    return f"{100 * value:+.{digits}f} ± {100 * uncertainty:.{digits}f} %"


def cell(row):
    if row.error is None and row.uncertainty is None: return f"{row.value:.4g}"
    if row.error is None: return f"{row.value:.4g} (one run ± {100 * row.uncertainty:.2g} %)"
    return percent(row.error, row.uncertainty)


def slope(rows):
    """Of log error against log setting, where at least three errors are exact; as text."""
    points = [(math.log(row.position), math.log(abs(row.error))) for row in rows if row.uncertainty is None and row.error]
    if len(points) < 3: return "–"
    x, y = (sum(values) / len(points) for values in zip(*points))
    return f"{sum((a - x) * (b - y) for a, b in points) / sum((a - x)**2 for a, _ in points):.1f}"


def ladder_table(rows, first):
    """Settings down, quantities across, cost behind them. `first` is the title of the settings."""
    quantities = list(dict.fromkeys(row.quantity for row in rows))
    lines = []
    for setting in dict.fromkeys(row.setting for row in rows):
        mine = {row.quantity: row for row in rows if row.setting == setting}
        cost = next(row for row in mine.values() if row.cpu_seconds is not None)
        speed = cost.grain_steps_per_second
        lines.append([setting] + [cell(mine[q]) if q in mine else "–" for q in quantities] +
                     [f"{cost.cpu_seconds:.3g}", f"{speed / 1e6:.2f}" if speed else "–"])
    slopes = [slope([row for row in rows if row.quantity == q]) for q in quantities]
    if rows[0].case in SLOPED and set(slopes) != {"–"}: lines.append(["slope"] + slopes + ["", ""])
    return page_parts.table([first] + [">" + q for q in quantities] + [">CPU s", ">10^6 grain-steps/s"], lines)


def front(rows, errors, costs):
    """Of rungs that have both: (setting, cost over that of the dearest, error, whether no rung is both cheaper and nearer
    by more than twice what the runs can tell)."""
    cost_of = {row.position: row.cpu_seconds for row in chosen(rows, *costs)}
    points = [(row.setting, cost_of[row.position], abs(row.error), 2 * (row.uncertainty or 0))
              for row in chosen(rows, *errors) if row.error is not None and row.position in cost_of]
    dearest = max(cost_of.values())
    return [(setting, cost / dearest, error, not any(c < cost and e + doubt <= error for _, c, e, _ in points))
            for setting, cost, error, doubt in points]


def draw_ladder(axes, rows, title, scattered):
    for case, quantity in dict.fromkeys((row.case, row.quantity) for row in rows):
        mine = [row for row in rows if (row.case, row.quantity) == (case, quantity) and row.error is not None]
        positions, label = [row.position for row in mine], f"{case}: {quantity}"
        errors = [100 * row.error for row in mine]
        if scattered:
            axes.errorbar(positions, errors, [100 * row.uncertainty for row in mine], fmt="o-", markersize=4, capsize=3,
                          label=label)
        else:
            axes.plot(positions, [abs(error) for error in errors], "o-", markersize=4, label=label)
    axes.set_xscale("log")
    if scattered: axes.axhline(0, color="k", linewidth=0.6)
    else: axes.set_yscale("log")
    axes.set(xlabel=title, ylabel="difference from the first rung, %" if scattered else "error, %")
    axes.legend(fontsize=6)
    axes.grid(alpha=0.3)


def draw_front(axes, rows):
    for name, errors, costs in FRONTS:
        points = front(rows, errors, costs)
        best = sorted(point[1:3] for point in points if point[3])
        line, = axes.plot(*zip(*best), "o-", markersize=4, label=name)
        beaten = [(cost, error) for _, cost, error, on_front in points if not on_front]
        if beaten: axes.plot(*zip(*beaten), "o", mfc="none", markersize=4, color=line.get_color())
    axes.set(xscale="log", yscale="log", xlabel="cost / cost of the dearest rung", ylabel="error")
    axes.legend(fontsize=6)
    axes.grid(alpha=0.3)


def draw_discharge(axes, rows):
    for quantity in ("discharged mass, kg", "Beverloo 1961"):
        mine = [row for row in chosen(rows, "k", quantity=quantity) if row.error is not None]
        axes.errorbar([row.setting for row in mine], [100 * row.error for row in mine],
                      [100 * (row.uncertainty or 0) for row in mine], fmt="o", capsize=3, label=quantity)
    axes.set(ylabel="discharge against k = 1, %")
    axes.legend()
    axes.grid(alpha=0.3)


def draw(rows):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    def figure(name, left, right):
        drawn, axes = plt.subplots(1, 2, figsize=(10, 4))
        left(axes[0])
        right(axes[1])
        drawn.tight_layout()
        drawn.savefig(ROOT / f"docs/speed_error_{name}.png", dpi=100)
        plt.close(drawn)

    for ladder, title in (("time step", "step / critical step"), ("coupling", "grain steps per fluid step")):
        mine = chosen(rows, ladder)
        sure = [row for row in mine if row.uncertainty is None]
        scattered = [row for row in mine if row.uncertainty is not None and "stored" not in row.quantity]
        figure(ladder.replace(" ", "_"), lambda axes: draw_ladder(axes, sure, title, False),
               lambda axes: draw_ladder(axes, scattered, title, True))
    figure("front", lambda axes: draw_discharge(axes, rows), lambda axes: draw_front(axes, rows))


def write(rows, version, minutes):
    """docs/speed_error.md and its figures; `minutes` is the processor time of all runs."""
    draw(rows)
    parts = [HEAD.format(date=datetime.date.today().isoformat(), name=measure.machine_name(), version=version,
                         machine=page_parts.machine(), minutes=minutes), defaults(rows)]
    for title, figure, ladder, first, words in SECTIONS:
        parts.append(f"## {title}\n{words}")
        if figure: parts.append(f"![{title}](speed_error_{figure}.png)\n")
        cases = list(dict.fromkeys(row.case for row in chosen(rows, ladder)))
        for case in cases:
            if len(cases) > 1: parts.append(f"{case[0].upper()}{case[1:]}:\n")
            parts.append(ladder_table(chosen(rows, ladder, case), first) + "\n")
    points = [[called, setting, f"{cost:.3g}", percent(error), "yes" if best else "no"]
              for called, errors, costs in FRONTS for setting, cost, error, best in front(rows, errors, costs)]
    columns = ["ladder: error", "setting", ">cost / dearest", ">error", "on the front"]
    parts += [FRONT, page_parts.table(columns, points) + "\n", BEHIND]
    (ROOT / "docs/speed_error.md").write_text("\n".join(parts))
