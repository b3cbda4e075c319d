#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests `trime_mpi refine`: counts, places of old and new vertices, names, equal arrays on any ranks, and messages."""
import math
import os
import subprocess
import unittest

import h5py
import numpy as np

from trime_run import ROOT, Workspace, run

CHECK = os.environ.get("TRIME_CHECK", str(ROOT / "build" / "ci" / "src" / "check" / "trime_check"))
GEOMETRY, TOPOLOGY, FACETS = "Mesh/mesh/geometry", "Mesh/mesh/topology", "Mesh/facets/topology"

DISC = """[shape]
geometry = disc
[shape.disc]
type = circle
center = 0.5 0.5
radius = 0.4
[meshing]
points = 1000
"""

# A square with two holes; the sides of the square have the markers 1, 2, 1 and 3, the holes 4 and 5.
ROOM = """12 2 0 1
1 0 0
2 1 0
3 1 1
4 0 1
5 0.2 0.2
6 0.4 0.2
7 0.3 0.4
8 0.6 0.55
9 0.8 0.55
10 0.8 0.85
11 0.6 0.85
12 0.55 0.7
12 1
1 1 2 1
2 2 3 2
3 3 4 1
4 4 1 3
5 5 6 4
6 6 7 4
7 7 5 4
8 8 9 5
9 9 10 5
10 10 11 5
11 11 12 5
12 12 8 5
2
1 0.3 0.25
2 0.7 0.7
"""


def arrays(path):
    """All arrays of the mesh by name, and the attributes of /trime_mpi."""
    found = {}
    with h5py.File(path) as file:
        for group in ("Mesh", "VTKHDF"):
            file[group].visititems(lambda name, item, group=group: found.update({f"{group}/{name}": item[()]})
                                   if isinstance(item, h5py.Dataset) else None)
        return found, dict(file["trime_mpi"].attrs)


def near(points, other, periods):
    """The images of points that are nearest to others."""
    step = points - other
    for axis in (0, 1):
        if periods[axis] > 0:
            step[:, axis] -= periods[axis] * np.round(step[:, axis] / periods[axis])
    return other + step


def area(mesh):
    a, b, c = (mesh[GEOMETRY][mesh[TOPOLOGY][:, k]] for k in range(3))
    u, v = b - a, c - a
    return math.fsum(0.5 * (u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]))


class Refine(unittest.TestCase):
    def setUp(self):
        self.workspace = Workspace()
        self.path = self.workspace.__enter__()
        self.addCleanup(self.workspace.__exit__)

    def mesh(self, config, *overrides):
        """Writes mesh.h5; returns its path."""
        done = run(config, f"output.directory={self.path}", "output.name=mesh", *overrides, threads=2)
        self.assertEqual(done.returncode, 0, done.stderr)
        return self.path / "mesh.h5"

    def config(self, text, name="case.ini"):
        (self.path / name).write_text(text, encoding="utf-8")
        return self.path / name

    def refine(self, source, name="fine.h5", ranks=1):
        """Refines and checks by trime_check; returns path and output."""
        done = run("refine", source, self.path / name, "--overwrite", ranks=ranks)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        checked = subprocess.run([CHECK, str(self.path / name)], capture_output=True, text=True, check=False)
        self.assertEqual(checked.returncode, 0, checked.stdout)
        return self.path / name, done.stdout

    def compare(self, coarse_path, fine_path):
        """Counts, old vertices bit for bit, middles of inner edges, tags and parts. Returns both meshes."""
        (coarse, before), (fine, after) = arrays(coarse_path), arrays(fine_path)
        edges = np.unique(np.sort(coarse[TOPOLOGY][:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1), axis=0)
        points, n = coarse[GEOMETRY], len(coarse[GEOMETRY])
        self.assertEqual(len(fine[GEOMETRY]), n + len(edges))
        self.assertEqual(len(fine[TOPOLOGY]), 4 * len(coarse[TOPOLOGY]))
        self.assertEqual(len(fine[FACETS]), 2 * len(coarse[FACETS]))
        # An old point is followed by the points on its edges to points with higher numbers.
        place = np.arange(n) + np.searchsorted(edges[:, 0], np.arange(n))
        np.testing.assert_array_equal(fine[GEOMETRY][place], points)
        for name in ("boundary", "fixed"):
            np.testing.assert_array_equal(fine[f"VTKHDF/PointData/{name}"][place], coarse[f"VTKHDF/PointData/{name}"])
        middle = edges[:, 0] + 1 + np.arange(len(edges))
        self.assertEqual(fine["VTKHDF/PointData/fixed"][middle].max(), 0)
        inner = middle[fine["VTKHDF/PointData/boundary"][middle] == 0]
        ends = edges[fine["VTKHDF/PointData/boundary"][middle] == 0]
        periods = (before["period_x"], before["period_y"])
        a = points[ends[:, 0]]
        straight = 0.5 * (a + near(points[ends[:, 1]], a, periods))
        off = near(fine[GEOMETRY][inner], straight, periods) - straight
        self.assertLess(abs(off).max(), 2e-13)  # half a step of the lattice
        for name in ("values", "parts", "labels"):
            np.testing.assert_array_equal(np.bincount(fine[f"Mesh/facets/{name}"]),
                                          2 * np.bincount(coarse[f"Mesh/facets/{name}"]))
        self.assertEqual(after["refinements"], before.get("refinements", 0) + 1)
        self.assertEqual(after["refined_from_hash"], before["mesh_hash_hex"])
        return coarse, fine

    def compare_on_ranks(self, source, fine_path, all_ranks=(2, 3, 7)):
        expected, attributes = arrays(fine_path)
        for ranks in all_ranks:
            found, other = arrays(self.refine(source, "on_ranks.h5", ranks)[0])
            self.assertEqual(found.keys(), expected.keys())
            for name, values in expected.items():
                np.testing.assert_array_equal(found[name], values, f"{name} on {ranks} ranks")
            for name in ("mesh_hash", "edge_length", "smallest_size", "middles_on_curve"):
                self.assertEqual(other[name], attributes[name], name)

    def test_disc(self):
        """New boundary vertices lie on the circle; what the mesh lacks of its area falls to a quarter, twice."""
        path = self.mesh(self.config(DISC))
        fine_path, output = self.refine(path)
        self.assertNotIn("warning", output)
        self.compare_on_ranks(path, fine_path)
        finest_path, _ = self.refine(fine_path, "finest.h5")
        lacks = []
        for mesh in (*self.compare(path, fine_path), self.compare(fine_path, finest_path)[1]):
            rim = mesh[GEOMETRY][mesh[FACETS][:, 0]]
            self.assertLess(abs(np.hypot(*(rim - 0.5).T) - 0.4).max(), 1e-12)
            lacks.append(math.pi * 0.16 - area(mesh))
        for k in (0, 1):
            self.assertTrue(0.245 <= lacks[k + 1] / lacks[k] <= 0.255, lacks)
        self.assertEqual(run("info", finest_path).returncode, 0)
        self.assertEqual(run("convert", finest_path, self.path / "finest.msh").returncode, 0)
        for ending in (".xdmf", ".xmf", ".vtkhdf"):
            self.assertTrue(finest_path.with_suffix(ending).exists(), ending)

    def test_polygon_with_holes_and_markers(self):
        (self.path / "room.poly").write_text(ROOM, encoding="utf-8")
        path = self.mesh(self.config("[shape]\ngeometry = room\n[shape.room]\ntype = contour\nfile = room.poly\n"
                                     "[meshing]\npoints = 600\n"))
        fine_path, output = self.refine(path)
        self.assertNotIn("warning", output)
        coarse, fine = self.compare(path, fine_path)
        markers = coarse["Mesh/facets/markers"]
        self.assertEqual(set(markers), {1, 2, 3, 4, 5})
        np.testing.assert_array_equal(np.bincount(fine["Mesh/facets/markers"]), 2 * np.bincount(markers))
        self.assertAlmostEqual(area(fine), area(coarse), delta=1e-13)
        self.compare_on_ranks(path, fine_path, (3,))

    def test_periodic(self):
        for name in ("torus", "torus_hole"):
            path = self.mesh(ROOT / "configs" / f"{name}.ini", "meshing.points=500", "output.overwrite=true")
            fine_path, output = self.refine(path)
            self.assertNotIn("warning", output)
            self.compare(path, fine_path)
            self.compare_on_ranks(path, fine_path, (3, 7))
            self.compare(fine_path, self.refine(fine_path, "finest.h5")[0])

    def test_simplified_coast(self):
        """Nearly all new vertices lie on the coast as the run has simplified it."""
        path = self.mesh(ROOT / "configs" / "coast.ini", "meshing.points=1500")
        fine_path, output = self.refine(path)
        self.assertNotIn("no curve of the shape", output)
        self.compare(path, fine_path)
        self.compare_on_ranks(path, fine_path, (2, 7))
        attributes = arrays(fine_path)[1]
        middles = {kind: attributes[f"middles_{kind}"] for kind in ("on_curve", "near_curve", "straight", "refused")}
        self.assertEqual(2 * sum(middles.values()), len(arrays(fine_path)[0][FACETS]))
        self.assertEqual(middles["near_curve"] + middles["straight"], 0)
        self.assertLess(middles["refused"], 0.02 * sum(middles.values()))
        self.refine(fine_path, "finest.h5")

    def test_coarse_arcs(self):
        """A vertex stays in the middle of its edge if the triangles would be bad on the curve; trime_check knows."""
        path = self.mesh(ROOT / "configs" / "boolean.ini", "meshing.points=80")
        fine_path, output = self.refine(path)
        self.assertIn("2 of 46 new boundary points lie in the middles of boundary edges, because on the curve of the "
                      "shape they would make bad triangles", output)
        self.compare(path, fine_path)
        self.assertEqual(arrays(fine_path)[1]["middles_refused"], 2)
        # These two points are not on the curve, so none leads from them along the four edges that end there.
        finer_path, output = self.refine(fine_path, "finer.h5")
        self.assertIn("4 of 92 new boundary points lie in the middles of boundary edges, because no curve", output)
        self.compare(fine_path, finer_path)

    def test_curves_that_are_gone(self):
        """Without config, without contour file or with another one, the edges are the curves."""
        contour = self.path / "coast.xy"
        contour.write_text((ROOT / "configs" / "coast.xy").read_text(encoding="utf-8"), encoding="utf-8")
        text = (ROOT / "configs" / "coast.ini").read_text(encoding="utf-8")
        path = self.mesh(self.config(text), "meshing.points=700")
        whole = contour.read_text(encoding="utf-8")
        contour.unlink()
        self.assertIn("coast.xy: No such file", self.refine(path)[1])
        self.compare(path, self.path / "fine.h5")
        contour.write_text(whole.replace("3.1", "3.2"), encoding="utf-8")
        self.assertIn("the files that its config names have changed", run(
            "refine", path, self.path / "changed.h5").stdout)
        with h5py.File(path, "r+") as file:
            del file["trime_mpi/config_resolved"]
        self.assertIn("the file stores no config", self.refine(path, "plain.h5")[1])
        np.testing.assert_array_equal(arrays(self.path / "plain.h5")[0][GEOMETRY],
                                      arrays(self.path / "fine.h5")[0][GEOMETRY])

    def test_bad_input(self):
        path = self.mesh(self.config(DISC))
        (self.path / "old.h5").write_text("kept", encoding="utf-8")
        before = sorted(file.name for file in self.path.iterdir())
        for arguments, code, words in (
                ((path,), 2, "needs two files, found 1 file; usage: trime_mpi refine IN.h5 OUT.h5"),
                ((path, path, "--overwrite"), 2, "give the refined mesh another name"),
                ((path, self.path / "out.msh"), 2, "expected a name that ends with .h5"),
                ((path, self.path / "out.h5", "--degrees"), 2, "belongs to 'trime_mpi convert'"),
                ((path, self.path / "old.h5"), 4, "old.h5 exists; add --overwrite to replace it"),
                ((self.path / "none.h5", self.path / "out.h5"), 4, "cannot open"),
                ((self.path / "case.ini", self.path / "out.h5"), 4, "case.ini"),
                ((path, self.path / "none" / "out.h5"), 4, "No such file or directory")):
            for ranks in (1, 2):
                done = run("refine", *arguments, ranks=ranks)
                self.assertIn(words, done.stderr)
                self.assertIn(done.returncode, (code,) if ranks == 1 else (1, code), words)
        self.assertEqual(sorted(file.name for file in self.path.iterdir()), before)


if __name__ == "__main__":
    unittest.main()
