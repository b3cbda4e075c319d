#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests the Voronoi cells: files equal on any ranks, areas, shared vertices, and a two-point flux that is exact.

The readers of the files are our own, and VTK reads the polygons, too.
"""
import math
import unittest

import h5py
import numpy as np
import vtk
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import spsolve
from vtk.util.numpy_support import vtk_to_numpy as to_numpy

from cell_readers import CellFile, Disv, flux_terms, read_uge
from region_meshes import Mesh, areas_of, by_number, rectangle, region
from trime_run import ROOT, WorkspaceCase, run

HALVES = (rectangle("box", (0, 0), (1, 1)) + rectangle("left", (0, 0), (0.5, 1)) + region("soft", "left") +
          "[shape]\ngeometry = box\nrest = hard\n[meshing]\npoints = 3000\n")
# The curve is a crack: points on it are double.
CRACKED = (rectangle("box", (0, 0), (1, 1)) + "[shape]\ngeometry = box\n[curve.crack]\nfile = crack.xy\n"
           "split = true\n[meshing]\npoints = 800\n")


class Cells(WorkspaceCase):
    """Each test makes its meshes in a separate directory."""

    def mesh(self, config, *changes, ranks=1, name="mesh", formats="vtkhdf xdmf voronoi"):
        done = run(config, f"output.directory={self.directory}", f"output.name={name}", f"output.formats={formats}",
                   *changes, ranks=ranks)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done

    def text_mesh(self, text, *changes, **options):
        (self.directory / "mesh.ini").write_text(text)
        return self.mesh(self.directory / "mesh.ini", *changes, **options)

    def cells(self, name="mesh"):
        return CellFile(self.directory / f"{name}_cells.vtu")

    def check_areas(self, file, mesh):
        """Cells and triangles have equal areas, for each region too."""
        areas = file.polygon_areas()
        np.testing.assert_allclose(file.area, areas, rtol=1e-9)
        self.assertGreater(areas.min(), 0)
        wanted = by_number(mesh.region, areas_of(mesh.points, mesh.triangles))
        found = by_number(file.region, file.area)
        self.assertEqual(set(found), set(wanted))
        for number, area in wanted.items():
            self.assertAlmostEqual(found[number], area, delta=1e-12 * area)

    def check_sides(self, file, mesh):
        """Every side has two polygons or lies on the boundary, and all vertices are in use."""
        single = [ends for ends, owners in file.sides().items() if len(owners) == 1]
        self.assertEqual(len(single), 2 * len(mesh.facets))
        length = math.fsum(np.hypot(*(file.vertices[b] - file.vertices[a])) for a, b in single)
        wanted = math.fsum(np.hypot(*(mesh.points[mesh.facets[:, 1]] - mesh.points[mesh.facets[:, 0]]).T))
        self.assertAlmostEqual(length, wanted, delta=1e-12 * wanted)
        self.assertEqual(len(np.unique(np.concatenate(file.polygons))), len(file.vertices))

    def check_distances(self, file, mesh):
        """A circumcentre has the number of its triangle and the same distance from all three corners."""
        centres = file.vertices[:len(mesh.triangles)]
        distances = np.linalg.norm(mesh.points[mesh.triangles] - centres[:, None], axis=2)
        np.testing.assert_allclose(distances, distances[:, :1].repeat(3, axis=1), rtol=1e-11)

    def check_linear(self, name):
        """What flows out of each cell is 0 if u is linear: fluxes are exact at every site, and no coefficient is
        negative."""
        with h5py.File(self.directory / f"{name}.h5") as file:
            points, facets = file["Mesh/mesh/geometry"][:], file["Mesh/facets/topology"][:]
            faces, distances, lengths = (file[f"Cells/{array}"][:] for array in
                                         ("faces", "face_distances", "face_lengths"))
            period = np.array([file["trime_mpi"].attrs[f"period_{axis}"] for axis in "xy"])
        arms = points[faces[:, 1]] - points[faces[:, 0]]
        arms -= period * np.round(arms / np.where(period > 0, period, np.inf))
        np.testing.assert_allclose(np.hypot(*arms.T), distances, rtol=1e-14)
        terms = lengths.sum(axis=1) / distances
        self.assertGreater(terms.min(), -1e-10)
        out = np.zeros_like(points)
        np.add.at(out, faces[:, 0], terms[:, None] * arms)
        np.add.at(out, faces[:, 1], -terms[:, None] * arms)
        along = points[facets[:, 1]] - points[facets[:, 0]] if len(facets) else np.zeros((0, 2))
        along -= period * np.round(along / np.where(period > 0, period, np.inf))
        for end in (0, 1):
            np.add.at(out, facets[:, end], 0.5 * np.stack([along[:, 1], -along[:, 0]], axis=1))
        self.assertLess(np.abs(out).max(), 1e-11 * distances.max(), name)

    def check_all(self, name="mesh"):
        self.check_linear(name)
        file, mesh = self.cells(name), Mesh(self.directory / f"{name}.h5")
        self.check_areas(file, mesh)
        self.check_sides(file, mesh)
        self.check_distances(file, mesh)
        np.testing.assert_array_equal(np.unique(file.site), np.arange(len(mesh.points)))
        np.testing.assert_array_equal(file.places, mesh.points[file.site])
        return file, mesh

    def test_configs_on_any_ranks(self):
        for config, points in (("square", 1500), ("spade", 1000), ("coast", 2500), ("regions", 2500)):
            with self.subTest(config=config):
                path = ROOT / "configs" / f"{config}.ini"
                done = self.mesh(path, f"meshing.points={points}", name=config)
                self.assertIn("Voronoi cells with the area", done.stdout)
                self.check_all(config)
                wanted = (self.directory / f"{config}_cells.vtu").read_bytes()
                for ranks in (2, 3, 7):
                    self.mesh(path, f"meshing.points={points}", name=f"on{ranks}", ranks=ranks)
                    self.check_same_arrays(config, f"on{ranks}")
                    self.assertTrue((self.directory / f"on{ranks}_cells.vtu").read_bytes() == wanted, ranks)
                    (self.directory / f"on{ranks}_cells.vtu").unlink()
                    self.convert(config, "new_cells.vtu", ranks)
                    self.assertTrue((self.directory / "new_cells.vtu").read_bytes() == wanted, ranks)
                    for old in self.directory.glob(f"on{ranks}*"):
                        old.unlink()

    def check_same_arrays(self, name, other):
        """The cells in two HDF5 files have the same bytes; they are those of the polygons."""
        cells = self.cells(name)
        with h5py.File(self.directory / f"{name}.h5") as one, h5py.File(self.directory / f"{other}.h5") as two:
            self.assertEqual(set(one["Cells"]), set(two["Cells"]))
            for array in one["Cells"]:
                self.assertEqual(one["Cells"][array][:].tobytes(), two["Cells"][array][:].tobytes(), (array, other))
            np.testing.assert_array_equal(one["Cells/vertices"][:], cells.vertices)
            np.testing.assert_array_equal(one["Cells/areas"][:], cells.area)
            np.testing.assert_array_equal(one["Cells/corners"][:], np.concatenate(cells.polygons))

    def convert(self, name, to, ranks=1):
        done = run("convert", self.directory / f"{name}.h5", self.directory / to, "--overwrite", ranks=ranks)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done

    def test_polygons_by_vtk(self):
        self.mesh(ROOT / "configs" / "regions.ini", "meshing.points=1000")
        file, reader = self.cells(), vtk.vtkXMLUnstructuredGridReader()
        reader.SetFileName(str(self.directory / "mesh_cells.vtu"))
        reader.Update()
        grid = reader.GetOutput()
        self.assertEqual((grid.GetNumberOfPoints(), grid.GetNumberOfCells()), (len(file.vertices), len(file.polygons)))
        for name in ("site", "area", "region", "boundary", "site_place"):
            np.testing.assert_array_equal(to_numpy(grid.GetCellData().GetArray(name)), file.arrays[name])
        sizes = vtk.vtkCellSizeFilter()
        sizes.SetInputData(grid)
        sizes.Update()
        found = to_numpy(sizes.GetOutput().GetCellData().GetArray("Area"))
        convex = file.is_convex()  # VTK's areas of other polygons, at reflex corners of the shape, are wrong
        np.testing.assert_allclose(found[convex], file.area[convex], rtol=1e-9)
        self.assertGreater(convex.mean(), 0.9)

    def test_two_materials(self):
        """Flux through two materials, u = 0 and 1 at the sides: exact at every site, no coefficient is negative."""
        self.text_mesh(HALVES, ranks=3)
        file, mesh = self.check_all()
        names = {name: number for number, name in mesh.names.items()}
        terms = flux_terms(file, {names["soft"]: 1.0, names["hard"]: 10.0})
        self.assertGreaterEqual(min(terms.values()), 0)
        points, count = mesh.points, len(mesh.points)
        ends, values = np.array(list(terms)), np.array(list(terms.values()))
        matrix = coo_matrix((np.concatenate([values, values, -values, -values]),
                             (np.concatenate([ends[:, 0], ends[:, 1], ends[:, 0], ends[:, 1]]),
                              np.concatenate([ends[:, 0], ends[:, 1], ends[:, 1], ends[:, 0]]))),
                            shape=(count, count)).tocsr()
        flux = 1 / (0.5 / 1 + 0.5 / 10)
        exact = np.where(points[:, 0] < 0.5, flux * points[:, 0], 0.5 * flux + flux * (points[:, 0] - 0.5) / 10)
        held = (points[:, 0] == 0) | (points[:, 0] == 1)
        u = np.where(held, points[:, 0], 0.0)
        u[~held] = spsolve(matrix[~held][:, ~held].tocsc(), -(matrix[~held] @ u))
        self.assertLess(np.abs(u - exact).max(), 1e-10)
        self.assertAlmostEqual((matrix @ u)[points[:, 0] == 1].sum(), flux, delta=1e-10)

    def test_ten_regions(self):
        """Ten strips with the conductivities 1 to 10 and a constant flux: nothing is left in any cell inside."""
        parts = "".join(rectangle(f"s{k}", (k / 10, 0), ((k + 1) / 10, 1)) + region(f"r{k}", f"s{k}")
                        for k in range(9))
        self.text_mesh(rectangle("box", (0, 0), (1, 1)) + parts +
                       "[shape]\ngeometry = box\n[meshing]\npoints = 1500\n")
        _, mesh = self.check_all()
        with h5py.File(self.directory / "mesh.h5") as file:
            faces, distances, lengths, regions = (file[f"Cells/{array}"][:] for array in (
                "faces", "face_distances", "face_lengths", "face_regions"))
        strips = {number: int(name[1:]) if name[1:].isdigit() else 9 for number, name in mesh.names.items()}
        k = np.array([0.0] + [1.0 + strips[number] for number in sorted(strips)])
        u = np.interp(mesh.points[:, 0], np.arange(11) / 10, np.concatenate([[0], np.cumsum(1 / np.arange(1, 11))]))
        flux = (k[regions] * lengths).sum(axis=1) / distances * (u[faces[:, 1]] - u[faces[:, 0]])
        left = np.zeros(len(u))
        np.add.at(left, faces[:, 0], flux)
        np.add.at(left, faces[:, 1], -flux)
        inside = (mesh.points[:, 0] > 0) & (mesh.points[:, 0] < 1)
        self.assertLess(np.abs(left[inside]).max(), 1e-10 * np.abs(flux).max())

    def test_split_curve(self):
        (self.directory / "crack.xy").write_text("0.3 0.4\n0.6 0.5\n0.7 0.7\n")
        self.text_mesh(CRACKED, ranks=2)
        self.check_all()

    def test_modflow(self):
        """The same cells, clockwise, with merged vertices; a lattice has four points on one circle."""
        (self.directory / "square.ini").write_text(HALVES)
        for config, ranks in ((self.directory / "square.ini", 3), (ROOT / "configs" / "regions.ini", 2)):
            self.mesh(config, "meshing.points=900", "output.overwrite=true", ranks=ranks,
                      formats="vtkhdf xdmf voronoi disv")
            file, grid = self.cells(), Disv(self.directory / "mesh.disv")
            mesh = Mesh(self.directory / "mesh.h5")
            np.testing.assert_array_equal(grid.places, mesh.points)
            whole = np.bincount(file.site, file.area)
            np.testing.assert_allclose(grid.areas(), whole, rtol=1e-9)
            self.assertEqual(grid.zones, {number: name for name, number in file.regions.items()})
            shares = np.zeros((len(whole), len(file.regions) + 1))
            np.add.at(shares, (file.site, file.region), file.area)
            zones = np.loadtxt(self.directory / "mesh.zones", dtype=int)
            np.testing.assert_allclose(shares[np.arange(len(zones)), zones], shares.max(axis=1), rtol=1e-12)
            faces = grid.faces()
            edges = np.unique(np.sort(mesh.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)), axis=0)
            self.assertLessEqual(set(faces), set(map(tuple, edges.tolist())))
            self.assertGreater(len(faces), 0.9 * (len(edges) - len(mesh.facets)))

    def test_pflotran(self):
        (self.directory / "mesh.ini").write_text(HALVES)
        self.mesh(self.directory / "mesh.ini", "meshing.points=900", formats="vtkhdf xdmf voronoi uge", ranks=2)
        file, mesh = self.cells(), Mesh(self.directory / "mesh.h5")
        cells, ends, faces = read_uge(self.directory / "mesh.uge")
        np.testing.assert_array_equal(cells[:, :2], mesh.points)
        np.testing.assert_allclose(cells[:, 3], np.bincount(file.site, file.area), rtol=1e-12)
        wanted = {pair: term for pair, term in flux_terms(file, {1: 1.0, 2: 1.0}).items() if term > 1e-9}
        self.assertEqual(set(map(tuple, ends.tolist())), set(wanted))
        lengths = np.hypot(*(mesh.points[ends[:, 1]] - mesh.points[ends[:, 0]]).T)
        terms = np.array([wanted[pair] for pair in map(tuple, ends.tolist())])
        np.testing.assert_allclose(faces[:, 3], terms * lengths, rtol=1e-9, atol=1e-12)
        np.testing.assert_allclose(faces[:, :2], mesh.points[ends].mean(axis=1), atol=1e-15)
        area = 0.0
        for path in self.directory.glob("mesh_*.ex"):
            rows = path.read_text().splitlines()
            self.assertEqual(rows[0], f"CONNECTIONS {len(rows) - 1}")
            area += math.fsum(float(row.split()[4]) for row in rows[1:])
        self.assertAlmostEqual(area, 4, delta=1e-12)

    def test_periodic(self):
        """Cells across the border have vertices of their own."""
        for config in ("torus", "torus_hole"):
            self.mesh(ROOT / "configs" / f"{config}.ini", "meshing.points=1200", name=config)
            wanted = (self.directory / f"{config}_cells.vtu").read_bytes()
            self.convert(config, "new_cells.vtu", 3)
            self.assertTrue((self.directory / "new_cells.vtu").read_bytes() == wanted)
            file = self.cells(config)
            np.testing.assert_allclose(file.polygon_areas(), file.area, rtol=1e-9)
            with h5py.File(self.directory / f"{config}.h5") as mesh:
                period = [mesh["/trime_mpi"].attrs[name] for name in ("period_x", "period_y")]
                points, triangles = mesh["/Mesh/mesh/geometry"][:], mesh["/Mesh/mesh/topology"][:]
            arms = points[triangles] - points[triangles[:, :1]]
            arms -= period * np.round(arms / period)
            total = 0.5 * math.fsum(arms[:, 1, 0] * arms[:, 2, 1] - arms[:, 1, 1] * arms[:, 2, 0])
            self.assertAlmostEqual(math.fsum(file.area), total, delta=1e-12)
            self.assertEqual(len(file.polygons), len(points))
            self.check_linear(config)


if __name__ == "__main__":
    unittest.main()
