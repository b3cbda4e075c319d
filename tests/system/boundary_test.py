#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests that the boundary of the mesh is that of the shape, from the file and the config alone.

It checks loops, tags and parts, corners and fixed points, that vertices lie on the exact curves, and that the area is
exact to the last chord.

Usage: boundary_test.py CONFIG [POINTS]
"""
import math
import pathlib
import sys
import tempfile
import unittest

import h5py
import numpy as np

from exact_curves import Circle, Config, Formula, Polygon, cross
from trime_run import run

POINTS = int(sys.argv.pop(2)) if len(sys.argv) > 2 else 3000
CONFIG = pathlib.Path(sys.argv.pop(1)).resolve()
VERTEX_LIMIT, AREA_LIMIT, TRACED_LIMIT = 1e-9, 1e-10, 2e-6


class Boundary(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.work = tempfile.TemporaryDirectory(prefix="trime-system-")
        directory = pathlib.Path(cls.work.name)
        done = run(CONFIG, f"meshing.points={POINTS}", f"output.directory={directory}", "output.name=mesh",
                   "meshing.simplify_within=0", ranks=2)  # else vertices lie on the simplified curves
        if done.returncode != 0:
            raise RuntimeError(done.stdout + done.stderr)
        cls.config = Config(CONFIG)
        with h5py.File(directory / "mesh.h5", "r") as file:
            cls.xy = file["Mesh/mesh/geometry"][:]
            cls.triangles = file["Mesh/mesh/topology"][:]
            cls.facets = file["Mesh/facets/topology"][:]
            cls.tags = file["Mesh/facets/values"][:]
            cls.part_ids = file["Mesh/facets/parts"][:]
            cls.size = file["VTKHDF/PointData/size"][:]
            cls.fixed = file["VTKHDF/PointData/fixed"][:]
            cls.table = {name: column[:] for name, column in file["trime_mpi/tags"].items()}
            cls.shape_area = file["trime_mpi"].attrs["shape_area"]
            cls.checks = dict(zip(file["trime_mpi/checks/name"][:], file["trime_mpi/checks/passed"][:]))
        cls.names = [name.decode() for name in cls.table["part_name"]]
        cls.starts = cls.xy[cls.facets[:, 0]]
        cls.ends = cls.near(cls.xy[cls.facets[:, 1]], cls.starts)

    @classmethod
    def tearDownClass(cls):
        cls.work.cleanup()

    @classmethod
    def near(cls, points, others):
        """The images of the points nearest to the others."""
        periods = cls.config.periods
        return points - np.where(np.isfinite(periods), periods, 0) * np.round((points - others) / periods)

    def cycles(self):
        """Facets in the order in which they follow each other."""
        at = {int(start): k for k, start in enumerate(self.facets[:, 0])}
        left = set(range(len(self.facets)))
        while left:
            cycle = [min(left)]
            while (following := at[int(self.facets[cycle[-1], 1])]) != cycle[0]:
                self.assertIn(following, left, "a cycle that meets itself")
                cycle.append(following)
            left -= set(cycle)
            yield cycle

    def facets_by_part(self):
        """Part, and the facets that follow it."""
        for index, name in enumerate(self.names):
            mine = np.flatnonzero(self.part_ids == index)
            if len(mine) > 0:
                yield self.config.parts[name], mine

    def test_facets_are_the_edges_of_one_triangle(self):
        edges = {(int(t[k]), int(t[(k + 1) % 3])) for t in self.triangles for k in range(3)}
        self.assertEqual(len(edges), 3 * len(self.triangles), "no directed edge twice")
        rim = {edge for edge in edges if edge[::-1] not in edges}
        self.assertEqual(rim, {(int(a), int(b)) for a, b in self.facets})
        self.assertEqual(len(rim), len(self.facets))

    def test_facets_are_closed_simple_loops_as_the_table_says(self):
        for column in (0, 1):
            self.assertEqual(len(np.unique(self.facets[:, column])), len(self.facets), "one facet in and one out")
        np.testing.assert_array_equal(np.sort(self.facets[:, 0]), np.sort(self.facets[:, 1]))
        rows = {int(tag): k for k, tag in enumerate(self.table["edge_id"])}
        self.assertEqual(len(rows), len(self.table["edge_id"]))
        for cycle in self.cycles():
            tag = int(self.tags[cycle[0]])
            self.assertTrue((self.tags[cycle] == tag).all(), "one tag along a loop")
            row = rows.pop(tag)
            steps = self.ends[cycle] - self.starts[cycle]
            self.assertEqual(self.table["edge_count"][row], len(cycle))
            self.assertAlmostEqual(self.table["edge_length_sum"][row], np.hypot(*steps.T).sum(), places=11)
            path = np.cumsum(steps, axis=0)
            area = 0.5 * cross(path, np.roll(path, -1, axis=0)).sum()
            kind = "band" if np.abs(path[-1]).max() > 1e-9 else "outer" if area > 0 else "hole"
            self.assertEqual(self.table["edge_kind"][row].decode(), kind)
            self.assertEqual(sorted(self.table["edge_name"][row].decode().split("+")),
                             sorted({self.names[part] for part in self.part_ids[cycle]}))
        self.assertEqual(rows, {}, "loops of the table that the mesh does not have")

    def test_parts_are_those_of_the_config(self):
        np.testing.assert_array_equal(self.table["part_id"], np.arange(len(self.names)))
        self.assertEqual([name for name in self.names if name != "domain"], list(self.config.parts))

    def test_boundary_vertices_lie_on_the_exact_curves(self):
        for part, mine in self.facets_by_part():
            limit = (TRACED_LIMIT if isinstance(part, Formula) else VERTEX_LIMIT) * self.config.side
            self.assertLess(part.distance(self.starts[mine]).max(), limit)
            self.assertLess(part.distance(self.xy[self.facets[mine, 1]]).max(), limit)

    def test_edges_along_circles_stray_as_their_length_allows(self):
        for part, mine in self.facets_by_part():
            if isinstance(part, Circle):
                length = np.hypot(*(self.ends[mine] - self.starts[mine]).T)
                h = 0.5 * (self.size[self.facets[mine, 0]] + self.size[self.facets[mine, 1]])
                strays = part.distance(0.5 * (self.starts[mine] + self.ends[mine]))
                self.assertLess((strays - 1.08 * length ** 2 / (8 * part.radius) - 1e-3 * h).max(), 0)

    def expect_vertices(self, points, steps):
        """Each point is a vertex, to within some steps of the lattice, and marked as fixed."""
        fixed = self.xy[self.fixed == 1]
        for point in points:
            distance = np.abs(self.near(fixed, point) - point).max(axis=1).min()
            self.assertLessEqual(distance, steps * self.config.lattice_step(), point)

    def test_corners_and_fixed_points_are_vertices(self):
        step = self.config.lattice_step()
        for name, part in self.config.parts.items():
            if self.config.ini[f"shape.{name}"]["type"] in ("rectangle", "triangle"):
                self.expect_vertices(np.rint(part.corners / step) * step, 0)
            elif isinstance(part, Polygon):
                # Corners between sides of two local sizes and more; others may be left out (meshing.feature_tolerance).
                turn, side = part.turns()
                sharp = np.flatnonzero(turn > 30)
                rim = self.facets[:, 0]
                h = np.array([self.size[rim[np.hypot(*(self.xy[rim] - part.corners[k]).T).argmin()]] for k in sharp])
                self.expect_vertices(part.corners[sharp[side[sharp] > 2 * h]], 2)
        crossings = list(self.config.crossings())
        self.assertEqual(len(crossings), 12 if CONFIG.stem == "boolean" else 0)
        self.expect_vertices(crossings, 4)
        self.expect_vertices(self.config.fixed_points(), 2)

    def mesh_area(self):
        p, q, r = (self.xy[self.triangles[:, k]] for k in range(3))
        return math.fsum(0.5 * cross(self.near(q, p) - p, self.near(r, p) - p))

    def exact_area(self):
        """Area that the loops of the table enclose, by the formulas of their parts; None if these are not known."""
        area = 0.0 if "outer" in {kind.decode() for kind in self.table["edge_kind"]} else np.prod(self.config.periods)
        for cycle in self.cycles():
            parts = {int(part) for part in self.part_ids[cycle]}
            part = self.config.parts[self.names[parts.pop()]]
            if parts or isinstance(part, Formula):
                return None
            row = list(self.table["edge_id"]).index(self.tags[cycle[0]])
            sign = -1 if self.table["edge_kind"][row] == b"hole" else 1
            area += sign * part.loop_area(self.starts[cycle[0]])
        return area

    def test_area_differs_by_what_lies_beside_the_chords(self):
        """Area of the mesh and of all slivers between edges and exact curve: that of the shape, to 1e-10."""
        if any(isinstance(part, Formula) for part in self.config.parts.values()):
            self.assertLess(abs(self.mesh_area() - self.shape_area), 0.01 * self.shape_area)
            return
        beside = math.fsum(part.between(self.starts[k], self.ends[k])
                           for part, mine in self.facets_by_part() for k in mine)
        exact = self.exact_area()
        for area in [self.shape_area] + ([] if exact is None else [exact]):
            self.assertLess(abs(self.mesh_area() + beside - area), AREA_LIMIT * area)

    def test_the_certificate_says_so_too(self):
        self.assertTrue(all(self.checks.values()), self.checks)
        for name in (b"boundary_segments", b"corners", b"corner_places", b"boundary_cycles",
                     b"irregular_boundary_points", b"foreign_tags", b"vertex_distance", b"chord_deviation",
                     b"arc_deviation", b"area_residual"):
            self.assertIn(name, self.checks)


if __name__ == "__main__":
    unittest.main()
