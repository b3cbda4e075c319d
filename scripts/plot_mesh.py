#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws a mesh file of trime_mpi: all triangles coloured by alpha, the neighbourhood of the worst one, a histogram.

With --size the picture shows the mesh beside its size field: h, the edge length that the mesh was asked for.
alpha = circumradius / (2 inradius) is 1 for an equilateral triangle. Meshes of more than 200000 triangles are drawn as
an image (mean alpha per pixel), since single triangles would be smaller than the ink.
"""
import argparse
import pathlib
import sys

try:
    import h5py
    import matplotlib
    import numpy as np
except ImportError as error:
    sys.exit(f"plot_mesh.py needs the Python module '{error.name}'. Debian: apt-get install python3-h5py "
             "python3-matplotlib python3-numpy (they belong to /usr/bin/python3)")
matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (after the choice of the backend)
from matplotlib.collections import LineCollection, PolyCollection  # noqa: E402

RASTER_ABOVE = 200_000  # triangles
ZOOM_TRIANGLES = 500    # about that many in the window around the worst triangle
COLOURS = matplotlib.colors.LinearSegmentedColormap.from_list(
    "alpha", ["#f7f5ee", "#f6e3a1", "#f2ae5f", "#d9603f", "#8c1d40"])
ALPHA_RANGE = (1.0, 1.3)
SIZE_COLOURS = matplotlib.colors.LinearSegmentedColormap.from_list(
    "size", ["#0b3954", "#1d6f8a", "#4fa69a", "#a7cf9b", "#f3efc3"])
INK = "#26323d"
WINDOW = "#0b6e99"


class Mesh:
    """Arrays of a mesh file: xy [N,2], corners [M,3,2] of the triangles, alpha [M], facets [B,2,2] (ends), hash (text).

    size [M,3] is h at the corners of the triangles, None in a file without it.

    In a periodic container the corners of a triangle are images that lie together, around its first corner.
    """

    def __init__(self, path):
        with h5py.File(path, "r") as file:
            if "Mesh/mesh" in file:
                self.xy = file["Mesh/mesh/geometry"][:]
                triangles = file["Mesh/mesh/topology"][:]
            else:  # written for ParaView only
                self.xy = file["VTKHDF/Points"][:, :2]
                triangles = file["VTKHDF/Connectivity"][:].reshape(-1, 3)
            facets = file["Mesh/facets/topology"][:]
            fields = file["VTKHDF" if "VTKHDF/PointData" in file else "Mesh"]
            self.size = fields["PointData/size"][:][triangles] if "PointData/size" in fields else None
            attributes = file["trime_mpi"].attrs
            stored = attributes.get("mesh_hash", "unknown")
            periods = [float(attributes.get(name, 0)) for name in ("period_x", "period_y")]
        self.hash = hash_text(stored)
        self.corners = brought_together(self.xy[triangles], periods)
        self.facets = brought_together(self.xy[facets], periods)
        self.alpha, self.min_angle = shape_numbers(self.corners)

    def middles(self):
        """Centroids, [M,2]."""
        return self.corners.mean(axis=1)


def brought_together(places, periods):
    """The images of places [..., k, 2] that are nearest to the first of each k."""
    for axis, period in enumerate(periods):
        if period > 0:
            first = places[:, :1, axis]
            places[:, :, axis] -= period * np.round((places[:, :, axis] - first) / period)
    return places


def hash_text(stored):
    """The mesh hash as 16 hexadecimal digits, whether stored as a number or as text."""
    if isinstance(stored, bytes):
        return stored.decode()
    return stored if isinstance(stored, str) else f"{int(stored) & 0xffffffffffffffff:016x}"


def shape_numbers(corners):
    """alpha per triangle [M] of corners [M,3,2], and the smallest angle of all in degrees."""
    if len(corners) == 0:
        return np.zeros(0), 0.0
    corner = [corners[:, k] for k in range(3)]
    a, b, c = (np.hypot(*(corner[(k + 1) % 3] - corner[(k + 2) % 3]).T) for k in range(3))
    with np.errstate(divide="ignore", invalid="ignore"):
        half = (a + b + c) / 2
        alpha = a * b * c / (8 * (half - a) * (half - b) * (half - c))
    edges = np.sort(np.stack([a, b, c]), axis=0)  # the smallest angle lies opposite the shortest edge
    cosine = (edges[1] ** 2 + edges[2] ** 2 - edges[0] ** 2) / (2 * edges[1] * edges[2])
    return alpha, float(np.degrees(np.arccos(np.clip(cosine, -1, 1).max())))


def draw_triangles(axes, mesh, chosen, line_width):
    """Triangles `chosen` (an index) as polygons coloured by alpha, the boundary on top."""
    axes.add_collection(PolyCollection(
        mesh.corners[chosen], array=mesh.alpha[chosen], cmap=COLOURS, clim=ALPHA_RANGE,
        edgecolors=INK, linewidths=line_width, rasterized=True))
    axes.add_collection(LineCollection(mesh.facets, colors=INK, linewidths=max(3 * line_width, 0.6)))


def draw_raster(axes, mesh, pixels=1000):
    """Mean alpha of the triangles whose centroid lies in each pixel."""
    low, high = mesh.xy.min(axis=0), mesh.xy.max(axis=0)
    middles = mesh.middles()
    per_side = int(min(pixels, max(50, np.sqrt(len(middles) / 4))))
    box = [[low[0], high[0]], [low[1], high[1]]]
    count, _, _ = np.histogram2d(*middles.T, bins=per_side, range=box)
    total, _, _ = np.histogram2d(*middles.T, bins=per_side, range=box, weights=np.minimum(mesh.alpha, 100))
    with np.errstate(invalid="ignore"):
        mean = total / count
    axes.imshow(mean.T, origin="lower", extent=[low[0], high[0], low[1], high[1]], cmap=COLOURS,
                vmin=ALPHA_RANGE[0], vmax=ALPHA_RANGE[1], interpolation="nearest")
    axes.add_collection(LineCollection(mesh.facets, colors=INK, linewidths=0.6))


def frame(axes, low, high):
    """Equal scales, the given window with a margin, no ticks beyond a few."""
    margin = 0.02 * (high - low).max()
    axes.set_aspect("equal")
    axes.set_xlim(low[0] - margin, high[0] + margin)
    axes.set_ylim(low[1] - margin, high[1] + margin)
    axes.tick_params(labelsize=7, colors=INK, length=2)
    for spine in axes.spines.values():
        spine.set_color("#b8bfc6")


def draw_zoom(axes, mesh):
    """The window around the worst triangle."""
    middles = mesh.middles()
    worst = int(np.argmax(np.nan_to_num(mesh.alpha, nan=np.inf)))
    distance = np.abs(middles - middles[worst]).max(axis=1)
    last = min(ZOOM_TRIANGLES, len(distance) - 1)
    reach = np.partition(distance, last)[last]
    low, high = mesh.xy.min(axis=0), mesh.xy.max(axis=0)
    reach = min(reach, (high - low).min() / 2)
    centre = np.clip(middles[worst], low + reach, high - reach)  # a window beyond the mesh shows nothing
    chosen = np.flatnonzero(np.abs(middles - centre).max(axis=1) <= 1.2 * reach)
    draw_triangles(axes, mesh, chosen, 0.35)
    frame(axes, centre - reach, centre + reach)
    axes.set_title(f"around the worst triangle ({middles[worst][0]:.4g}, {middles[worst][1]:.4g})", fontsize=9,
                   color=INK)
    return centre, reach


def draw_histogram(axes, alpha):
    """Counts of alpha, logarithmic."""
    top = max(1.2, min(float(np.nanmax(alpha)), 3.0))
    bins = np.linspace(1, top, 81)
    counts, _, bars = axes.hist(np.clip(alpha, 1, top), bins=bins, log=True)
    for left, bar in zip(bins, bars):
        bar.set_facecolor(COLOURS(0.12 + 0.88 * min(1.0, (left - ALPHA_RANGE[0]) / (ALPHA_RANGE[1] - ALPHA_RANGE[0]))))
        bar.set_edgecolor("#8a939b")
        bar.set_linewidth(0.3)
    axes.axvline(min(np.median(alpha), top), color=INK, linewidth=0.8, linestyle="--")
    middle = float(np.median(alpha))
    right = middle > (1 + top) / 2  # no room for the text on that side of its line
    axes.text(min(middle, top), counts.max() * 1.3, f"  median {middle:.4f}  ", fontsize=8, color=INK,
              horizontalalignment="right" if right else "left")
    axes.set_ylim(0.7, counts.max() * 4)
    axes.set_xlabel("alpha = R / 2r" + ("   (last bar: all beyond)" if np.nanmax(alpha) > top else ""), fontsize=8)
    axes.set_ylabel("triangles", fontsize=8)
    axes.tick_params(labelsize=7, colors=INK, length=2)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)


def draw_mesh(axes, mesh):
    """All triangles, coloured by alpha."""
    if len(mesh.corners) > RASTER_ABOVE:
        draw_raster(axes, mesh)
    else:
        draw_triangles(axes, mesh, slice(None), float(np.clip(22 / np.sqrt(len(mesh.corners)), 0.03, 0.5)))
    frame(axes, mesh.xy.min(axis=0), mesh.xy.max(axis=0))


def draw_size(axes, mesh):
    """h as colours, linear over each triangle, on a logarithmic scale; the boundary on top. Returns the colours."""
    places = mesh.corners.reshape(-1, 2)
    low, high = float(mesh.size.min()), float(mesh.size.max())
    high = max(high, 1.001 * low)  # a uniform size has no range
    colours = axes.tripcolor(places[:, 0], places[:, 1], np.arange(len(places)).reshape(-1, 3), mesh.size.ravel(),
                             shading="gouraud", cmap=SIZE_COLOURS, norm=matplotlib.colors.LogNorm(low, high))
    colours.set_rasterized(True)
    axes.add_collection(LineCollection(mesh.facets, colors=INK, linewidths=0.8))
    frame(axes, mesh.xy.min(axis=0), mesh.xy.max(axis=0))
    return colours


def add_scale(figure, colours, axes, label):
    """A bar of colours to the right of axes."""
    bar = figure.colorbar(colours, ax=axes, fraction=0.03, pad=0.015, aspect=40,
                          extend="max" if label == "alpha" else "neither")
    bar.ax.tick_params(labelsize=7, which="both")
    bar.set_label(label, fontsize=8)
    return bar


def label_sizes(bar, low, high):
    """Five ticks with three digits, since decades are too far apart for most meshes."""
    bar.ax.yaxis.set_major_locator(matplotlib.ticker.FixedLocator(np.geomspace(low, high, 5)))
    bar.ax.yaxis.set_major_formatter(matplotlib.ticker.FuncFormatter(lambda value, _: f"{value:.3g}"))
    bar.ax.yaxis.set_minor_locator(matplotlib.ticker.NullLocator())


def add_header(figure, mesh, name, top):
    """Name and numbers of the mesh; `top`: heights of the two lines."""
    figure.text(0.04, top[0], name, fontsize=16, fontweight="bold", color=INK)
    figure.text(0.04, top[1], f"{len(mesh.xy):,} points   {len(mesh.corners):,} triangles   "
                f"alpha mean {mesh.alpha.mean():.4f}, max {mesh.alpha.max():.3f}   "
                f"smallest angle {mesh.min_angle:.1f}°   mesh_hash {mesh.hash}", fontsize=10, color=INK)


def draw_with_size(mesh, name):
    """The mesh and its size field, side by side or, where the shape is wide, one above the other."""
    width, height = mesh.xy.max(axis=0) - mesh.xy.min(axis=0)
    beside = width < 1.8 * height
    rows, columns = (1, 2) if beside else (2, 1)
    tall = 13 / columns * float(np.clip(height / width, 0.2, 1.4)) * rows + 1.1
    figure = plt.figure(figsize=(14, tall), facecolor="white")
    panels = figure.subplots(rows, columns, gridspec_kw={
        "left": 0.035, "right": 0.95, "top": 1 - 1.15 / tall, "bottom": 0.35 / tall, "wspace": 0.13, "hspace": 0.12})
    draw_mesh(panels[0], mesh)
    add_scale(figure, plt.cm.ScalarMappable(plt.Normalize(*ALPHA_RANGE), COLOURS), panels[0], "alpha")
    panels[0].set_title("the mesh: alpha of its triangles", fontsize=10, color=INK)
    colours = draw_size(panels[1], mesh)
    label_sizes(add_scale(figure, colours, panels[1], "h"), *colours.get_clim())
    panels[1].set_title("its size field: the edge length h that was asked for", fontsize=10, color=INK)
    add_header(figure, mesh, name, (1 - 0.42 / tall, 1 - 0.72 / tall))
    return figure


def draw(mesh, name):
    """The whole figure."""
    figure = plt.figure(figsize=(14, 8.6), facecolor="white")
    grid = figure.add_gridspec(2, 2, width_ratios=[1.75, 1], height_ratios=[1, 1.45], left=0.04, right=0.985,
                               top=0.89, bottom=0.06, wspace=0.15, hspace=0.28)
    main = figure.add_subplot(grid[:, 0])
    draw_mesh(main, mesh)
    draw_histogram(figure.add_subplot(grid[0, 1]), mesh.alpha)
    if len(mesh.corners) > 4 * ZOOM_TRIANGLES:
        middle, reach = draw_zoom(figure.add_subplot(grid[1, 1]), mesh)
        main.add_patch(plt.Rectangle(middle - reach, 2 * reach, 2 * reach, fill=False, color=WINDOW, linewidth=1.4,
                                     zorder=5))
    add_scale(figure, plt.cm.ScalarMappable(plt.Normalize(*ALPHA_RANGE), COLOURS), main, "alpha")
    add_header(figure, mesh, name, (0.955, 0.92))
    return figure


def palette():
    """The 256 colours of a small picture: both scales, the first also under ink, and ink on white."""
    ink, white = (np.array(matplotlib.colors.to_rgb(colour)) for colour in (INK, "white"))
    coarse, fine = (COLOURS(np.linspace(0, 1, count))[:, :3] for count in (24, 48))
    under_ink = [share * ink + (1 - share) * coarse for share in (0.25, 0.5, 0.75)]
    greys = [share * ink + (1 - share) * white for share in (0, *np.linspace(0.1, 1, 39))]
    return np.concatenate([fine, *under_ink, SIZE_COLOURS(np.linspace(0, 1, 94))[:, :3], greys,
                           [matplotlib.colors.to_rgb(WINDOW), (0, 0, 0)]])


def write_with_palette(picture):
    """Writes a PNG once more in few colours, which makes the file a third as large."""
    from PIL import Image  # comes with matplotlib
    colours = Image.new("P", (1, 1))
    colours.putpalette((255 * palette()).round().astype(np.uint8).tobytes())
    few = Image.open(picture).convert("RGB").quantize(palette=colours, dither=Image.Dither.NONE)
    few.save(picture, optimize=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesh", type=pathlib.Path, help="mesh file, NAME.h5")
    parser.add_argument("-o", "--output", type=pathlib.Path, help="picture (default: NAME.png beside the mesh)")
    parser.add_argument("--dpi", type=int, default=130, help="dots per inch (default %(default)s)")
    parser.add_argument("--size", action="store_true", help="the mesh beside its size field")
    parser.add_argument("--small", action="store_true", help="write the PNG with a palette: a smaller file")
    options = parser.parse_args()
    if not options.mesh.exists():
        sys.exit(f"plot_mesh.py: there is no {options.mesh}")
    picture = options.output or options.mesh.with_suffix(".png")
    try:
        mesh = Mesh(options.mesh)
    except (OSError, KeyError) as error:
        sys.exit(f"plot_mesh.py: {options.mesh} is not a mesh file of trime_mpi: {error}")
    if len(mesh.corners) == 0:
        sys.exit(f"plot_mesh.py: {options.mesh} holds no triangles")
    if options.size and mesh.size is None:
        sys.exit(f"plot_mesh.py: {options.mesh} holds no sizes")
    figure = draw_with_size(mesh, options.mesh.stem) if options.size else draw(mesh, options.mesh.stem)
    figure.savefig(picture, dpi=options.dpi)
    if options.small:
        write_with_palette(picture)
    print(f"{picture}: {len(mesh.xy)} points, {len(mesh.corners)} triangles")


if __name__ == "__main__":
    main()
