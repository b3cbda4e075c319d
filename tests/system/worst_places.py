#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws the worst triangles of a mesh with the contour that it should follow.

Usage: worst_places.py MESH.h5 CONTOUR.xy -o PICTURE.png [--places N]     (judge.py run ... --keep DIR makes both files)

The mesh is blue, the triangle orange, the contour with its vertices red. For each place the script prints alpha, the
place, and how many corners lie on the boundary.
"""
import argparse
import pathlib

import h5py
import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (after the backend was chosen)

from judge import input_rings  # noqa: E402
from mesh_measures import MeshMeasures  # noqa: E402
from ring_tools import rings_of  # noqa: E402

AROUND = 6  # local sizes from the triangle to the rim of its picture
COLUMNS = 3


def draw(axes, mesh, rings, triangle):
    """One triangle and what is near it."""
    middle = mesh.corners[triangle].mean(axis=0)
    reach = AROUND * mesh.size[mesh.triangles[triangle]].max()
    near = np.abs(mesh.corners.mean(axis=1) - middle).max(axis=1) < 1.5 * reach
    axes.triplot(*mesh.points.T, triangles=mesh.triangles[near], linewidth=0.6, color="tab:blue")
    axes.fill(*mesh.corners[triangle].T, color="tab:orange")
    for ring in rings:
        axes.plot(*np.vstack([ring, ring[:1]]).T, color="tab:red", linewidth=0.6, marker=".", markersize=2)
    axes.set(xlim=(middle[0] - reach, middle[0] + reach), ylim=(middle[1] - reach, middle[1] + reach), aspect="equal",
             title=f"alpha {mesh.alpha[triangle]:.3g}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesh", type=pathlib.Path)
    parser.add_argument("contour", type=pathlib.Path)
    parser.add_argument("-o", "--output", type=pathlib.Path, required=True)
    parser.add_argument("--places", type=int, default=6)
    options = parser.parse_args()
    with h5py.File(options.mesh, "r") as file:
        rings = input_rings(file, rings_of(options.contour.read_text(encoding="utf-8")))
        mesh = MeshMeasures(file["Mesh/mesh/geometry"][:], file["Mesh/mesh/topology"][:],
                            file["VTKHDF/PointData/size"][:], rings)
    worst = np.argsort(-mesh.alpha, kind="stable")[:options.places]
    rows = -(-len(worst) // COLUMNS)
    figure, axes = plt.subplots(rows, COLUMNS, figsize=(6 * COLUMNS, 6 * rows), squeeze=False)
    on_boundary = np.isin(mesh.triangles, mesh.facets)
    for place, triangle in zip(axes.flat, worst):
        draw(place, mesh, rings, triangle)
        x, y = mesh.corners[triangle].mean(axis=0)
        print(f"alpha {mesh.alpha[triangle]:.3f} at ({x:.6g}, {y:.6g}), {on_boundary[triangle].sum()} corners on the "
              "boundary")
    figure.tight_layout()
    figure.savefig(options.output, dpi=60)


if __name__ == "__main__":
    main()
