# SPDX-License-Identifier: BSD-3-Clause
"""Draws rows as PNG and SVG: time and efficiency over cores with the ideal line, and shares of the phases as bars."""
import itertools
import re

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (the backend comes first)
from matplotlib.ticker import FixedLocator, FuncFormatter, LogLocator, NullLocator, ScalarFormatter  # noqa: E402

from .summary import curves_of, group_by, key_of, size_of  # noqa: E402
from .tables import sort_key, title_of  # noqa: E402

COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#f0e442", "#000000"]  # Okabe and Ito
STYLES = {"ranks": ("-", "o"), "threads": ("--", "s"), "ranks and threads": (":", "^")}
SMALL_SHARE = 2.0   # per cent: phases below it in all bars are drawn together
SIZE = (6.4, 4.2)   # inches


def way_of(row):
    """Returns what divides the work: ranks, threads, or both."""
    return "ranks" if row["threads"] == 1 else "threads" if row["ranks"] == 1 else "ranks and threads"


def lines_of(curve):
    """The rows of a curve by way, each from the base on, by cores."""
    usable = sorted((row for row in curve if row["efficiency"] is not None), key=sort_key)
    base = [row for row in usable if row["is_base"]]
    ways = group_by([row for row in usable if not row["is_base"]], way_of)
    return [(way_of(rows[0]), base + rows) for rows in ways]


def cores_axis(axes, cores):
    """Cores on a logarithmic axis, a label at each that occurs (at most eight)."""
    axes.set_xscale("log", base=2)
    axes.xaxis.set_major_locator(FixedLocator(cores[::max(1, -(-len(cores) // 8))]))
    axes.xaxis.set_major_formatter(ScalarFormatter())
    axes.xaxis.set_minor_locator(NullLocator())
    axes.set_xlabel("cores")


def save(figure, directory, rows, *words):
    """One figure of some rows in both formats; returns the name of the PNG."""
    size = f"{size_of(rows[0]):.6g}".replace("+", "")
    stem = re.sub(r"[^A-Za-z0-9.]+", "-", " ".join([title_of(rows[0]), *words[:-1], size, rows[0]["stop"], words[-1]]))
    figure.savefig(directory / f"{stem}.png", dpi=150)
    figure.savefig(directory / f"{stem}.svg")
    plt.close(figure)
    return f"{stem}.png"


def subtitle(rows):
    """Size and stop of a figure."""
    first = rows[0]
    points = f"{size_of(first):,} points" + (" a core" if first["kind"] == "weak" else "")
    stop = "fixed number of sweeps" if first["stop"] == "fixed" else "to the stop rule"
    return f"{title_of(first)}: {points}, {stop}"


def curve_figure(rows, value, label, ideal):
    """Values of all methods over cores; `ideal(curve)` gives the ideal value of a curve as a function of cores.

    Returns figure and axes.
    """
    figure, axes = plt.subplots(figsize=SIZE, layout="constrained")
    cores = sorted({row["cores"] for row in rows if row["efficiency"] is not None})
    ideals = {}
    for colour, curve in zip(itertools.cycle(COLOURS), curves_of(rows)):
        for way, line in lines_of(curve):
            style, marker = STYLES[way]
            axes.plot([row["cores"] for row in line], [value(row) for row in line], style, marker=marker, color=colour,
                      markersize=5, label=f"{line[0]['method']}, {way}")
        ideals[tuple(ideal(curve)(count) for count in cores)] = None
    for number, line in enumerate(ideals):
        axes.plot(cores, line, color="0.3", linewidth=1, zorder=1, label="" if number else "ideal")
    cores_axis(axes, cores)
    axes.set_ylabel(label)
    axes.set_title(subtitle(rows), fontsize=10)
    axes.grid(color="0.9")
    axes.set_axisbelow(True)
    axes.legend(fontsize=8, frameon=False)
    return figure, axes


def efficiency_figure(rows, directory):
    """Efficiency over cores; the ideal is 1."""
    figure, axes = curve_figure(rows, lambda row: row["efficiency"], "efficiency", lambda _: lambda cores: 1)
    axes.set_ylim(0, max(1.1, axes.get_ylim()[1]))
    axes.legend(fontsize=8, loc="lower left", frameon=False)
    return save(figure, directory, rows, "efficiency")


def base_time(curve):
    """The ideal seconds of a curve as a function of cores."""
    base = next(row for row in curve if row["is_base"])
    if base["kind"] == "weak":
        return lambda cores: base["seconds"]
    return lambda cores: base["seconds"] * base["cores"] / cores


def time_figure(rows, directory):
    """Seconds over cores, both logarithmic; an ideal line for each curve."""
    figure, axes = curve_figure(rows, lambda row: row["seconds"], "seconds, without output", base_time)
    axes.set_yscale("log")
    axes.yaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axes.yaxis.set_minor_locator(NullLocator())
    return save(figure, directory, rows, "time")


def phase_shares(rows):
    """Shares of the time by phase in per cent, a list over the rows for each; the small ones together."""
    names = list(dict.fromkeys(name for row in rows for name in row["phases"]))
    totals = [sum(phase["avg"] for phase in row["phases"].values()) for row in rows]
    shares = {name: [100 * row["phases"].get(name, {"avg": 0.0})["avg"] / total for row, total in zip(rows, totals)]
              for name in names}
    small = [name for name in names if max(shares[name]) < SMALL_SHARE]
    large = {name: shares[name] for name in names if name not in small}
    return large | ({"the rest": [sum(column) for column in zip(*(shares[name] for name in small))]} if small else {})


def phase_figure(rows, directory):
    """Shares of the time by phase of one method as bars, the seconds above them."""
    rows = sorted(rows, key=sort_key)
    figure, axes = plt.subplots(figsize=SIZE, layout="constrained")
    floor = [0.0] * len(rows)
    for colour, (name, shares) in zip(itertools.cycle(plt.get_cmap("tab20").colors), phase_shares(rows).items()):
        axes.bar(range(len(rows)), shares, 0.65, bottom=floor, color=colour, label=name)
        floor = [below + share for below, share in zip(floor, shares)]
    for place, row in enumerate(rows):
        axes.text(place, 101, f"{row['total_s']:.3g} s", ha="center", va="bottom", fontsize=8)
    axes.set_ylim(0, 108)
    axes.set_xticks(range(len(rows)), [f"{row['ranks']} x {row['threads']}" for row in rows])
    axes.set_xlabel("ranks x threads")
    axes.set_ylabel("share of the time, %")
    axes.set_title(f"{rows[0]['method']}, {subtitle(rows)}", fontsize=10)
    handles, labels = axes.get_legend_handles_labels()
    axes.legend(handles[::-1], labels[::-1], fontsize=8, frameon=False, loc="center left", bbox_to_anchor=(1, 0.5))
    return save(figure, directory, rows, rows[0]["method"], "phases")


def last_stop(rows, like):
    """The stop that the phases of a sweep are drawn for: one is enough."""
    return [row["stop"] for row in rows if row["sweep"] == like["sweep"]][-1]


def draw(rows, directory):
    """All pictures of some rows; returns the names of the PNGs."""
    names = []
    figures = ("backend", "sweep", "variant", "stop", "output")
    for group in group_by(rows, lambda row: key_of(row, figures) + (size_of(row),)):
        if len({row["cores"] for row in group if row["efficiency"] is not None}) > 1:
            names += [time_figure(group, directory), efficiency_figure(group, directory)]
            names += [phase_figure(of_method, directory) for of_method in group_by(group, lambda row: row["method"])
                      if of_method[0]["stop"] == last_stop(rows, of_method[0])]
    return names
