#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests fixed points from a file: they become vertices of the mesh, with and without the normalisation of a contour.
Messages on errors name file and line.
"""
import unittest

import h5py
import numpy

from trime_run import Workspace, run

CONTOUR = "0 0\n4 0\n4 4\n0 4\n"  # normalised to [0.1, 0.9]^2: x -> 0.1 + 0.2 x
CONFIG = """[shape]
geometry = plate
[shape.plate]
type = contour
file = plate.xy
normalize = true
[meshing]
method = distmesh
points = 1000
fixed_points = points.xy
fixed_points_normalize_with = plate
[output]
directory = {directory}
overwrite = true
"""


class FixedPoints(unittest.TestCase):
    def mesh(self, directory, points, *overrides):
        (directory / "plate.xy").write_text(CONTOUR)
        (directory / "points.xy").write_text(points)
        (directory / "job.ini").write_text(CONFIG.format(directory=directory))
        return run(directory / "job.ini", *overrides, "--verbose", ranks=2)

    def expect_vertices(self, directory, expected):
        with h5py.File(directory / "job.h5", "r") as file:
            vertices = file["Mesh/mesh/geometry"][:]
            fixed = file["VTKHDF/PointData/fixed"][:]
        for point in expected:
            distance = numpy.abs(vertices - point).max(axis=1)
            self.assertLess(distance.min(), 2e-13, point)
            self.assertEqual(fixed[distance.argmin()], 1)

    def test_normalised(self):
        with Workspace() as directory:
            done = self.mesh(directory, "# two inside, one on the boundary\n1 1\n1.5 2.25 # here\n\n4 3\n")
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            self.assertRegex(done.stdout, r"ok +fixed_points +expected 3 +found 3")
            self.expect_vertices(directory, [(0.3, 0.3), (0.4, 0.55), (0.9, 0.7)])

    def test_as_they_are(self):
        with Workspace() as directory:
            done = self.mesh(directory, "0.3 0.3\n0.3 0.3\n", "meshing.fixed_points_normalize_with=none")
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            self.assertRegex(done.stdout, r"points.xy:2: the fixed point \(0.3, 0.3\) is the same as .*points.xy:1")
            self.expect_vertices(directory, [(0.3, 0.3)])

    def test_more_than_the_points_asked_for(self):
        with Workspace() as directory:
            points = "".join(f"{1 + 0.08 * (k % 25)} {1 + 0.08 * (k // 25)}\n" for k in range(600))
            done = self.mesh(directory, points, "meshing.points=500")
            self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
            self.assertRegex(done.stderr, r"points = 500 are too few .* the 600 fixed points inside and \d+ on its")

    def test_mistakes(self):
        for points, code, message in (("1 1\n5 1\n", 3, r"points.xy:2: the fixed point .* lies outside"),
                                      ("1 1\n1\n", 3, r"points.xy:2: expected two numbers"),
                                      ("# nothing\n", 3, r"points.xy: expected points")):
            with self.subTest(points=points), Workspace() as directory:
                done = self.mesh(directory, points)
                self.assertEqual(done.returncode, code, done.stdout + done.stderr)
                self.assertRegex(done.stderr, message)
                self.assertFalse((directory / "job.h5").exists())
                self.assertEqual(run(directory / "job.ini", "--validate", ranks=2).returncode, code)
        with Workspace() as directory:
            done = self.mesh(directory, "1 1\n", "meshing.fixed_points=missing.xy")
            self.assertEqual(done.returncode, 4, done.stderr)


if __name__ == "__main__":
    unittest.main()
