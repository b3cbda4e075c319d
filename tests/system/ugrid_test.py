#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests UGRID files by two libraries: netCDF4 in Python reads all arrays, and MDAL in QGIS the mesh and its data."""
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy as np

from cell_readers import CellFile
from region_meshes import rectangle, region
from trime_run import run

try:
    import netCDF4
except ModuleNotFoundError:
    netCDF4 = None

HALVES = (rectangle("box", (0, 0), (1, 1)) + rectangle("left", (0, 0), (0.5, 1)) + region("soft", "left") +
          "[shape]\ngeometry = box\nrest = hard\n[meshing]\npoints = 500\n[output]\ndepth = 3 + x\n")
BY_QGIS = """
import os
import sys
import numpy as np
from qgis.core import QgsApplication, QgsMesh, QgsMeshDatasetIndex, QgsMeshLayer
application = QgsApplication([], False)
application.initQgis()
for path in sys.argv[1:]:
    layer, mesh = QgsMeshLayer(path, "mesh", "mdal"), QgsMesh()
    assert layer.isValid(), path
    provider = layer.dataProvider()
    provider.populateMesh(mesh)
    points = [mesh.vertex(k) for k in range(mesh.vertexCount())]
    faces = [mesh.face(k) for k in range(mesh.faceCount())]
    values = {}
    for group in range(provider.datasetGroupCount()):
        block = provider.datasetValues(QgsMeshDatasetIndex(group, 0), 0, mesh.faceCount())
        name = provider.datasetGroupMetadata(group).name().split(":")[0]
        values[name] = [block.value(k).scalar() for k in range(block.count())]
    np.savez(path + ".npz", points=[(p.x(), p.y()) for p in points], corners=np.concatenate(faces),
             counts=[len(face) for face in faces], **values)
os._exit(0)  # without taking Qt down
"""


def polygons_of(file):
    """The corners of each face."""
    return [np.asarray(row.compressed(), int) for row in np.ma.masked_array(file["mesh2d_face_nodes"][:])]


def area_of(points, polygon):
    x, y = (points[polygon] - points[polygon[0]]).T
    return 0.5 * (x @ np.roll(y, -1) - y @ np.roll(x, -1))


class Ugrid(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.directory = tempfile.TemporaryDirectory(prefix="trime-ugrid-")
        cls.work = pathlib.Path(cls.directory.name)
        cls.make("one", 1)

    @classmethod
    def tearDownClass(cls):
        cls.directory.cleanup()

    @classmethod
    def make(cls, name, ranks):
        (cls.work / "mesh.ini").write_text(HALVES)
        done = run(cls.work / "mesh.ini", f"output.directory={cls.work}", f"output.name={name}",
                   "output.formats=vtkhdf xdmf voronoi ugrid ugrid_cells", ranks=ranks)
        if done.returncode:
            raise AssertionError(done.stdout + done.stderr)

    @unittest.skipIf(netCDF4 is None, "no python3-netcdf4 here")
    def test_triangles_by_netcdf(self):
        with netCDF4.Dataset(self.work / "one.nc") as file, h5py.File(self.work / "one.h5") as mesh:
            topology = file["mesh2d"]
            self.assertEqual((topology.cf_role, topology.topology_dimension), ("mesh_topology", 2))
            for attribute in ("node_coordinates", "face_node_connectivity", "face_coordinates",
                              "boundary_node_connectivity"):
                for name in getattr(topology, attribute).split():
                    self.assertIn(name, file.variables)
            self.assertEqual(file["mesh2d_face_nodes"].start_index, 0)
            points = np.stack([file["mesh2d_node_x"][:], file["mesh2d_node_y"][:]], axis=1)
            np.testing.assert_array_equal(points, mesh["Mesh/mesh/geometry"][:])
            triangles = mesh["Mesh/mesh/topology"][:]
            np.testing.assert_array_equal(file["mesh2d_face_nodes"][:], triangles)
            centres = np.stack([file["mesh2d_face_x"][:], file["mesh2d_face_y"][:]], axis=1)
            np.testing.assert_allclose(centres, points[triangles].mean(axis=1), rtol=1e-14)
            np.testing.assert_array_equal(file["mesh2d_region"][:], mesh["VTKHDF/CellData/region"][:])
            np.testing.assert_array_equal(file["mesh2d_size"][:], mesh["VTKHDF/PointData/size"][:])
            np.testing.assert_array_equal(file["mesh2d_node_z"][:], -mesh["VTKHDF/PointData/depth"][:])
            np.testing.assert_array_equal(file["mesh2d_boundary_nodes"][:], mesh["Mesh/facets/topology"][:])
            np.testing.assert_array_equal(file["mesh2d_boundary_label"][:], mesh["Mesh/facets/labels"][:])
            self.assertEqual(file["mesh2d_region"].long_name, "region: 1 = hard, 2 = soft")

    @unittest.skipIf(netCDF4 is None, "no python3-netcdf4 here")
    def test_cells_by_netcdf(self):
        cells = CellFile(self.work / "one_cells.vtu")
        with netCDF4.Dataset(self.work / "one_cells.nc") as file, h5py.File(self.work / "one.h5") as mesh:
            points = np.stack([file["mesh2d_node_x"][:], file["mesh2d_node_y"][:]], axis=1)
            polygons = polygons_of(file)
            np.testing.assert_array_equal(points, cells.vertices)
            np.testing.assert_array_equal(points, mesh["Cells/vertices"][:])
            self.assertEqual([list(polygon) for polygon in polygons], [list(polygon) for polygon in cells.polygons])
            np.testing.assert_array_equal(np.concatenate(polygons), mesh["Cells/corners"][:])
            for name, found in (("area", cells.area), ("region", cells.region), ("site", cells.site)):
                np.testing.assert_array_equal(file[f"mesh2d_{name}"][:], found)
                np.testing.assert_array_equal(found, mesh[f"Cells/{name}s"][:])
            np.testing.assert_array_equal(file["mesh2d_face_x"][:], cells.places[:, 0])
            np.testing.assert_array_equal(file["mesh2d_face_y"][:], cells.places[:, 1])
            self.assertAlmostEqual(math.fsum(area_of(points, polygon) for polygon in polygons), 1, delta=1e-12)

    def test_equal_files_on_any_ranks_and_by_convert(self):
        for ranks in (3, 7):
            self.make(f"on{ranks}", ranks)
            for ending in (".nc", "_cells.nc"):
                self.assertEqual((self.work / f"on{ranks}{ending}").read_bytes(),
                                 (self.work / f"one{ending}").read_bytes(), ranks)
        for ending in (".nc", "_cells.nc"):
            done = run("convert", self.work / "one.h5", self.work / f"new{ending}", ranks=2)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            self.assertEqual((self.work / f"new{ending}").read_bytes(), (self.work / f"one{ending}").read_bytes())

    def test_both_by_qgis(self):
        paths = [self.work / "one.nc", self.work / "one_cells.nc"]
        done = subprocess.run([sys.executable, "-c", BY_QGIS, *map(str, paths)], capture_output=True, text=True,
                              timeout=120, check=False,
                              env=dict(os.environ, QT_QPA_PLATFORM="offscreen", HOME=str(self.work)))
        if "No module named 'qgis'" in done.stderr:
            self.skipTest("no python3-qgis here")
        self.assertEqual(done.returncode, 0, done.stderr)
        with h5py.File(self.work / "one.h5") as mesh, np.load(str(paths[0]) + ".npz") as found:
            np.testing.assert_array_equal(found["corners"], mesh["Mesh/mesh/topology"][:].ravel())
            np.testing.assert_array_equal(found["points"], mesh["Mesh/mesh/geometry"][:])
            np.testing.assert_array_equal(found["region"], mesh["VTKHDF/CellData/region"][:])
        with h5py.File(self.work / "one.h5") as mesh, np.load(str(paths[1]) + ".npz") as found:
            np.testing.assert_array_equal(found["counts"], np.diff(mesh["Cells/corner_first"][:]))
            np.testing.assert_array_equal(found["corners"], mesh["Cells/corners"][:])
            np.testing.assert_array_equal(found["region"], mesh["Cells/regions"][:])
            np.testing.assert_array_equal(found["area of the face"], mesh["Cells/areas"][:])

    def test_a_torus_is_refused(self):
        text = "[domain]\nperiodic_x = true\nperiodic_y = true\n[shape]\ngeometry = domain\n[meshing]\npoints = 200\n"
        (self.work / "torus.ini").write_text(text)
        done = run(self.work / "torus.ini", f"output.directory={self.work}", "output.name=torus",
                   "output.formats=vtkhdf xdmf ugrid")
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
        self.assertIn("a periodic container can be written as", done.stdout + done.stderr)


if __name__ == "__main__":
    unittest.main()
