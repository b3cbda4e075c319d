#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests contours that are hard to mesh: a spade with sharp tips minus a disc, and a rough coast with islands and lakes.

The bounds come from other coasts (seeds 1 to 6 of rough_coast.py) than the coast of the test.
"""
import pathlib
import subprocess
import sys
import unittest
import unittest.mock

import h5py
import numpy

from rough_coast import rough_coast, signed_area, text_of
from trime_run import ROOT, Workspace, run

SEED = 24  # its coast has the most vertices of the seeds up to 24
COAST_RINGS = rough_coast(SEED)
LAKES = sum(signed_area(ring) < 0 for ring in COAST_RINGS)
EULER = len(COAST_RINGS) - 2 * LAKES

SPADE = f"""[shape]
geometry = difference(spade, hole)
[shape.spade]
type = contour
file = {ROOT}/configs/spade.xy
normalize = true
[shape.hole]
type = circle
center = 0.5 0.6
radius = 0.1
[meshing]
method = distmesh
"""

COAST = """[shape]
geometry = coast
[shape.coast]
type = contour
file = coast.xy
normalize = true
[meshing]
"""
AUTOMATIC = ("sizing.type=automatic", "sizing.gradation=0.2")


def smallest_angles(places):
    """Returns the smallest angles of triangles (n, 3, 2), in degrees."""
    sides = numpy.linalg.norm(numpy.roll(places, 1, axis=1) - numpy.roll(places, 2, axis=1), axis=2)
    a, b, c = numpy.sort(sides, axis=1).T
    return numpy.degrees(numpy.arccos((b * b + c * c - a * a) / (2 * b * c)))


class Mesh:
    """What the tests ask of a mesh file."""

    def __init__(self, path):
        with h5py.File(path, "r") as file:
            self.hash = str(file["trime_mpi"].attrs["mesh_hash"])
            self.size = file["Mesh/mesh/geometry"].shape[0]
            self.alpha = file["VTKHDF/CellData/alpha"][:]
            self.places = file["Mesh/mesh/geometry"][:][file["Mesh/mesh/topology"][:]]
            self.sharp = {name: file[f"trime_mpi/sharp_corners/{name}"][:] for name in ("x", "y", "degrees")}
            checks = file["trime_mpi/checks"]
            self.passed = dict(zip(checks["name"][:], checks["passed"][:]))
            self.found = dict(zip(checks["name"][:], checks["found"][:]))

    def away_from_sharp_corners(self):
        """True for each triangle without an input corner that is too sharp for a good one (the file lists them)."""
        corners = set(zip(self.sharp["x"], self.sharp["y"]))
        return numpy.array([not any((x, y) in corners for x, y in triangle) for triangle in self.places])


class Contours(unittest.TestCase):
    def config(self, work, text):
        """Path of a config that may name coast.xy."""
        (work / "coast.xy").write_text(text_of(COAST_RINGS), encoding="ascii")
        (work / "c.ini").write_text(text, encoding="utf-8")
        return work / "c.ini"

    def mesh(self, text, *overrides, **how):
        """The certified mesh of a config."""
        with Workspace() as work:
            done = run(self.config(work, text), *overrides, f"output.directory={work}", timeout=280, **how)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            mesh = Mesh(work / "c.h5")
        self.assertTrue(all(mesh.passed.values()), mesh.passed)
        return mesh

    def assert_good(self, mesh):
        """No bad triangle but at sharp corners of the contour."""
        self.assertTrue(0 < len(mesh.sharp["x"]) < 60 and (mesh.sharp["degrees"] < 56).all(), mesh.sharp)
        free = mesh.away_from_sharp_corners()
        self.assertGreater(free.mean(), 0.99)
        # Coast 5 has the worst place of the six: 24.9 degrees, alpha 1.64. All others stay above 27.8 degrees.
        self.assertGreater(smallest_angles(mesh.places[free]).min(), 24)
        self.assertLess(mesh.alpha[free].max(), 1.7)
        self.assertLessEqual((mesh.alpha[free] > 1.4).sum(), 3)

    def test_the_coast_is_hard(self):
        """A guard of the tests below."""
        self.assertGreater(sum(map(len, COAST_RINGS)), 3500)
        self.assertGreater(LAKES, 7)
        self.assertGreater(len(COAST_RINGS) - LAKES, 7)
        self.assertEqual(COAST_RINGS, rough_coast(SEED))

    def test_their_boundaries_are_exact(self):
        """See boundary_test.py."""
        test = pathlib.Path(__file__).with_name("boundary_test.py")
        exact = COAST + "keep_features = true\n"  # else narrow parts are cut or widened
        for text, points in ((SPADE, 6000), (exact, 20000)):
            with self.subTest(points=points), Workspace() as work:
                done = subprocess.run([sys.executable, test, self.config(work, text + f"points = {points}\n"),
                                       str(points)],
                                      capture_output=True, text=True, timeout=280, check=False)
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_spade_minus_disc(self):
        mesh = self.mesh(SPADE, "meshing.points=10000")
        self.assertEqual(mesh.found[b"euler_characteristic"], 0)
        self.assertTrue(9900 <= mesh.size <= 10000, mesh.size)
        for ranks, threads in ((3, 1), (4, 2)):
            self.assertEqual(self.mesh(SPADE, "meshing.points=10000", ranks=ranks, threads=threads).hash, mesh.hash)

    def test_the_coast_has_no_bad_triangle(self):
        for method in ("distmesh", "cvd", "hybrid"):
            with self.subTest(method=method):
                mesh = self.mesh(COAST, "meshing.points=20000", f"meshing.method={method}", *AUTOMATIC)
                self.assertLess(mesh.alpha.mean(), 1.03 if method == "hybrid" else 1.035)
                self.assert_good(mesh)

    def test_the_coast_has_no_bad_triangle_at_other_sizes(self):
        """Each number of points gives a ragged shore other sites. Single places stayed bad at some numbers."""
        for points in (16000, 18500, 21000, 24000):
            with self.subTest(points=points):
                self.assert_good(self.mesh(COAST, f"meshing.points={points}", *AUTOMATIC))

    def test_stars_of_the_coast_are_right_in_every_sweep(self):
        """Long chords between small sizes: of two stars at an edge one had left out a triangle as too large."""
        with unittest.mock.patch.dict("os.environ", TRIME_VERIFY_STARS="1"):
            hashes = {self.mesh(COAST, "meshing.points=16000", *AUTOMATIC, ranks=ranks).hash for ranks in (1, 3)}
        self.assertEqual(len(hashes), 1)

    def test_the_coast_keeps_its_islands_and_lakes(self):
        arguments = (COAST, "meshing.points=100000", "meshing.method=distmesh")
        mesh = self.mesh(*arguments, ranks=2)
        self.assertEqual(mesh.found[b"euler_characteristic"], EULER)
        self.assertTrue(99000 <= mesh.size <= 100000, mesh.size)
        self.assertEqual(self.mesh(*arguments, threads=2).hash, mesh.hash)


if __name__ == "__main__":
    unittest.main()
