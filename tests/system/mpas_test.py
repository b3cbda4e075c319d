#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests MPAS files with netCDF4: order and phase of all lists, lengths and areas, and weights that keep the energy."""
import math
import pathlib
import tempfile
import unittest

import h5py
import numpy as np

from region_meshes import areas_of
from trime_run import ROOT, run

try:
    import netCDF4
except ModuleNotFoundError:
    netCDF4 = None

TORUS = "[domain]\nperiodic_x = true\nperiodic_y = true\n[shape]\ngeometry = domain\n[meshing]\npoints = 500\n"
PLACES = ("Cell", "Edge", "Vertex")


class MpasFile:
    """All arrays of a file; numbers count from 0 here; -1 means that something is missing."""

    def __init__(self, path):
        with netCDF4.Dataset(path) as file:
            self.dims = {name: len(dimension) for name, dimension in file.dimensions.items()}
            self.attributes = {name: file.getncattr(name) for name in file.ncattrs()}
            self.arrays = {name: np.asarray(variable[:]) for name, variable in file.variables.items()}
        for name in ("edgesOnCell", "cellsOnCell", "verticesOnCell", "cellsOnEdge", "verticesOnEdge", "cellsOnVertex",
                     "edgesOnVertex", "edgesOnEdge"):
            self.arrays[name] = self.arrays[name].astype(int) - 1
        self.period = np.array([self.attributes["x_period"], self.attributes["y_period"]])
        self.cell, self.edge, self.vertex = (
            np.stack([self.arrays[f"x{what}"], self.arrays[f"y{what}"]], axis=1) for what in PLACES)

    def __getitem__(self, name):
        return self.arrays[name]

    def step(self, a, b):
        """The vector from a to b, the shortest one in a periodic plane."""
        d = b - a
        for k in range(2):
            if self.period[k] > 0:
                d[..., k] -= self.period[k] * np.rint(d[..., k] / self.period[k])
        return d

    def normals(self):
        return np.stack([np.cos(self["angleEdge"]), np.sin(self["angleEdge"])], axis=1)


def cross(a, b):
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


@unittest.skipIf(netCDF4 is None, "no python3-netcdf4 here")
class Mpas(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.directory = tempfile.TemporaryDirectory(prefix="trime-mpas-")
        cls.work = pathlib.Path(cls.directory.name)
        (cls.work / "torus.ini").write_text(TORUS)
        cls.make("torus", cls.work / "torus.ini")
        for cells in ("voronoi", "whole"):
            cls.make(cells, ROOT / "configs" / "spade.ini", f"output.cells={cells}", "meshing.points=700")
        cls.files = {name: MpasFile(cls.work / f"{name}_mpas.nc") for name in ("torus", "voronoi", "whole")}

    @classmethod
    def tearDownClass(cls):
        cls.directory.cleanup()

    @classmethod
    def make(cls, name, config, *changes, ranks=1):
        done = run(config, f"output.directory={cls.work}", f"output.name={name}", "output.formats=vtkhdf xdmf mpas",
                   *changes, ranks=ranks)
        if done.returncode:
            raise AssertionError(done.stdout + done.stderr)

    def test_dimensions(self):
        for name, file in self.files.items():
            with h5py.File(self.work / f"{name}.h5") as mesh:
                points, triangles = mesh["Mesh/mesh/geometry"][:], mesh["Mesh/mesh/topology"][:]
                held = np.unique(mesh["Mesh/facets/topology"][:]) if name == "whole" else []
            is_cell = np.ones(len(points), bool)
            is_cell[held] = False
            sides = np.unique(np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)), axis=0)
            counts = [file.dims[f"n{what}"] for what in ("Cells", "Edges", "Vertices")]
            self.assertEqual(counts, [is_cell.sum()] + [is_cell[ends].any(axis=1).sum() for ends in (sides, triangles)])
            np.testing.assert_array_equal(file.cell, points[is_cell])
            self.assertEqual((file.dims["maxEdges2"], file.dims["TWO"], file.dims["vertexDegree"]),
                             (2 * file.dims["maxEdges"], 2, 3))
            self.assertEqual(file.dims["Time"], 0)
            for what, count in zip(PLACES, counts):
                np.testing.assert_array_equal(file[f"indexTo{what}ID"], np.arange(1, count + 1))
                for zero in ("lat", "lon", "z"):
                    self.assertFalse(file[zero + what].any())

    def test_attributes(self):
        for name, file in self.files.items():
            wanted = (1.0, 1.0, "YES") if name == "torus" else (0.0, 0.0, "NO")
            found = tuple(file.attributes[key] for key in ("x_period", "y_period", "is_periodic"))
            self.assertEqual(found, wanted)
            self.assertEqual((file.attributes["on_a_sphere"], file.attributes["Conventions"]), ("NO", "MPAS"))
            self.assertEqual(file.attributes["sphere_radius"], 0)

    def test_lists_around_cells(self):
        """Vertex i is the far end of edge i, behind which lies cell i; all are counter-clockwise."""
        for name, file in self.files.items():
            for cell, count in enumerate(file["nEdgesOnCell"]):
                edges, cells, vertices = (file[f"{what}OnCell"][cell] for what in ("edges", "cells", "vertices"))
                for array in (edges, cells, vertices):
                    self.assertTrue((array[count:] == -1).all())
                ends = file["cellsOnEdge"][edges[:count]]
                np.testing.assert_array_equal(cells[:count], ends.sum(axis=1) - cell)
                self.assertTrue((ends == cell).any(axis=1).all())
                around = file.step(file.cell[cell], file.edge[edges[:count]])
                whole = name != "voronoi" or vertices[count - 1] >= 0
                for k in range(count if whole else count - 1):
                    self.assertIn(vertices[k], file["verticesOnEdge"][edges[k]])
                    self.assertIn(vertices[k], file["verticesOnEdge"][edges[(k + 1) % count]])
                    self.assertGreater(cross(around[k], around[(k + 1) % count]), 0)

    def test_edges(self):
        for name, file in self.files.items():
            cells, vertices, normals = file["cellsOnEdge"], file["verticesOnEdge"], file.normals()
            self.assertTrue((cells[:, 0] >= 0).all())
            both = cells[:, 1] >= 0
            self.assertEqual(both.all(), name != "whole")
            arms = file.step(file.cell[cells[both, 0]], file.cell[cells[both, 1]])
            np.testing.assert_allclose(arms, (file["dcEdge"][:, None] * normals)[both], atol=1e-14)
            half = file.step(file.cell[cells[:, 0]], file.edge)
            np.testing.assert_allclose(half, 0.5 * file["dcEdge"][:, None] * normals, atol=1e-14)
            closed = (vertices >= 0).all(axis=1)
            self.assertEqual(closed.all(), name != "voronoi")
            tangents = np.stack([-normals[:, 1], normals[:, 0]], axis=1)
            dual = file.step(file.vertex[vertices[closed, 0]], file.vertex[vertices[closed, 1]])
            np.testing.assert_allclose(dual, (file["dvEdge"][:, None] * tangents)[closed], atol=1e-13)

    def test_lists_around_vertices(self):
        for name, file in self.files.items():
            cells, edges = file["cellsOnVertex"], file["edgesOnVertex"]
            np.testing.assert_array_equal(file["boundaryVertex"], (cells < 0).any(axis=1))
            self.assertTrue((cells >= 0).any(axis=1).all())
            self.assertEqual(file["boundaryVertex"].any(), name == "whole")
            for vertex in range(len(cells)):
                for k in range(3):
                    ends = sorted({cells[vertex, k - 1], cells[vertex, k]} - {-1})
                    self.assertEqual(edges[vertex, k] < 0, not ends)
                    if ends:
                        self.assertEqual(sorted(set(file["cellsOnEdge"][edges[vertex, k]]) - {-1}), ends)
                        self.assertIn(vertex, file["verticesOnEdge"][edges[vertex, k]])
                if (cells[vertex] >= 0).all():
                    a, b = (file.step(file.cell[cells[vertex, 0]], file.cell[cells[vertex, k]]) for k in (1, 2))
                    self.assertGreater(cross(a, b), 0)
                    self.assertAlmostEqual(file["areaTriangle"][vertex], 0.5 * cross(a, b), delta=1e-15)

    def test_areas(self):
        for name, file in self.files.items():
            kites, cells = file["kiteAreasOnVertex"], file["cellsOnVertex"]
            np.testing.assert_allclose(kites.sum(axis=1), file["areaTriangle"], rtol=1e-13)
            sums = np.zeros(file.dims["nCells"])
            np.add.at(sums, cells[cells >= 0], kites[cells >= 0])
            np.testing.assert_allclose(sums, file["areaCell"], rtol=1e-12)
            self.assertFalse(kites[cells < 0].any())
            self.assertGreater(file["areaCell"].min(), 0)
            for cell in range(0 if name == "voronoi" else file.dims["nCells"]):  # polygons of whole cells
                corners = file["verticesOnCell"][cell, :file["nEdgesOnCell"][cell]]
                x, y = file.step(file.cell[cell], file.vertex[corners]).T
                self.assertAlmostEqual(0.5 * (x @ np.roll(y, -1) - y @ np.roll(x, -1)), file["areaCell"][cell],
                                       delta=1e-15)
        with h5py.File(self.work / "voronoi.h5") as mesh:
            area = math.fsum(areas_of(mesh["Mesh/mesh/geometry"][:], mesh["Mesh/mesh/topology"][:]))
        self.assertAlmostEqual(math.fsum(self.files["voronoi"]["areaCell"]), area, delta=1e-13)
        self.assertAlmostEqual(math.fsum(self.files["torus"]["areaCell"]), 1, delta=1e-13)

    def test_weights(self):
        """The edges around both cells, and weights that are antisymmetric, so that they keep the kinetic energy."""
        for _, file in self.files.items():
            terms = {}
            for edge, count in enumerate(file["nEdgesOnEdge"]):
                others = file["edgesOnEdge"][edge]
                wanted = [other for cell in file["cellsOnEdge"][edge] if cell >= 0
                          for other in file["edgesOnCell"][cell, :file["nEdgesOnCell"][cell]] if other != edge]
                self.assertEqual(sorted(others[:count]), sorted(wanted))
                self.assertTrue((others[count:] == -1).all())
                for other, weight in zip(others[:count], file["weightsOnEdge"][edge]):
                    term = weight * file["dcEdge"][edge] / file["dvEdge"][other]
                    terms[edge, other] = terms.get((edge, other), 0) + term
            self.assertLess(max(abs(term + terms[other, edge]) for (edge, other), term in terms.items()), 1e-11)

    def test_constant_velocity_on_a_lattice(self):
        file = self.files["torus"]
        normals = file.normals()
        tangents = np.stack([-normals[:, 1], normals[:, 0]], axis=1)
        for velocity in ((1.0, 0.0), (0.0, 1.0), (-2.0, 0.7)):
            u = normals @ velocity
            found = (file["weightsOnEdge"] * np.where(file["edgesOnEdge"] >= 0, u[file["edgesOnEdge"]], 0)).sum(axis=1)
            np.testing.assert_allclose(found, tangents @ velocity, atol=1e-12)

    def test_values(self):
        for name, file in self.files.items():
            self.assertGreater(file["cellQuality"].min(), 0.1)
            self.assertLessEqual(file["meshDensity"].max(), 1)
            self.assertFalse(file["obtuseTriangle"].any())
            for what in ("triangleQuality", "triangleAngleQuality"):
                self.assertTrue(((file[what] > 0.2) & (file[what] <= 1)).all())
            means = [file["dcEdge"][row[:n]].mean() for row, n in zip(file["edgesOnCell"], file["nEdgesOnCell"])]
            np.testing.assert_allclose(file["gridSpacing"], means, rtol=1e-13)
            rows = (self.work / f"{name}_graph.info").read_text().splitlines()
            self.assertEqual(rows[0].split(), [str(file.dims["nCells"]), str((file["cellsOnEdge"][:, 1] >= 0).sum())])
            for row, cells in zip(rows[1:], file["cellsOnCell"]):
                self.assertEqual([int(word) - 1 for word in row.split()], [cell for cell in cells if cell >= 0])
            self.assertEqual(len(rows) - 1, file.dims["nCells"])

    def test_equal_files_on_any_ranks_and_by_convert(self):
        for ranks in (3, 7):
            self.make("again", ROOT / "configs" / "spade.ini", "output.cells=whole", "output.overwrite=true",
                      "meshing.points=700", ranks=ranks)
            self.compare("again", "whole")
        self.make("again", self.work / "torus.ini", "output.overwrite=true", ranks=3)
        self.compare("again", "torus")
        for cells, other in (("voronoi", "whole"), ("whole", "voronoi")):
            done = run("convert", self.work / f"{other}.h5", self.work / f"new_{cells}_mpas.nc", "--cells", cells,
                       ranks=2)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            self.compare(f"new_{cells}", cells)

    def compare(self, name, wanted):
        for ending in ("_mpas.nc", "_graph.info"):
            self.assertEqual((self.work / (name + ending)).read_bytes(), (self.work / (wanted + ending)).read_bytes())


if __name__ == "__main__":
    unittest.main()
