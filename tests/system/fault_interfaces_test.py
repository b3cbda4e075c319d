#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests curves that run along interfaces of regions: within 0.2 h both become one line with the name of the curve,
farther apart they stay two; ends of curves and junctions of regions stay bit for bit.
"""
import math
import os
import pathlib
import random
import re
import subprocess
import unittest

import h5py
import numpy as np

from trime_run import PROGRAM, WorkspaceCase, run

CHECK = os.environ.get("TRIME_CHECK", str(pathlib.Path(PROGRAM).parent / "src" / "check" / "trime_check"))
POINTS = 2000
H = math.sqrt(2 / (math.sqrt(3) * POINTS))  # of the unit square: 0.024


def line(first, last, count, noise=0.0, seed=1, height=0.5, slope=0.0):
    """Vertices from left to right, each at a random distance of at most `noise` above or below the line."""
    draw = random.Random(seed)
    steps = [first + (last - first) * (k + (draw.uniform(-0.3, 0.3) if 0 < k < count else 0)) / count
             for k in range(count + 1)]
    return [(round(x, 7), round(height + slope * (x - 0.5) + draw.uniform(-noise, noise), 7)) for x in steps]


def largest_alpha(points, triangles):
    a, b, c = (points[triangles[:, k]] for k in range(3))
    sides = [np.hypot(*(p - q).T) for p, q in ((a, b), (b, c), (c, a))]
    area = 0.5 * np.abs((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0])
    longest = np.max(sides, axis=0)
    return float(np.max(longest * sum(sides) / (4 * math.sqrt(3) * area)))


class FaultInterfaces(WorkspaceCase):
    def run_config(self, fault, low, extra_regions="", ranks=1, keys=()):
        for name, path in (("fault", fault), ("low", low)):
            (self.directory / f"{name}.xy").write_text("".join(f"{x!r} {y!r}\n" for x, y in path))
        config = self.directory / "mesh.ini"
        config.write_text(f"[shape]\ngeometry = domain\nrest = up\n{extra_regions}"
                          f"[shape.below]\ntype = contour\nfile = {self.directory}/low.xy\n"
                          f"[region.low]\ngeometry = below\n[curve.fault]\nfile = {self.directory}/fault.xy\n"
                          f"[meshing]\npoints = {POINTS}\n[output]\ndirectory = {self.directory}\nname = mesh\n"
                          "overwrite = true\nformats = vtkhdf xdmf\n")
        done = run(config, *keys, ranks=ranks)
        self.report = done.stdout + done.stderr
        return done

    def mesh(self, fault, low, **options):
        """Makes a mesh on 1 and 3 ranks, and returns its arrays."""
        hashes = []
        for ranks in (1, 3):
            done = self.run_config(fault, low, ranks=ranks, **options)
            self.assertEqual(done.returncode, 0, self.report)
            with h5py.File(self.directory / "mesh.h5") as file:
                hashes.append(int(file["/trime_mpi"].attrs["mesh_hash"]))
                self.points, self.triangles = file["/Mesh/mesh/geometry"][:], file["/Mesh/mesh/topology"][:]
                self.curve = {tuple(sorted(e)) for e in file["/Mesh/curves/topology"][:].tolist()}
                self.interface = {tuple(sorted(e)) for e in file["/Mesh/interfaces/topology"][:].tolist()}
        self.assertEqual(hashes[0], hashes[1])
        judged = subprocess.run([CHECK, self.directory / "mesh.h5"], capture_output=True, text=True, check=False)
        self.assertEqual(judged.returncode, 0, judged.stdout + judged.stderr)

    def joined(self):
        """The number of joined vertices and the largest distance, as the warning says them."""
        found = re.search(r"each other are one line at (\d+) vert\w+, .*largest distance was ([^,]+),", self.report)
        return (int(found[1]), float(found[2])) if found else (0, 0.0)

    def followed(self):
        """The length of curves that belongs to interfaces, and its largest distance from them, as the warning says."""
        found = re.search(r"follow an interface, .*a length of (\S+) in total; .*largest distance was ([^,]+),",
                          self.report)
        return (float(found[1]), float(found[2])) if found else (0.0, 0.0)

    def length(self, edges):
        edges = np.array(sorted(edges))
        return math.fsum(np.hypot(*(self.points[edges[:, 1]] - self.points[edges[:, 0]]).T))

    def has(self, place):
        """Returns whether a point lies at the place. Places are rounded to the lattice of the container."""
        return bool(np.abs(self.points - np.array(place)).max(axis=1).min() < 1e-9)

    def low(self, top):
        return [(0.0, 0.0), (1.0, 0.0)] + top[::-1]

    def test_along(self):
        """Two digitisations of one line, 0.08 h apart at most: all of the fault lies on the interface."""
        top = line(0, 1, 20, 0.04 * H, seed=2)
        fault = line(0.2, 0.8, 13, 0.04 * H, seed=3)
        self.mesh(fault, self.low(top))
        length, largest = self.followed()
        self.assertAlmostEqual(length, 0.6, delta=0.01)
        self.assertLess(largest, 0.1 * H)
        self.assertLessEqual(self.curve, self.interface)
        self.assertAlmostEqual(self.length(self.curve), 0.6, delta=0.01)
        self.assertTrue(self.has(fault[0]) and self.has(fault[-1]))
        self.assertLess(largest_alpha(self.points, self.triangles), 1.3)

    def test_leaves_and_comes_back(self):
        top = line(0, 1, 20, 0.04 * H, seed=2)
        fault = line(0.1, 0.35, 6, 0.04 * H, seed=3) + [(0.5, 0.6)] + line(0.65, 0.9, 6, 0.04 * H, seed=4)
        self.mesh(fault, self.low(top))
        share = self.length(self.curve & self.interface) / 0.5
        self.assertGreater(share, 0.95)
        self.assertLess(share, 1.1)
        self.assertTrue(self.has((0.5, 0.6)))

    def test_stays_apart(self):
        """A fault parallel at 0.3 h and at 1 h is a separate line."""
        for distance, alpha in ((0.3, 1.6), (1, 1.3)):
            with self.subTest(distance):
                fault = line(0.2, 0.8, 13, seed=3, height=0.5 + distance * H)
                self.mesh(fault, self.low(line(0, 1, 20, seed=2)))
                self.assertEqual(self.joined()[0], 0)
                self.assertFalse(self.curve & self.interface)
                self.assertLess(largest_alpha(self.points, self.triangles), alpha)

    def test_shallow_crossing(self):
        """Lines that cross at 1 to 3 degrees cross once."""
        for degrees in (1, 2, 3):
            with self.subTest(degrees):
                fault = line(0.1, 0.9, 13, seed=3, slope=math.tan(math.radians(degrees)))
                self.mesh(fault, self.low(line(0, 1, 20, seed=2)))
                self.assertTrue(self.has(fault[0]) and self.has(fault[-1]))

    def test_through_a_junction(self):
        """Along two interfaces, through the place where three regions meet."""
        regions = ("[shape.left]\ntype = rectangle\nx_min = 0\nx_max = 0.5\ny_min = 0.49\ny_max = 1\n"
                   "[region.left]\ngeometry = left\n")
        top = line(0, 0.5, 9, seed=2) + line(0.5, 1, 9, seed=3)[1:]
        fault = [(0.5 + 0.05 * H, 0.8), (0.5 - 0.05 * H, 0.65), (0.5 + 0.05 * H, 0.52),
                 (0.53, 0.5 + 0.05 * H), (0.7, 0.5 - 0.04 * H), (0.85, 0.5 + 0.03 * H)]
        self.mesh(fault, self.low(top), extra_regions=regions)
        self.assertGreater(self.followed()[0], 0.45)
        self.assertGreater(self.length(self.curve & self.interface), 0.6)
        self.assertTrue(self.has(fault[0]) and self.has(fault[-1]))

    def test_keep_features(self):
        """keep_features = true joins nothing."""
        fault = line(0.2, 0.8, 3, height=0.5 + 0.15 * H)
        self.mesh(fault, self.low([(0.0, 0.5), (1.0, 0.5)]), keys=["meshing.keep_features=true"])
        self.assertEqual(self.joined()[0], 0)
        self.assertFalse(self.curve & self.interface)


if __name__ == "__main__":
    unittest.main()
