# SPDX-License-Identifier: BSD-3-Clause
"""Draws the history of a run: alpha, and the share of the points that move, over the sweeps."""
import numpy as np
from matplotlib.ticker import FuncFormatter, MaxNLocator

from . import drawing
from .drawing import INK

CURVES = (("max_alpha", "max", "#8c1d40"), ("mean_alpha", "mean", "#d9603f"), ("median_alpha", "median", "#0b6e99"))
SHADES = ("#f4f5f6", "#e6e9ec")  # of stages, alternately
LEAST_EXCESS = 1e-6              # of alpha over 1: the scale is logarithmic
LEAST_MOVE = 1e-5                # [h] this scale is logarithmic, too


def stages_of(history):
    """Returns (stage, rows) of each stage, in order."""
    stage = np.asarray(history["stage"])
    return [(int(number), np.flatnonzero(stage == number)) for number in np.unique(stage)]


def draw_stages(axes, history, with_names):
    """Draws a shade for each stage, and writes its number of points."""
    sweep, points = np.asarray(history["sweep"]), np.asarray(history["points"])
    whole = max(float(sweep[-1] - sweep[0]), 1)
    stages = stages_of(history)
    for k, (number, rows) in enumerate(stages):
        left = sweep[rows[0]]
        right = sweep[stages[k + 1][1][0]] if k + 1 < len(stages) else sweep[-1]
        axes.axvspan(left, right, color=SHADES[k % 2], linewidth=0, zorder=0)
        if with_names and (right - left) / whole > 0.04:
            text = f"{points[rows[-1]]:,} points" if (right - left) / whole > 0.13 else f"{points[rows[-1]]:.1e}"
            if len(stages) > 1 and (right - left) / whole > 0.22:
                text = f"stage {number + 1} of {len(stages)}: {text}"
            axes.text((left + right) / 2, 1.015, text, transform=axes.get_xaxis_transform(), fontsize=8, color=INK,
                      horizontalalignment="center")


def draw_rules(axes, history):
    """Draws a mark where bars are replaced by Voronoi cells, with the word if there is room."""
    sweep, bars = np.asarray(history["sweep"]), np.asarray(history.get("by_bars", []))
    for k in np.flatnonzero((bars[:-1] == 1) & (bars[1:] == 0)) if len(bars) == len(sweep) else ():
        axes.axvline(sweep[k + 1], color="#8a939b", linewidth=0.8, linestyle=":")
        axes.text(sweep[k + 1], 0.97, " bars → cells", transform=axes.get_xaxis_transform(), fontsize=7, color=INK,
                  verticalalignment="top")


def broken(history, name, first=0):
    """Returns sweeps and values of a column, from record `first` of each stage, with a gap between stages."""
    x, y = [], []
    for _, rows in stages_of(history):
        x += [*np.asarray(history["sweep"])[rows[first:]], np.nan]
        y += [*np.asarray(history[name], float)[rows[first:]], np.nan]
    return np.array(x, float), np.array(y)


def draw_history(figure, history):
    """Draws the two panels of a figure, one above the other."""
    above, below = figure.subplots(2, 1, sharex=True, gridspec_kw={
        "left": 0.07, "right": 0.93, "top": 0.84, "bottom": 0.075, "hspace": 0.08, "height_ratios": [1.5, 1]})
    for axes in (above, below):
        draw_stages(axes, history, axes is above)
        drawing.plain_ticks(axes)
        axes.margins(x=0)
    marker = "." if len(history["sweep"]) <= 80 else ""
    for name, text, colour in CURVES:
        x, y = broken(history, name)
        above.plot(x, np.maximum(y - 1, LEAST_EXCESS), color=colour, linewidth=1.6, marker=marker, label=text)
    above.set_yscale("log")
    above.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"1 + {value:g}"))
    above.set_ylabel("alpha of the triangles", fontsize=9, color=INK)
    above.set_xlim(0, max(int(np.asarray(history["sweep"])[-1]), 1))
    above.legend(loc="upper right", fontsize=8, frameon=True, facecolor="white", edgecolor="none", framealpha=0.85)
    draw_rules(above, history)
    x, y = broken(history, "moving_share", 1)  # nothing has moved before the first record
    below.plot(x, 100 * y, color="#0b6e99", linewidth=1.6, marker=marker)
    below.set_ylabel("points that move [%]", fontsize=9, color="#0b6e99")
    below.set_ylim(0, 105)
    moves = below.twinx()
    x, y = broken(history, "max_move", 1)
    moves.margins(x=0)
    moves.plot(x, np.maximum(y, LEAST_MOVE), color="#e69f00", linewidth=1.2, marker=marker)
    moves.set_yscale("log")
    least = np.nanmin(np.append(np.maximum(y, LEAST_MOVE), 0.1))
    moves.set_ylim(10 ** np.floor(np.log10(least)), 1)
    moves.set_ylabel("longest move [h]", fontsize=9, color="#b27800")
    drawing.plain_ticks(moves)
    below.set_xlabel("sweep", fontsize=9, color=INK)
    below.xaxis.set_major_locator(MaxNLocator(integer=True))
