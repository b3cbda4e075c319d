# SPDX-License-Identifier: BSD-3-Clause
"""Draws pictures of a mesh: quality, size, parts, ranks, and the history of its run."""
import os
import pathlib

import numpy as np
from matplotlib.colors import LogNorm, Normalize, to_rgb
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, Rectangle

from . import drawing, raster
from .drawing import ALPHA_COLOURS, ALPHA_RANGE, INK, SIZE_COLOURS
from .history import draw_history
from .read import read

ZOOM_TRIANGLES = 500  # about this many in the window around the worst triangle
MOST_NAMES = 24       # largest number of names in a legend
TRIANGLE_HEIGHT = 0.866  # height of an equilateral triangle over its side


def worst_of(alpha):
    """Returns the row of the largest value. A value that is not a number counts as larger than all others."""
    rows = [part.start + int(np.argmax(np.nan_to_num(alpha[part], nan=np.inf))) for part in raster.slices(len(alpha))]
    return rows[int(np.argmax(np.nan_to_num(alpha[rows], nan=np.inf)))]


def triangles_near(mesh, centre, reach):
    """Returns the triangles whose first vertex lies in a window, and the facets that begin there."""
    is_near = np.empty(len(mesh.points), bool)
    for part in raster.slices(len(mesh.points)):
        away = np.abs(mesh.points[part] - centre)
        is_near[part] = (away[:, 0] <= reach) & (away[:, 1] <= reach)
    chosen = [part.start + np.flatnonzero(is_near[mesh.triangles[part, 0]])
              for part in raster.slices(len(mesh.triangles))]
    return np.concatenate(chosen), np.flatnonzero(is_near[mesh.facets[:, 0]])


def draw_zoom(axes, mesh):
    """Draws the window around the worst triangle. Returns its middle and half its side."""
    worst = worst_of(mesh.alpha)
    place = mesh.corners([worst]).mean(axis=1)[0]
    low, high = drawing.box_of(mesh)
    height = float(mesh.size[mesh.triangles[worst]].mean()) * TRIANGLE_HEIGHT
    reach = min(np.sqrt(ZOOM_TRIANGLES * height * height / TRIANGLE_HEIGHT / 2) / 2, (high - low).min() / 2)
    centre = np.clip(place, low + reach, high - reach)  # a window beyond the mesh shows nothing
    chosen, rows = triangles_near(mesh, centre, 1.3 * reach)
    drawing.draw_polygons(axes, mesh, chosen, 0.35,
                          {"array": mesh.alpha[chosen], "cmap": ALPHA_COLOURS, "norm": Normalize(*ALPHA_RANGE)})
    drawing.draw_facets(axes, mesh, 1.0, rows=rows)
    drawing.frame(axes, centre - reach, centre + reach)
    axes.set_title(f"around the worst triangle ({place[0]:.4g}, {place[1]:.4g})", fontsize=9, color=INK)
    return centre, reach


def draw_histogram(axes, alpha):
    """Draws a histogram of alpha with a logarithmic scale."""
    largest = float(np.nanmax(alpha))
    top = max(1.2, min(largest, 3.0))
    bins = 80
    edges = np.linspace(1, top, bins + 1)
    counts = np.zeros(bins, int)
    for part in raster.slices(len(alpha)):
        place = (np.nan_to_num(alpha[part], nan=top) - 1) * (bins / (top - 1))
        counts += np.bincount(np.clip(place, 0, bins - 1).astype(np.int32), minlength=bins)
    shade = 0.12 + 0.88 * np.clip((edges[:-1] - ALPHA_RANGE[0]) / (ALPHA_RANGE[1] - ALPHA_RANGE[0]), 0, 1)
    axes.bar(edges[:-1], counts, np.diff(edges), align="edge", color=ALPHA_COLOURS(shade), edgecolor="#8a939b",
             linewidth=0.3, log=True)
    middle = float(np.median(alpha))
    axes.axvline(min(middle, top), color=INK, linewidth=0.8, linestyle="--")
    right = middle > (1 + top) / 2  # no room for the text on that side of its line
    axes.text(min(middle, top), counts.max() * 1.3, f"  median {middle:.4f}  ", fontsize=8, color=INK,
              horizontalalignment="right" if right else "left")
    axes.set_ylim(0.7, counts.max() * 4)
    axes.set_xlabel("alpha = R / 2r" + ("   (last bar: all beyond)" if largest > top else ""), fontsize=8)
    axes.set_ylabel("triangles", fontsize=8)
    drawing.plain_ticks(axes)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)


def draw_alpha(axes, mesh):
    """Draws all triangles, coloured by alpha, and the boundary on top."""
    drawing.draw_values(axes, mesh, mesh.alpha, ALPHA_COLOURS, ALPHA_RANGE)
    drawing.draw_facets(axes, mesh, max(3 * drawing.line_width(len(mesh.triangles)), 0.6))
    drawing.frame(axes, *drawing.box_of(mesh))


def quality_figure(mesh, name):
    """Draws the mesh coloured by alpha, a histogram, and the neighbourhood of the worst triangle."""
    figure = Figure(figsize=(14, 8.6), facecolor="white")
    grid = figure.add_gridspec(2, 2, width_ratios=[1.75, 1], height_ratios=[1, 1.45], left=0.04, right=0.985,
                               top=0.89, bottom=0.06, wspace=0.15, hspace=0.28)
    main = figure.add_subplot(grid[:, 0])
    draw_alpha(main, mesh)
    draw_histogram(figure.add_subplot(grid[0, 1]), mesh.alpha)
    if len(mesh.triangles) > 4 * ZOOM_TRIANGLES:
        middle, reach = draw_zoom(figure.add_subplot(grid[1, 1]), mesh)
        main.add_patch(Rectangle(middle - reach, 2 * reach, 2 * reach, fill=False, color=drawing.WINDOW,
                                 linewidth=1.4, zorder=5))
    drawing.add_scale(figure, main, Normalize(*ALPHA_RANGE), ALPHA_COLOURS, "alpha", extend="max")
    drawing.header(figure, name, drawing.summary(mesh), 8.6)
    return figure


def draw_size(axes, mesh, norm):
    """Draws h as colours, linear over each triangle if there are few triangles, and the boundary on top."""
    if len(mesh.triangles) <= drawing.RASTER_ABOVE:
        places = mesh.corners().reshape(-1, 2)
        axes.tripcolor(places[:, 0], places[:, 1], np.arange(len(places)).reshape(-1, 3),
                       mesh.size[mesh.triangles].ravel(), shading="gouraud", cmap=SIZE_COLOURS,
                       norm=norm).set_rasterized(True)
    else:
        drawing.draw_values(axes, mesh, mesh.size[mesh.triangles[:, 0]], SIZE_COLOURS, None, norm)
    drawing.draw_facets(axes, mesh, 0.8)
    drawing.frame(axes, *drawing.box_of(mesh))


def size_figure(mesh, name):
    """Draws the mesh and its size field side by side, or one above the other if the shape is wide."""
    width, height = drawing.sides_of(mesh)
    rows, columns = (1, 2) if width < 1.8 * height else (2, 1)
    tall = 13 / columns * float(np.clip(height / width, 0.2, 1.4)) * rows + 1.1
    figure = Figure(figsize=(14, tall), facecolor="white")
    panels = figure.subplots(rows, columns, gridspec_kw={
        "left": 0.035, "right": 0.95, "top": 1 - 1.15 / tall, "bottom": 0.35 / tall, "wspace": 0.13, "hspace": 0.12})
    draw_alpha(panels[0], mesh)
    drawing.add_scale(figure, panels[0], Normalize(*ALPHA_RANGE), ALPHA_COLOURS, "alpha", extend="max")
    panels[0].set_title("the mesh: alpha of its triangles", fontsize=10, color=INK)
    low = float(mesh.size.min())
    norm = LogNorm(low, max(float(mesh.size.max()), 1.001 * low))  # a uniform size has no range
    draw_size(panels[1], mesh, norm)
    drawing.label_sizes(drawing.add_scale(figure, panels[1], norm, SIZE_COLOURS, "h"), norm.vmin, norm.vmax)
    panels[1].set_title("its size field: the edge length h that was asked for", fontsize=10, color=INK)
    drawing.header(figure, name, drawing.summary(mesh), tall)
    return figure


def add_legend(figure, entries, tall, title, left_out):
    """Adds a legend at the right of a map."""
    handles, texts = [list(column) for column in zip(*entries)] if entries else ([], [])
    if left_out > 0:
        handles.append(Line2D([], [], linestyle=""))
        texts.append(f"and {left_out} more")
    legend = figure.legend(handles, texts, loc="upper left", frameon=False, fontsize=9, title=title, labelcolor=INK,
                           bbox_to_anchor=(1 - 2.9 / figure.get_figwidth(), 1 - 0.95 / tall), alignment="left")
    legend.get_title().set_color(INK)


def shortened(name, longest=26):
    """Returns a name that fits into a legend."""
    return name if len(name) <= longest else name[:longest - 1] + "…"


def numbers_in(values):
    """Returns the numbers that occur, ascending. Most meshes have one region, and it takes seconds to sort many equal
    numbers."""
    return np.unique(values[:1]) if (values == values[0]).all() else np.unique(values)


def parts_figure(mesh, name):
    """Draws the boundary, coloured by the part of the shape that it follows, with regions, curves, interfaces, fixed
    points and corners."""
    figure, axes, tall = drawing.panel_figure(mesh)
    numbers = numbers_in(mesh.region)
    tints = [drawing.LAND] if len(numbers) == 1 else [
        tuple(0.75 + 0.25 * np.asarray(drawing.name_colour(k + 4))) for k in range(len(numbers))]
    rows = np.searchsorted(numbers, mesh.region) if len(numbers) > 1 else np.broadcast_to(0, len(mesh.triangles))
    drawing.draw_numbers(axes, mesh, rows, [to_rgb(tint) for tint in tints])
    entries = []
    order = sorted(mesh.boundaries.values(), key=lambda boundary: -len(boundary.rows))
    for number, boundary in enumerate(order):
        colour = drawing.name_colour(number)
        drawing.draw_facets(axes, mesh, 2.2, colour, boundary.rows)
        entries.append((Line2D([], [], color=colour, linewidth=3),
                        f"{shortened(boundary.name)}: {len(boundary.rows):,} edges"))
    for number, inner in enumerate([*mesh.interfaces.values(), *mesh.curves.values()], len(order)):
        colour = drawing.name_colour(number)
        drawing.draw_inner_edges(axes, mesh, inner.edges, 1.6, colour)
        entries.append((Line2D([], [], color=colour, linewidth=2),
                        f"{shortened(inner.name)}: {len(inner.rows):,} edges"))
    left_out = len(entries) - MOST_NAMES
    entries = entries[:MOST_NAMES]
    corners = mesh.points[mesh.fixed]
    if 0 < len(corners) <= 2000:
        axes.plot(*corners.T, linestyle="", marker="o", markersize=4, markerfacecolor="white", markeredgecolor=INK,
                  markeredgewidth=0.9, zorder=4)
        entries.append((Line2D([], [], linestyle="", marker="o", markersize=4, markerfacecolor="white",
                               markeredgecolor=INK), f"{len(corners):,} corners and fixed points"))
    for number, tint in zip(numbers, tints):
        entries.append((Patch(facecolor=tint, edgecolor=drawing.PALE),
                        f"region {shortened(mesh.regions.get(int(number), str(number)))}"))
    drawing.frame(axes, *drawing.box_of(mesh))
    add_legend(figure, entries, tall, "boundary, by part of the shape", left_out)
    drawing.header(figure, name, drawing.summary(mesh), tall)
    return figure


def ranks_figure(mesh, name):
    """Draws the triangles, coloured by the rank of their first vertex."""
    figure, axes, tall = drawing.panel_figure(mesh)
    ranks = len(mesh.first_point)
    owner = mesh.ranks()[mesh.triangles[:, 0]]
    drawing.draw_numbers(axes, mesh, owner, [drawing.name_colour(rank) for rank in range(ranks)])
    drawing.draw_facets(axes, mesh, 0.6)
    drawing.frame(axes, *drawing.box_of(mesh))
    points = np.diff(np.append(mesh.first_point, len(mesh.points)))
    entries = [(Patch(facecolor=drawing.name_colour(rank)), f"rank {rank}: {points[rank]:,} points")
               for rank in range(min(ranks, MOST_NAMES))]
    spread = f"most over mean {points.max() / max(points.mean(), 1e-9):.3f}"
    add_legend(figure, entries, tall, f"{ranks} rank{'s' if ranks > 1 else ''}, {spread}", ranks - MOST_NAMES)
    drawing.header(figure, name, drawing.summary(mesh), tall)
    return figure


def history_figure(mesh, name):
    """Draws alpha and the share of the points that move, over the sweeps of all stages."""
    figure = Figure(figsize=(12, 7.2), facecolor="white")
    draw_history(figure, mesh.history)
    drawing.header(figure, name, f"{drawing.summary(mesh)}   stopped: {mesh.attributes.get('stop_reason', '')}", 7.2)
    return figure


FIGURES = {"quality": quality_figure, "size": size_figure, "parts": parts_figure, "ranks": ranks_figure,
           "history": history_figure}


def plot(mesh, what="quality", file=None, dpi=130):
    """Draws `what` (quality, size, parts, ranks, history) of a Mesh, or of the mesh file of this path.

    file is the path of the picture; its ending decides the format (.png, .svg, .pdf). Returns the matplotlib figure.
    Meshes of more than 200000 triangles are drawn as pixels: mean alpha, mean h.

    Raises ValueError for another `what`, for a mesh without triangles, and for a history without records.
    """
    if what not in FIGURES:
        raise ValueError(f"what={what!r}: expected one of {', '.join(FIGURES)}")
    if isinstance(mesh, (str, os.PathLike)):
        mesh = read(mesh, in_place=True)
    if len(mesh.triangles) == 0:
        raise ValueError(f"{mesh.path} holds no triangles")
    if what == "history" and len(mesh.history.get("sweep", ())) == 0:
        raise ValueError(f"{mesh.path} holds no history: it is a step of a run, or of an older version")
    figure = FIGURES[what](mesh, pathlib.Path(mesh.path).stem)
    if file is not None:
        figure.savefig(file, dpi=dpi)
    return figure
