#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests that the mesh file keeps its contract: types, shapes and attributes are right, the mesh is sound, and other
programs can read it.

Usage: file_contract_test.py CONFIG
"""
import configparser
import pathlib
import sys
import tempfile
import unittest

import h5py
import meshio
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOHDF import vtkHDFReader

from trime_run import run

CONFIG = pathlib.Path(sys.argv.pop()).resolve()

N, M, B = "points", "triangles", "facets"
DATASETS = {
    "VTKHDF/NumberOfPoints": ("int64", (1,)), "VTKHDF/NumberOfCells": ("int64", (1,)),
    "VTKHDF/NumberOfConnectivityIds": ("int64", (1,)), "VTKHDF/Points": ("float64", (N, 3)),
    "VTKHDF/Connectivity": ("int32", ("3M",)), "VTKHDF/Offsets": ("int32", ("M+1",)), "VTKHDF/Types": ("uint8", (M,)),
    "VTKHDF/CellData/alpha": ("float32", (M,)), "VTKHDF/CellData/beta": ("float32", (M,)),
    "VTKHDF/CellData/region": ("int32", (M,)), "VTKHDF/PointData/boundary": ("int32", (N,)),
    "VTKHDF/PointData/size": ("float32", (N,)), "VTKHDF/PointData/fixed": ("uint8", (N,)),
    "Mesh/mesh/geometry": ("float64", (N, 2)), "Mesh/mesh/topology": ("int32", (M, 3)),
    "Mesh/facets/topology": ("int64", (B, 2)), "Mesh/facets/values": ("int32", (B,)),
    "Mesh/facets/parts": ("int32", (B,)), "Mesh/facets/labels": ("int32", (B,)),
    "Mesh/facets/asked_size": ("float32", (B,)),
}
VIRTUAL = ["VTKHDF/Points", "VTKHDF/Connectivity"]  # show arrays of /Mesh/mesh
ATTRIBUTES = ["format", "format_version", "program_version", "git_commit", "build_type", "compiler", "mpi_library",
              "hdf5_library", "created_utc", "command_line", "host", "seed", "mpi_ranks", "omp_threads", "stop_reason",
              "mesh_hash", "complete"]


def directed_edges(triangles):
    """All 3M directed edges."""
    return np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])


class FileContract(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.work = tempfile.TemporaryDirectory(prefix="trime-system-")
        cls.directory = pathlib.Path(cls.work.name)
        cls.done = run(CONFIG, "meshing.points=2000", f"output.directory={cls.directory}", "output.name=mesh", ranks=2)
        if cls.done.returncode != 0:
            raise RuntimeError(cls.done.stdout + cls.done.stderr)
        cls.file = h5py.File(cls.directory / "mesh.h5", "r")
        cls.xy = cls.file["Mesh/mesh/geometry"][:]
        cls.triangles = cls.file["Mesh/mesh/topology"][:]
        cls.facets = cls.file["Mesh/facets/topology"][:]
        cls.periods = cls.periods_of(cls.file["trime_mpi/config_resolved"][()].decode())

    @staticmethod
    def periods_of(text):
        """Periods of the container along x and y, infinite where it has none."""
        config = configparser.ConfigParser(inline_comment_prefixes="#;", interpolation=None)
        config.read_string(text)
        domain = config["domain"]
        return np.array([domain.getfloat(f"{axis}_max") - domain.getfloat(f"{axis}_min")
                         if domain.getboolean(f"periodic_{axis}") else np.inf for axis in "xy"])

    def corners(self):
        """The three corners of all triangles, those across a border of the container as the images next to the
        first."""
        p, q, r = (self.xy[self.triangles[:, k]] for k in range(3))
        finite = np.where(np.isfinite(self.periods), self.periods, 0)
        return p, *(v - finite * np.round((v - p) / self.periods) for v in (q, r))

    @classmethod
    def tearDownClass(cls):
        cls.file.close()
        cls.work.cleanup()

    def test_types_and_shapes(self):
        sizes = {N: len(self.xy), M: len(self.triangles), B: len(self.facets), "3M": 3 * len(self.triangles),
                 "M+1": len(self.triangles) + 1}
        for path, (kind, shape) in DATASETS.items():
            with self.subTest(path=path):
                self.assertEqual(self.file[path].dtype, np.dtype(kind))
                self.assertEqual(self.file[path].shape, tuple(sizes.get(length, length) for length in shape))
                self.assertIsNone(self.file[path].chunks, "contiguous storage")
                self.assertEqual(self.file[path].is_virtual, path in VIRTUAL)
                stored = 0 if path in VIRTUAL else self.file[path].nbytes
                self.assertEqual(self.file[path].id.get_storage_size(), stored)

    def test_header_of_vtkhdf(self):
        group = self.file["VTKHDF"]
        self.assertEqual(list(group.attrs["Version"]), [1, 0])
        kind = group.attrs.get_id("Type").get_type()
        self.assertFalse(kind.is_variable_str(), "old readers want a string of fixed length")
        self.assertEqual(kind.get_cset(), h5py.h5t.CSET_ASCII)
        self.assertEqual(group.attrs["Type"], b"UnstructuredGrid")
        self.assertEqual(group["NumberOfPoints"][0], len(self.xy))
        self.assertEqual(group["NumberOfCells"][0], len(self.triangles))
        self.assertEqual(group["NumberOfConnectivityIds"][0], 3 * len(self.triangles))

    def test_both_views_hold_one_mesh(self):
        np.testing.assert_array_equal(self.file["VTKHDF/Points"][:, :2], self.xy)
        self.assertFalse(self.file["VTKHDF/Points"][:, 2].any())
        np.testing.assert_array_equal(self.file["VTKHDF/Connectivity"][:].reshape(-1, 3), self.triangles)
        np.testing.assert_array_equal(self.file["VTKHDF/Offsets"][:], 3 * np.arange(len(self.triangles) + 1))
        self.assertTrue((self.file["VTKHDF/Types"][:] == 5).all())

    def test_places_where_petsc_looks(self):
        self.assertEqual(self.file["geometry/vertices"], self.file["Mesh/mesh/geometry"])
        self.assertEqual(self.file["viz/topology/cells"], self.file["Mesh/mesh/topology"])
        topology = self.file["Mesh/mesh/topology"].attrs
        self.assertEqual((topology["cell_dim"], topology["cell_corners"]), (2, 3))

    def test_triangles_are_positive_and_in_order(self):
        p, q, r = self.corners()
        twice_area = (q[:, 0] - p[:, 0]) * (r[:, 1] - p[:, 1]) - (q[:, 1] - p[:, 1]) * (r[:, 0] - p[:, 0])
        self.assertGreater(twice_area.min(), 0)
        self.assertTrue((self.triangles[:, 0] == self.triangles.min(axis=1)).all(), "lowest vertex first")
        self.assertTrue((np.diff(self.triangles[:, 0]) >= 0).all(), "triangles by their lowest vertex")
        np.testing.assert_array_equal(np.unique(self.triangles), np.arange(len(self.xy)))

    def test_mesh_is_a_manifold_whose_rim_is_the_facets(self):
        edges = directed_edges(self.triangles)
        self.assertEqual(len(np.unique(edges, axis=0)), len(edges), "no directed edge twice")
        undirected, counts = np.unique(np.sort(edges, axis=1), axis=0, return_counts=True)
        self.assertLessEqual(counts.max(), 2)
        directed = {tuple(edge) for edge in edges}
        self.assertTrue(all(tuple(facet) in directed for facet in self.facets), "interior on the left of each facet")
        np.testing.assert_array_equal(np.unique(np.sort(self.facets, axis=1), axis=0), undirected[counts == 1])
        self.assertEqual(len(self.facets), (counts == 1).sum())
        starts, times = np.unique(self.facets[:, 0], return_counts=True)
        self.assertTrue((times == 1).all(), "no pinched boundary point")
        np.testing.assert_array_equal(starts, np.flatnonzero(self.file["VTKHDF/PointData/boundary"][:]))
        self.assertTrue((self.file["Mesh/facets/values"][:] > 0).all())

    def test_quality_is_what_the_file_says(self):
        p, q, r = self.corners()
        a, b, c = (np.hypot(*(u - v).T) for u, v in ((q, r), (r, p), (p, q)))
        s = (a + b + c) / 2
        alpha = a * b * c / (8 * (s - a) * (s - b) * (s - c))
        np.testing.assert_allclose(self.file["VTKHDF/CellData/alpha"][:], alpha, rtol=1e-5)
        lengths = np.sort(np.stack([a, b, c]), axis=0)
        np.testing.assert_allclose(self.file["VTKHDF/CellData/beta"][:], lengths[2] / lengths[0], rtol=1e-5)
        cosines = [((v - u) * (w - u)).sum(axis=1) / (np.hypot(*(v - u).T) * np.hypot(*(w - u).T))
                   for u, v, w in ((p, q, r), (q, r, p), (r, p, q))]
        least, rounding = np.min(cosines, axis=0), 1e-12
        found = int(self.file["trime_mpi/quality"].attrs["obtuse_triangles"])
        self.assertGreaterEqual(found, (least < -rounding).sum())
        self.assertLessEqual(found, (least < rounding).sum())

    def test_provenance(self):
        about = self.file["trime_mpi"]
        missing = [name for name in ATTRIBUTES if name not in about.attrs]
        self.assertEqual(missing, [])
        self.assertEqual(int(about.attrs["complete"]), 1)
        self.assertEqual(int(about.attrs["mpi_ranks"]), 2)
        given = about["config_text"][()]
        self.assertEqual(given.decode() if isinstance(given, bytes) else given, CONFIG.read_text(encoding="utf-8"))
        self.assertIn(b"2000", bytes(about["config_resolved"][()]))
        timers = about["timers"]
        self.assertEqual(len({len(timers[name]) for name in ("name", "calls", "min", "avg", "max")}), 1)
        self.assertTrue((timers["min"][:] <= timers["max"][:]).all())

    def test_counters_add_up(self):
        counters = self.file["trime_mpi/counters"]
        self.assertTrue(counters.attrs["limit"])
        columns = ("phase", "name", "unit", "sum", "min", "mean", "max")
        self.assertEqual(len({len(counters[name]) for name in columns}), 1)
        self.assertTrue((counters["min"][:] <= counters["mean"][:]).all())
        self.assertTrue((counters["mean"][:] <= counters["max"][:]).all())
        phases, names = counters["phase"].asstr()[:], counters["name"].asstr()[:]
        run = {name: counters["sum"][k] for k, name in enumerate(names) if phases[k] == "run"}
        self.assertEqual(run["sites_extracted"], len(self.xy))
        for name in ("messages", "sites_swept", "stars_by_emptiness"):
            self.assertEqual(counters["sum"][(phases != "run") & (names == name)].sum(), run[name], name)
        self.assertEqual(counters["max"][(phases == "run") & (names == "neighbours")].tolist(), [1])

    def test_a_very_long_command_line_is_kept(self):
        """Longer than HDF5 lets an attribute be."""
        overrides = ["meshing.corner_angle=30"] * 5000 + ["meshing.points=300", "output.name=long"]
        done = run(CONFIG, f"output.directory={self.directory}", *overrides, ranks=2)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        with h5py.File(self.directory / "long.h5", "r") as file:
            start = file["trime_mpi"].attrs["command_line"]
            start = start.decode() if isinstance(start, bytes) else start
            whole = file["trime_mpi/command_line"][()].decode()
            self.assertEqual(len(start), 1000)
            self.assertTrue(start.endswith("..."))
            self.assertTrue(whole.startswith(start[:-3]))
            self.assertTrue(whole.endswith(" ".join(overrides)), whole[-100:])

    def test_resolved_config_gives_the_same_mesh(self):
        text = self.file["trime_mpi/config_resolved"][()]
        again = CONFIG.parent / CONFIG.name  # relative paths of the config must still hold
        resolved = self.directory / "again.ini"
        resolved.write_text(text.decode() if isinstance(text, bytes) else text, encoding="utf-8")
        done = run(resolved, f"output.directory={self.directory}", "output.name=again", cwd=again.parent)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        with h5py.File(self.directory / "again.h5", "r") as file:
            self.assertEqual(file["trime_mpi"].attrs["mesh_hash"], self.file["trime_mpi"].attrs["mesh_hash"])

    def test_vtk_reads_it(self):
        reader = vtkHDFReader()
        reader.SetFileName(str(self.directory / "mesh.vtkhdf"))
        reader.Update()
        grid = reader.GetOutput()
        self.assertEqual(grid.GetNumberOfPoints(), len(self.xy))
        self.assertEqual(grid.GetNumberOfCells(), len(self.triangles))
        np.testing.assert_array_equal(vtk_to_numpy(grid.GetPoints().GetData())[:, :2], self.xy)
        np.testing.assert_array_equal(vtk_to_numpy(grid.GetCellData().GetArray("alpha")),
                                      self.file["VTKHDF/CellData/alpha"][:])
        self.assertIsNotNone(grid.GetPointData().GetArray("boundary"))

    def test_meshio_reads_it(self):
        mesh = meshio.read(self.directory / "mesh.xdmf")
        np.testing.assert_array_equal(mesh.points[:, :2], self.xy)
        np.testing.assert_array_equal(mesh.cells_dict["triangle"], self.triangles)
        self.assertIn("alpha", mesh.cell_data)
        self.assertIn("boundary", mesh.point_data)


if __name__ == "__main__":
    unittest.main()
