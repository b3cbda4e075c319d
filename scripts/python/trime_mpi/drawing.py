# SPDX-License-Identifier: BSD-3-Clause
"""The functions that all pictures share: colours, frames, headers, and triangles as polygons or as pixels."""
import matplotlib
import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import LinearSegmentedColormap, Normalize, to_rgb
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

from . import raster

RASTER_ABOVE = 200_000  # more triangles are drawn as pixels
LINES_ABOVE = 100_000   # more facets are drawn as pixels
PIXELS = 1200           # of the longer side of a picture
INK, PALE, WINDOW = "#26323d", "#b8bfc6", "#0b6e99"
LAND = "#eceae4"        # colour of triangles whose value does not matter
ALPHA_COLOURS = LinearSegmentedColormap.from_list("alpha", ["#f7f5ee", "#f6e3a1", "#f2ae5f", "#d9603f", "#8c1d40"])
ALPHA_RANGE = (1.0, 1.3)
SIZE_COLOURS = LinearSegmentedColormap.from_list("size", ["#0b3954", "#1d6f8a", "#4fa69a", "#a7cf9b", "#f3efc3"])
NAME_COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#7b3294", "#8c510a", "#1b7837",
                "#c51b7d", "#4d4d4d", "#b2182b"]  # most people can distinguish them, and all people the first seven


def name_colour(number):
    """Returns a colour for the number of a name or a rank. Numbers beyond the list get hues by the golden ratio."""
    if number < len(NAME_COLOURS):
        return to_rgb(NAME_COLOURS[number])
    hue = (number * 0.6180339887498949) % 1
    return tuple(matplotlib.colors.hsv_to_rgb((hue, 0.45 + 0.3 * (number % 3 == 0), 0.65 + 0.25 * (number % 2))))


def frame(axes, low, high):
    """Sets equal scales, a window with a margin, and few ticks."""
    margin = 0.02 * (high - low).max()
    axes.set_aspect("equal")
    axes.set_xlim(low[0] - margin, high[0] + margin)
    axes.set_ylim(low[1] - margin, high[1] + margin)
    plain_ticks(axes)


def plain_ticks(axes):
    """Sets small ticks and a pale frame."""
    axes.tick_params(labelsize=7, colors=INK, length=2, which="both")
    for spine in axes.spines.values():
        spine.set_color(PALE)


def box_of(mesh):
    """Returns the lower left and the upper right corner."""
    columns = mesh.points.T
    return np.array([column.min() for column in columns]), np.array([column.max() for column in columns])


def sides_of(mesh):
    """Returns width and height, which are never 0."""
    low, high = box_of(mesh)
    return np.maximum(high - low, 1e-300)


def header(figure, title, text, tall):
    """Writes a bold line and a plain one at the top of a figure; tall: its height in inches."""
    figure.text(0.04, 1 - 0.40 / tall, title, fontsize=16, fontweight="bold", color=INK)
    figure.text(0.04, 1 - 0.69 / tall, text, fontsize=10, color=INK)


def summary(mesh):
    """Returns the text of the plain line: the numbers of the mesh."""
    text = f"{len(mesh.points):,} points   {len(mesh.triangles):,} triangles"
    if "alpha_mean" in mesh.quality:
        text += (f"   alpha mean {mesh.quality['alpha_mean']:.4f}, max {mesh.quality['alpha_max']:.3f}"
                 f"   smallest angle {mesh.quality['min_angle_degrees']:.1f}°")
    return text + f"   mesh_hash {mesh.hash}"


def panel_figure(mesh, beside=2.9):
    """Makes a figure with one map at the left, in the proportions of its shape, and `beside` inches at the right.

    Returns the figure, the axes of the map, and the height of the figure in inches.
    """
    width, height = sides_of(mesh)
    scale = min(9.6 / width, 8.2 / height)
    across, up = max(scale * width, 4.6), max(scale * height, 2.6)
    wide, tall = max(across + 0.8 + beside, 9.2), up + 1.4
    figure = Figure(figsize=(wide, tall), facecolor="white")
    axes = figure.add_axes([0.55 / wide, 0.4 / tall, across / wide, up / tall])
    axes.set_anchor("NW")
    return figure, axes, tall


def line_width(triangles):
    """Returns the width of edges for this number of triangles."""
    return float(np.clip(22 / np.sqrt(max(triangles, 1)), 0.03, 0.5))


def draw_polygons(axes, mesh, chosen, width, colours):
    """Draws the triangles of the index `chosen` as polygons. colours: options of PolyCollection."""
    axes.add_collection(PolyCollection(mesh.corners(chosen), linewidths=width, rasterized=True,
                                       **{"edgecolors": INK, **colours}))


def draw_facets(axes, mesh, width=0.6, colour=INK, rows=slice(None)):
    """Draws the boundary, or some rows of it, as lines. If there are too many, it draws pixels."""
    if len(mesh.facets[rows]) <= LINES_ABOVE:
        axes.add_collection(LineCollection(mesh.facet_ends(rows), colors=[colour], linewidths=width,
                                           capstyle="round", rasterized=len(mesh.facets[rows]) > 20_000))
        return
    canvas = raster.Canvas(*box_of(mesh), PIXELS)
    mask = raster.facet_mask(mesh, canvas, rows)
    image = np.zeros(canvas.shape + (4,))
    image[mask] = to_rgb(colour) + (1.0,)
    axes.imshow(image, origin="lower", extent=canvas.extent, interpolation="nearest", zorder=2)


def draw_inner_edges(axes, mesh, edges, width, colour):
    """Draws edges inside, given by their ends [k,2], as lines; nothing if there are too many."""
    if len(edges) <= LINES_ABOVE:
        axes.add_collection(LineCollection(mesh.edge_ends(edges), colors=[colour], linewidths=width, capstyle="round",
                                           rasterized=len(edges) > 20_000))


def draw_values(axes, mesh, value, colours, limits, norm=None):
    """Draws all triangles, coloured by value [M]."""
    norm = norm or Normalize(*limits)
    if len(mesh.triangles) <= RASTER_ABOVE:
        draw_polygons(axes, mesh, slice(None), line_width(len(mesh.triangles)),
                      {"array": value, "cmap": colours, "norm": norm})
        return
    canvas = raster.Canvas(*box_of(mesh), PIXELS)
    image, polygons = raster.mean_image(mesh, canvas, value)
    axes.imshow(image, origin="lower", extent=canvas.extent, cmap=colours, norm=norm, interpolation="nearest")
    if len(polygons):
        draw_polygons(axes, mesh, polygons, 0.2,
                      {"array": value[polygons], "cmap": colours, "norm": norm, "edgecolors": "face"})


def draw_numbers(axes, mesh, number, palette):
    """Draws all triangles. number [M] chooses the row of palette [k,3] for each triangle."""
    palette = np.asarray(palette, float)
    if len(mesh.triangles) <= RASTER_ABOVE:
        draw_polygons(axes, mesh, slice(None), 0.6 * line_width(len(mesh.triangles)), {"facecolors": palette[number]})
        return
    canvas = raster.Canvas(*box_of(mesh), PIXELS)
    image, polygons = raster.number_image(mesh, canvas, number)
    pixels = np.concatenate([palette, [(1, 1, 1)]])[image]
    axes.imshow(pixels, origin="lower", extent=canvas.extent, interpolation="nearest")
    if len(polygons):
        draw_polygons(axes, mesh, polygons, 0.2, {"facecolors": palette[number[polygons]], "edgecolors": "face"})


def add_scale(figure, axes, norm, colours, label, extend="neither"):
    """Adds a colour bar to the right of axes."""
    bar = figure.colorbar(ScalarMappable(norm, colours), ax=axes, fraction=0.03, pad=0.015, aspect=40, extend=extend)
    bar.ax.tick_params(labelsize=7, which="both")
    bar.set_label(label, fontsize=8)
    return bar


def label_sizes(bar, low, high):
    """Sets five ticks with three digits, since decades are too far apart for most meshes."""
    bar.ax.yaxis.set_major_locator(FixedLocator(np.geomspace(low, high, 5)))
    bar.ax.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:.3g}"))
    bar.ax.yaxis.set_minor_locator(NullLocator())
