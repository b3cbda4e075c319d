#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Two real contours (not part of the project): a poker spade minus a disc, and North America with its 8 lakes.

Looked for in $TRIME_SHARED_DATA, else beside the source tree in shared/data; skipped where they are missing."""
import os
import pathlib
import subprocess
import sys
import unittest

import h5py
import numpy

from trime_run import ROOT, Workspace, run

DATA = pathlib.Path(os.environ.get("TRIME_SHARED_DATA", ROOT.parent / "shared" / "data"))

POKER = """[shape]
region = difference(spade, hole)
[shape.spade]
type = contour
file = {data}/poker.xy
normalize = true
[shape.hole]
type = circle
center = 0.5 0.7
radius = 0.1
[meshing]
method = distmesh
points = 10000
"""

NORTH_AMERICA = """[shape]
region = coast
[shape.coast]
type = contour
file = {data}/north_america.xy
normalize = true
[meshing]
method = distmesh
points = 100000
"""


def smallest_angles(places):
    """Of triangles (n, 3, 2), in degrees."""
    sides = numpy.linalg.norm(numpy.roll(places, 1, axis=1) - numpy.roll(places, 2, axis=1), axis=2)
    a, b, c = numpy.sort(sides, axis=1).T
    return numpy.degrees(numpy.arccos((b * b + c * c - a * a) / (2 * b * c)))


def checks_of(path):
    """Name -> (passed, found) of the certificate in a mesh file."""
    with h5py.File(path, "r") as file:
        group = file["trime_mpi/checks"]
        names = [name.decode() for name in group["name"][:]]
        return dict(zip(names, zip(group["passed"][:], group["found"][:])))


@unittest.skipUnless((DATA / "north_america.xy").exists(), f"no contours in {DATA}")
class Contours(unittest.TestCase):
    def mesh(self, work, text, **how):
        """Meshes a config; returns checks and points per hash."""
        (work / "c.ini").write_text(text.format(data=DATA), encoding="utf-8")
        done = run(work / "c.ini", f"output.directory={work}", "output.overwrite=true", timeout=280, **how)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        with h5py.File(work / "c.h5", "r") as file:
            size = file["Mesh/mesh/geometry"].shape[0]
            return checks_of(work / "c.h5"), size, str(file["trime_mpi"].attrs["mesh_hash"])

    def test_their_boundaries_are_exact(self):
        """See boundary_test.py."""
        for text, points in ((POKER, 6000), (NORTH_AMERICA, 8000)):
            with self.subTest(points=points), Workspace() as work:
                (work / "c.ini").write_text(text.format(data=DATA), encoding="utf-8")
                test = pathlib.Path(__file__).with_name("boundary_test.py")
                done = subprocess.run([sys.executable, test, work / "c.ini", str(points)], capture_output=True,
                                      text=True, timeout=280, check=False)
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_poker_minus_disc(self):
        with Workspace() as work:
            checks, size, mesh_hash = self.mesh(work, POKER)
            self.assertTrue(all(passed for passed, _ in checks.values()), checks)
            self.assertEqual(checks["euler_characteristic"][1], 0)
            self.assertTrue(9900 <= size <= 10000, size)
            for ranks, threads in ((3, 1), (4, 2)):
                self.assertEqual(self.mesh(work, POKER, ranks=ranks, threads=threads)[2], mesh_hash)

    def test_north_america_has_no_bad_triangle(self):
        """All three methods with 20000 points: input corners under 56 degrees apart, which the file lists."""
        for method in ("distmesh", "cvd", "hybrid"):
            with self.subTest(method=method), Workspace() as work:
                self.mesh(work, NORTH_AMERICA.replace("[meshing]", "[sizing]\ntype = automatic\ngradation = 0.2\n[meshing]")
                          .replace("100000", "20000").replace("distmesh", method))
                with h5py.File(work / "c.h5", "r") as file:
                    alpha = file["VTKHDF/CellData/alpha"][:]
                    places = file["Mesh/mesh/geometry"][:][file["Mesh/mesh/topology"][:]]
                    sharp = {name: file[f"trime_mpi/sharp_corners/{name}"][:] for name in ("x", "y", "degrees")}
                self.assertLess(alpha.mean(), 1.03 if method == "hybrid" else 1.035)
                self.assertLess(alpha.max(), 1.4)
                self.assertTrue(0 < len(sharp["x"]) < 60 and (sharp["degrees"] < 56).all())
                corners = set(zip(sharp["x"], sharp["y"]))
                for triangle, angle in zip(places, smallest_angles(places)):
                    self.assertTrue(angle > 28 or any((x, y) in corners for x, y in triangle), (triangle, angle))

    def test_north_america_has_no_bad_triangle_at_other_sizes(self):
        """A ragged shore, laid out anew by each number of points: at these, single places were left at 1.5 to 2.0."""
        for points in (16000, 18500, 21000, 24000):
            with self.subTest(points=points), Workspace() as work:
                self.mesh(work, NORTH_AMERICA.replace("[meshing]", "[sizing]\ntype = automatic\ngradation = 0.2\n[meshing]")
                          .replace("100000", str(points)).replace("distmesh", "hybrid"))
                with h5py.File(work / "c.h5", "r") as file:
                    self.assertLess(file["VTKHDF/CellData/alpha"][:].max(), 1.4)

    def test_stars_of_north_america_are_right_in_every_sweep(self):
        """Long chords between small sizes: of two stars at an edge one had left out a triangle as too large."""
        os.environ["TRIME_VERIFY_STARS"] = "1"
        self.addCleanup(os.environ.pop, "TRIME_VERIFY_STARS")
        text = NORTH_AMERICA.replace("[meshing]", "[sizing]\ntype = automatic\ngradation = 0.2\n[meshing]")
        text = text.replace("100000", "16000").replace("distmesh", "hybrid")
        hashes = set()
        for ranks in (1, 3):
            with Workspace() as work:
                hashes.add(self.mesh(work, text, ranks=ranks)[2])
        self.assertEqual(len(hashes), 1)

    def test_north_america_keeps_its_lakes(self):
        with Workspace() as work:
            checks, size, mesh_hash = self.mesh(work, NORTH_AMERICA, ranks=2)
            self.assertTrue(all(passed for passed, _ in checks.values()), checks)
            self.assertEqual(checks["euler_characteristic"][1], 1 - 8)
            self.assertTrue(99000 <= size <= 100000, size)
            self.assertEqual(self.mesh(work, NORTH_AMERICA, threads=2)[2], mesh_hash)


if __name__ == "__main__":
    unittest.main()
