# SPDX-License-Identifier: MIT
"""Tables, figures and docs/speed_error.md from the ladders' rows."""
import collections
import datetime
import json
import math

import page_parts
from page_parts import ROOT
from text import BEHIND, FRONTS, HEAD, SECTIONS, defaults


def chosen(rows, ladder, case=None):
    return [row for row in rows if row.ladder == ladder and (case is None or row.case == case)]


def percent(value, uncertainty=None):
    """A relative error as text, with two digits or those that its uncertainty leaves."""
    text = f"{100 * value:.2g}"
    if uncertainty is None: return f"{text} %"
    digits = max(0, 1 - math.floor(math.log10(100 * uncertainty))) if uncertainty > 0 else 2
    return f"{100 * value:+.{min(digits, 2)}f} ± {100 * uncertainty:.{min(digits, 2)}f} %"


def cell(row):
    if row.error is None: return f"{row.value:.4g} ± {percent(row.uncertainty)}"
    if row.uncertainty is not None: return percent(row.error, row.uncertainty)
    return percent(row.error)


def ladder_table(rows, first):
    """Settings down, quantities across; cost behind them. `first` is the title of the settings."""
    quantities = list(dict.fromkeys(row.quantity for row in rows))
    lines = []
    for setting in dict.fromkeys(row.setting for row in rows):
        mine = {row.quantity: row for row in rows if row.setting == setting}
        cost = [row for row in mine.values() if not math.isnan(row.cpu_seconds)]
        speed = [row.grain_steps_per_second for row in cost if row.grain_steps_per_second]
        lines.append([setting] + [cell(mine[q]) if q in mine else "–" for q in quantities] +
                     [f"{cost[0].cpu_seconds:.3g}" if cost else "–", f"{speed[0] / 1e6:.2f}" if speed else "–"])
    return page_parts.table([first] + [">" + q for q in quantities] + [">CPU s", ">10^6 grain-steps/s"], lines)


def front(rows, errors, costs):
    """(setting, cost over that of the dearest rung, error, whether no rung is both cheaper and nearer)."""
    cost_of = {row.position: row.cpu_seconds for row in chosen(rows, *costs[:2]) if row.quantity == costs[2]}
    points = [(row.setting, cost_of[row.position], abs(row.error)) for row in chosen(rows, *errors[:2])
              if row.quantity == errors[2] and row.error is not None and row.position in cost_of]
    dearest = max(cost_of.values())
    return [(setting, cost / dearest, error, not any(c < cost and e <= error for _, c, e in points)) for setting, cost, error in points]


def draw_errors(axes, rows, title, relative_to_scatter=False):
    by_quantity = collections.defaultdict(list)
    for row in rows:
        if row.error is not None: by_quantity[row.case, row.quantity].append(row)
    for (case, quantity), mine in by_quantity.items():
        positions, errors = [row.position for row in mine], [abs(row.error) * 100 for row in mine]
        if relative_to_scatter: axes.errorbar(positions, [row.error * 100 for row in mine], [row.uncertainty * 100 for row in mine],
                                              marker="o", capsize=3, label=quantity)
        else: axes.plot(positions, errors, "o-", label=f"{case}: {quantity}", markersize=4)
    axes.set_xscale("log")
    if not relative_to_scatter: axes.set_yscale("log")
    axes.set_xlabel(title)
    axes.set_ylabel("error, %")
    axes.legend(fontsize=6)
    axes.grid(alpha=0.3)


def draw(rows):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    def save(figure, name):
        figure.tight_layout()
        figure.savefig(ROOT / f"docs/speed_error_{name}.png", dpi=100)
        plt.close(figure)

    def pair(ladder, title, name):
        mine = chosen(rows, ladder)
        exact = [row for row in mine if row.uncertainty is None and row.error]
        scattered = [row for row in mine if row.uncertainty is not None]
        figure, axes = plt.subplots(1, 2, figsize=(10, 4))
        draw_errors(axes[0], exact, title)
        draw_errors(axes[1], scattered, title, relative_to_scatter=True)
        axes[1].axhline(0, color="k", linewidth=0.6)
        save(figure, name)

    pair("time step", "step / critical step", "time_step")
    pair("coupling", "grain steps per fluid step", "coupling")
    figure, axes = plt.subplots(1, 2, figsize=(10, 4))
    for row_case, marker in (("discharge", "o"), ("Beverloo 1961", "s")):
        mine = [row for row in chosen(rows, "k", row_case) if row.error is not None]
        axes[0].errorbar([row.setting for row in mine], [100 * row.error for row in mine],
                         [100 * (row.uncertainty or 0) for row in mine], fmt=marker, capsize=3, label=row_case)
    axes[0].legend()
    axes[0].set_ylabel("discharged mass against k = 1, %")
    for name, errors, costs in FRONTS:
        points = front(rows, errors, costs)
        best = sorted(p[1:3] for p in points if p[3])
        line, = axes[1].plot([c for c, _ in best], [100 * e for _, e in best], "o-", label=name, markersize=4)
        beaten = [p for p in points if not p[3]]
        axes[1].plot([p[1] for p in beaten], [100 * p[2] for p in beaten], "o", mfc="none", color=line.get_color(), markersize=4)
    axes[1].set_xscale("log")
    axes[1].set_yscale("log")
    axes[1].set_xlabel("cost / cost of the dearest rung")
    axes[1].set_ylabel("error, %")
    axes[1].legend(fontsize=7)
    axes[1].grid(alpha=0.3)
    save(figure, "front")


def write(rows, runs):
    draw(rows)
    total = sum(json.loads(path.read_text())["cpu_seconds"] for path in runs.folder.glob("*/cost.json"))
    parts = [HEAD.format(date=datetime.date.today().isoformat(), version=runs.version, machine=page_parts.machine(),
                         minutes=total / 60)]
    parts.append(defaults(rows))
    for title, figure, ladder, first, words in SECTIONS:
        parts.append(f"## {title}\n\n{words}")
        if figure: parts.append(f"![{title}](speed_error_{figure}.png)\n")
        for case in dict.fromkeys(row.case for row in chosen(rows, ladder)):
            parts.append(f"{case}:\n\n" + ladder_table(chosen(rows, ladder, case), first) + "\n")
    points = [[name, setting, f"{cost:.3g}", percent(error), "yes" if best else "no"]
              for name, errors, costs in FRONTS for setting, cost, error, best in front(rows, errors, costs)]
    parts.append("## Front\n\nOn the front: no rung of the ladder is both cheaper and nearer. Drawn above, on the right.\n")
    parts.append(page_parts.table(["ladder, error of", "setting", ">cost / dearest", ">error", "on the front"], points) + "\n")
    parts.append(BEHIND)
    (ROOT / "docs/speed_error.md").write_text("\n".join(parts))
