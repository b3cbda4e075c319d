#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Prints the energy of the Voronoi cells after each sweep, for each method, and that of the hexagonal lattice.

The energy is that of centroidal Voronoi tessellations (Du, Faber, Gunzburger, SIAM Review 41, 1999): the sum over all
cells of the integral of |x - site|^2. It is divided by (area of all cells)^2 / (number of cells). Then the regular
hexagonal lattice has 5 / (18 sqrt 3), which no other arrangement of many points goes below (Gersho's conjecture, proved
in the plane by Fejes Toth). Only cells of points inside count, which no boundary cuts.

    scripts/cvt_energy.py [CONFIG] [--points N] [--program trime_mpi]
"""
import argparse
import math
import pathlib
import subprocess
import sys
import tempfile

import h5py
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[1]
HEXAGONS = 5 / (18 * math.sqrt(3))
METHODS = ("distmesh", "cvt", "hybrid")


def moments_of(points, triangles):
    """Area and second moment about the site of the cell of each point, from the kites of the triangles."""
    areas, moments = np.zeros(len(points)), np.zeros(len(points))
    p = points[triangles]
    for k in range(3):
        site = p[:, k]
        b, c = p[:, (k + 1) % 3] - site, p[:, (k + 2) % 3] - site
        twice = 2 * (b[:, 0] * c[:, 1] - b[:, 1] * c[:, 0])
        bb, cc = (b**2).sum(axis=1), (c**2).sum(axis=1)
        centre = np.stack([bb * c[:, 1] - cc * b[:, 1], cc * b[:, 0] - bb * c[:, 0]], axis=1) / twice[:, None]
        for q, r in ((0.5 * b, centre), (centre, 0.5 * c)):
            area = 0.5 * (q[:, 0] * r[:, 1] - q[:, 1] * r[:, 0])
            np.add.at(areas, triangles[:, k], area)
            np.add.at(moments, triangles[:, k], area / 6 * (q**2 + r**2 + q * r).sum(axis=1))
    return areas, moments


def energy_of(path):
    """Number of the triangulation, and the energy of the cells of the points inside."""
    with h5py.File(path) as file:
        points, triangles = file["Mesh/mesh/geometry"][:], file["Mesh/mesh/topology"][:]
        held, number = np.unique(file["Mesh/facets/topology"][:]), int(file["trime_mpi"].attrs["retriangulation"])
    areas, moments = moments_of(points, triangles)
    inside = np.ones(len(points), bool)
    inside[held] = False
    return number, len(points), inside.sum() * moments[inside].sum() / areas[inside].sum()**2


def energies(options, method, directory):
    """The energy after each sweep, and that of the final mesh."""
    command = [options.program, options.config, f"meshing.method={method}", f"meshing.points={options.points}",
               f"output.directory={directory}", f"output.name={method}", "output.interval=1"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode not in (0, 5):
        sys.exit(done.stdout + done.stderr)
    steps = [energy_of(path) for path in sorted(directory.glob(f"{method}_step_*.h5"))]
    return steps, energy_of(directory / f"{method}.h5")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("config", nargs="?", default=str(ROOT / "configs" / "circle.ini"))
    parser.add_argument("--points", type=int, default=10000)
    parser.add_argument("--program", default=str(ROOT / "build" / "release" / "trime_mpi"))
    options = parser.parse_args()
    print(f"{'method':<9} {'sweep':>6} {'points':>8} {'energy':>9} {'above hexagons':>15}")
    for method in METHODS:
        with tempfile.TemporaryDirectory(prefix="trime-cvt-") as directory:
            steps, final = energies(options, method, pathlib.Path(directory))
        shown = [step for k, step in enumerate(steps) if k < 5 or k % 10 == 0 or k == len(steps) - 1]
        for label, (number, points, energy) in [*((str(step[0]), step) for step in shown), ("final", final)]:
            print(f"{method:<9} {label:>6} {points:>8} {energy:>9.6f} {100 * (energy / HEXAGONS - 1):>14.3f}%")
    print(f"{'hexagons':<9} {'':>6} {'':>8} {HEXAGONS:>9.6f}")


if __name__ == "__main__":
    main()
