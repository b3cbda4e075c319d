#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests cells for PFLOTRAN, MODFLOW 6 and TOUGH2: triangles with their circumcentres, and Voronoi cells."""
import csv
import json
import math
import pathlib
import tempfile
import unittest
from collections import defaultdict

import h5py
import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import spsolve

from cell_readers import Disv, read_tough, read_uge
from region_meshes import Mesh, areas_of, by_number, rectangle, region
from trime_run import run

HALVES = (rectangle("box", (0, 0), (1, 1)) + rectangle("left", (0, 0), (0.5, 1)) + region("soft_rock", "left") +
          region("soft_rock_2", "right") + rectangle("right", (0.75, 0), (1, 1)) +
          "[curve.water]\nfile = river.geojson\nattribute = name\n" +
          "[shape]\ngeometry = box\nrest = hard\n[meshing]\npoints = 700\n")
RIVER = {"type": "Feature", "properties": {"name": 'the "river", old'},
         "geometry": {"type": "LineString", "coordinates": [[0, 0.2], [0.3, 0.4], [0.62, 0.5]]}}
ENDINGS = (".uge", "_box.ex", "_uge.csv", ".disv", ".zones", "_disv.csv", ".tough", "_tough.csv")


class FlowCells(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.directory = tempfile.TemporaryDirectory(prefix="trime-flow-")
        cls.work = pathlib.Path(cls.directory.name)
        (cls.work / "mesh.ini").write_text(HALVES)
        (cls.work / "river.geojson").write_text(json.dumps(RIVER))
        cls.output = cls.make("triangles", "triangles").stdout
        cls.make("voronoi", "voronoi")
        cls.mesh = Mesh(cls.work / "triangles.h5")

    @classmethod
    def tearDownClass(cls):
        cls.directory.cleanup()

    @classmethod
    def make(cls, name, cells, ranks=1):
        done = run(cls.work / "mesh.ini", f"output.directory={cls.work}", f"output.name={name}",
                   f"output.cells={cells}", "output.formats=vtkhdf xdmf disv uge tough", ranks=ranks)
        if done.returncode:
            raise AssertionError(done.stdout + done.stderr)
        return done

    def check_centres(self, centres):
        """Each centre has the same distance from all corners of its triangle."""
        distances = np.linalg.norm(self.mesh.points[self.mesh.triangles] - centres[:, None], axis=2)
        np.testing.assert_allclose(distances, distances[:, :1].repeat(3, axis=1), rtol=1e-11)

    def test_triangles_for_pflotran(self):
        cells, ends, faces = read_uge(self.work / "triangles.uge")
        self.check_centres(cells[:, :2])
        np.testing.assert_allclose(cells[:, 3], self.mesh.areas, rtol=1e-12)
        self.assertEqual(len(ends), (3 * len(self.mesh.triangles) - len(self.mesh.facets)) // 2)
        self.assertTrue((ends[:, 0] < ends[:, 1]).all())
        self.assertEqual(len(np.unique(ends, axis=0)), len(ends))
        for (a, b), (x, y, _, length) in zip(ends, faces):
            shared = sorted(set(self.mesh.triangles[a]) & set(self.mesh.triangles[b]))
            p, q = self.mesh.points[shared]
            np.testing.assert_allclose([x, y], 0.5 * (p + q), atol=1e-15)
            self.assertAlmostEqual(length, np.hypot(*(q - p)), delta=1e-15)
            self.assertAlmostEqual((cells[b, :2] - cells[a, :2]) @ (q - p), 0, delta=1e-15)
        rows = np.loadtxt(self.work / "triangles_box.ex", skiprows=1)
        self.assertEqual(len(rows), len(self.mesh.facets))
        self.assertAlmostEqual(math.fsum(rows[:, 4]), 4, delta=1e-12)

    def test_flux_through_two_materials(self):
        """u = 0 and 1 at the sides: exact at every centre, by what PFLOTRAN reads alone."""
        cells, ends, faces = read_uge(self.work / "triangles.uge")
        names = {number: name for name, number in self.mesh.numbers.items()}
        k = np.array([10.0 if names[int(r)] == "hard" else 1.0 for r in self.mesh.region])
        distance = [np.hypot(*(cells[ends[:, side], :2] - faces[:, :2]).T) for side in (0, 1)]
        terms = faces[:, 3] / (distance[0] / k[ends[:, 0]] + distance[1] / k[ends[:, 1]])
        self.assertGreater(terms.min(), 0)
        rows = np.loadtxt(self.work / "triangles_box.ex", skiprows=1)
        rows = rows[(rows[:, 1] == 0) | (rows[:, 1] == 1)]
        inside = rows[:, 0].astype(int) - 1
        held = k[inside] * rows[:, 4] / np.hypot(*(cells[inside, :2] - rows[:, 1:3]).T)
        count, (a, b) = len(cells), ends.T
        matrix = coo_matrix((np.concatenate([terms, terms, -terms, -terms, held]),
                             (np.concatenate([a, b, a, b, inside]), np.concatenate([a, b, b, a, inside]))),
                            shape=(count, count)).tocsc()
        right = np.zeros(count)
        np.add.at(right, inside, held * rows[:, 1])
        x = cells[:, 0]
        flux = 1 / (0.75 / 1 + 0.25 / 10)
        exact = flux * np.where(x < 0.5, x, np.where(x < 0.75, 0.5 + (x - 0.5) / 10, 0.525 + (x - 0.75)))
        self.assertLess(np.abs(spsolve(matrix, right) - exact).max(), 1e-10)

    def test_triangles_for_modflow(self):
        grid = Disv(self.work / "triangles.disv")
        np.testing.assert_array_equal(grid.vertices, self.mesh.points)
        np.testing.assert_array_equal([cell[::-1] for cell in grid.cells], self.mesh.triangles)
        np.testing.assert_allclose(grid.areas(), self.mesh.areas, rtol=1e-12)
        self.check_centres(grid.places)
        _, ends, _ = read_uge(self.work / "triangles.uge")
        self.assertEqual(grid.faces(), sorted(map(tuple, ends.tolist())))
        zones = np.loadtxt(self.work / "triangles.zones", dtype=int)
        np.testing.assert_array_equal(zones, self.mesh.region)
        self.assertEqual(grid.zones, self.mesh.names)

    def cells_of_lines(self, cells):
        """Lengths by label and cell, from the edges in NAME.h5."""
        with h5py.File(self.work / f"{cells}.h5") as file:
            lines, labels = file["/Mesh/lines/topology"][:], file["/Mesh/lines/labels"][:]
        at_edge = defaultdict(list)
        for number, (a, b, c) in enumerate(self.mesh.triangles):
            for end in ((a, b), (b, c), (c, a)):
                at_edge[frozenset(end)].append(number)
        lengths = defaultdict(float)
        for ends, label in zip(lines, labels):
            length = np.hypot(*(self.mesh.points[ends[1]] - self.mesh.points[ends[0]]))
            at = ends if cells == "voronoi" else at_edge[frozenset(ends)]
            for cell in at:
                lengths[int(label), int(cell)] += length / len(at)
        return lengths

    def test_cells_along_named_lines(self):
        names = self.mesh.parts + list(self.mesh.curve_lengths) + [self.mesh.pairs[k] for k in sorted(self.mesh.pairs)]
        for cells in ("triangles", "voronoi"):
            wanted = self.cells_of_lines(cells)
            with open(self.work / f"{cells}_disv.csv", newline="", encoding="utf-8") as table:
                rows = list(csv.DictReader(table))
            self.assertEqual([(int(row["label"]), int(row["cell"]) - 1) for row in rows], sorted(wanted))
            self.assertEqual({row["name"] for row in rows},
                             {"box", 'water.the "river", old', "hard|soft_rock", "hard|soft_rock_2"})
            for row in rows:
                self.assertEqual(row["name"], names[int(row["label"]) - 1])
                length = wanted[int(row["label"]), int(row["cell"]) - 1]
                self.assertAlmostEqual(float(row["length"]), length, delta=1e-14)
            box = math.fsum(float(row["length"]) for row in rows if row["name"] == "box")
            self.assertAlmostEqual(box, 4, delta=1e-12)
            elements = read_tough(self.work / f"{cells}.tough")[0]
            with open(self.work / f"{cells}_tough.csv", newline="", encoding="utf-8") as table:
                self.assertEqual([row["cell"] for row in csv.DictReader(table)],
                                 [elements[int(row["cell"]) - 1] for row in rows])

    def test_tough(self):
        for cells in ("triangles", "voronoi"):
            names, materials, volumes, centres, ends, rows = read_tough(self.work / f"{cells}.tough")
            wanted, wanted_ends, faces = read_uge(self.work / f"{cells}.uge")
            self.assertEqual(names[:2] + names[100:101], ["AAA00", "AAA01", "AAB00"])
            np.testing.assert_allclose(volumes, wanted[:, 3], rtol=1e-4)
            np.testing.assert_allclose(centres, wanted[:, :2], atol=1e-7)
            np.testing.assert_array_equal(ends, wanted_ends)
            np.testing.assert_allclose(rows[:, 3], faces[:, 3], rtol=1e-3)
            for side in (0, 1):
                distance = np.hypot(*(wanted[ends[:, side], :2] - faces[:, :2]).T)
                np.testing.assert_allclose(rows[:, 1 + side], distance, rtol=1e-3, atol=1e-9)
            self.assertTrue((rows[:, 0] == 1).all() and (rows[:, 4] == 0).all())
            self.assertEqual(set(materials), {"hard", "soft_", "sof_2"})
            if cells == "triangles":
                short = {number: {"soft_rock": "soft_", "soft_rock_2": "sof_2"}.get(name, name)
                         for number, name in self.mesh.names.items()}
                self.assertEqual(materials, [short[int(number)] for number in self.mesh.region])
        self.assertIn("sof_2 is soft_rock_2", self.output)

    def test_equal_files_on_any_ranks_and_by_convert(self):
        self.make("three", "triangles", ranks=3)
        for ending in ENDINGS:
            self.assertEqual((self.work / f"three{ending}").read_bytes(),
                             (self.work / f"triangles{ending}").read_bytes(), ending)
        for cells, other in (("triangles", "voronoi"), ("voronoi", "triangles")):
            done = run("convert", self.work / f"{other}.h5", self.work / "new.tough", "--cells", cells, "--overwrite",
                       ranks=2)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            self.assertEqual((self.work / "new.tough").read_bytes(), (self.work / f"{cells}.tough").read_bytes())

    def test_summary_and_refusals(self):
        self.assertIn("triangles as cells, 0 of them obtuse; largest angle", self.output)
        regions = by_number(self.mesh.region, areas_of(self.mesh.points, self.mesh.triangles))
        self.assertEqual(len(regions), 3)
        for cells, formats in (("whole", "uge"), ("triangles", "mpas")):
            done = run(self.work / "mesh.ini", f"output.cells={cells}", f"output.formats=vtkhdf {formats}")
            self.assertEqual(done.returncode, 2)
            self.assertIn(f"found '{cells}'", done.stdout + done.stderr)

    def output_of(self, corners, points):
        """What a run says that makes few triangles in a polygon."""
        (self.work / "few.xy").write_text(corners)
        (self.work / "few.ini").write_text("[shape.few]\ntype = contour\nfile = few.xy\n[shape]\ngeometry = few\n"
                                           f"[meshing]\npoints = {points}\nworst_alpha = 1e6\n")
        done = run(self.work / "few.ini", f"output.directory={self.work}", "output.cells=triangles",
                   "output.overwrite=true", "output.formats=vtkhdf xdmf uge")
        self.assertIn(done.returncode, (0, 5), done.stdout + done.stderr)
        return done.stdout + done.stderr

    def test_obtuse_triangles_are_named(self):
        """Corners of 17 degrees force angles above 90 degrees."""
        text = self.output_of("0 0\n2 0\n1 0.3\n", 12)
        mesh = Mesh(self.work / "few.h5")
        a, b, c = (mesh.points[mesh.triangles[:, k]] for k in range(3))
        cosines = np.min([((q - p) * (r - p)).sum(axis=1) / np.hypot(*(q - p).T) / np.hypot(*(r - p).T)
                          for p, q, r in ((a, b, c), (b, c, a), (c, a, b))], axis=0)
        largest = math.degrees(math.acos(cosines.min()))
        wanted = f"{(cosines < -1e-9).sum()} of {len(a)}; the largest angle is {largest:.4g} degrees at ("
        self.assertIn(f"obtuse triangles, whose centres lie in a neighbour: {wanted}", text)
        self.assertGreater((cosines < -1e-9).sum(), 0)

    def test_centres_at_one_place_are_named(self):
        text = self.output_of("0 0\n1 0\n1 1\n0 1\n", 4)
        self.assertIn("centres at one place, since the corners of both lie on one circle: 1 pairs", text)


if __name__ == "__main__":
    unittest.main()
