#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws a mesh file of trime_mpi with the Python package trime_mpi.

The pictures are:

  quality   (default) the triangles, coloured by alpha, the neighbourhood of the worst one, and a histogram; alpha =
            circumradius / (2 inradius) is 1 for an equilateral triangle
  size      the mesh next to its size field h, the desired edge length
  parts     the boundary, coloured by part of the shape
  ranks     the rank that owned each triangle
  history   how alpha changed during the sweeps of the run
"""
import argparse
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve()
# The package lies next to this script in the source tree, and in PREFIX/lib/python3/dist-packages once installed.
for folder in (HERE.parent / "python", HERE.parents[3] / "lib" / "python3" / "dist-packages"):
    if (folder / "trime_mpi").is_dir():
        sys.path.insert(0, str(folder))
        break
try:
    import numpy as np
    from trime_mpi import TrimeError, read
    from trime_mpi import drawing
    from trime_mpi.plots import FIGURES, plot
except ImportError as error:
    sys.exit(f"plot_mesh.py needs the Python module '{error.name}'. Debian: apt-get install python3-h5py "
             "python3-matplotlib python3-numpy (they belong to /usr/bin/python3)")


def palette():
    """The 256 colours of a small picture: both scales, the first also under ink, and ink on white."""
    ink, white = np.array(drawing.to_rgb(drawing.INK)), np.ones(3)
    coarse, fine = (drawing.ALPHA_COLOURS(np.linspace(0, 1, count))[:, :3] for count in (24, 48))
    under_ink = [share * ink + (1 - share) * coarse for share in (0.25, 0.5, 0.75)]
    greys = [share * ink + (1 - share) * white for share in (0, *np.linspace(0.1, 1, 39))]
    return np.concatenate([fine, *under_ink, drawing.SIZE_COLOURS(np.linspace(0, 1, 94))[:, :3], greys,
                           [drawing.to_rgb(drawing.WINDOW), (0, 0, 0)]])


def write_with_palette(picture):
    """Writes a PNG again with few colours, which makes the file a third as large."""
    from PIL import Image  # comes with matplotlib
    colours = Image.new("P", (1, 1))
    colours.putpalette((255 * palette()).round().astype(np.uint8).tobytes())
    few = Image.open(picture).convert("RGB").quantize(palette=colours, dither=Image.Dither.NONE)
    few.save(picture, optimize=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesh", type=pathlib.Path, help="the mesh file, NAME.h5")
    parser.add_argument("-o", "--output", type=pathlib.Path,
                        help="the picture, .png or .svg (default: NAME.png next to the mesh file)")
    parser.add_argument("--what", choices=list(FIGURES), help="what to draw (default: quality)")
    parser.add_argument("--size", action="store_true", help="the same as --what size")
    parser.add_argument("--dpi", type=int, default=130, help="dots per inch (default: %(default)s)")
    parser.add_argument("--small", action="store_true",
                        help="store the PNG of quality or size with a palette, in a smaller file")
    options = parser.parse_args()
    picture = options.output or options.mesh.with_suffix(".png")
    what = options.what or ("size" if options.size else "quality")
    try:
        mesh = read(options.mesh, in_place=True)
        plot(mesh, what, picture, options.dpi)
    except (TrimeError, ValueError, OSError) as error:
        sys.exit(f"plot_mesh.py: {error}")
    if options.small and picture.suffix == ".png" and what in ("quality", "size"):
        write_with_palette(picture)
    print(f"{picture}: {len(mesh.points)} points, {len(mesh.triangles)} triangles")


if __name__ == "__main__":
    main()
