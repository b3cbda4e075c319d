#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests the formats abaqus and exodus, which have sets for solvers: element sets or blocks, surfaces, sets of points.

CalculiX and VTK read the files, and so do meshio and SciPy. Areas of regions and lengths of labels are compared with
those of the HDF5 file, and CalculiX stretches a plate of two regions by a pressure on one side.
"""
import re
import subprocess
import unittest

import meshio
import numpy as np
import vtk
from vtk.util.numpy_support import vtk_to_numpy as to_numpy

from format_readers import Expected
from region_meshes import areas_of, by_number, lengths_of
from solver_readers import Exo, Inp
from trime_run import Workspace, run

BOX = """4 2 0 1
1 0.1 0.1 1
2 0.9 0.1 1
3 0.9 0.9 1
4 0.1 0.9 1
4 1
1 1 2 1
2 2 3 2
3 3 4 3
4 4 1 4
0
"""
# The shape has two regions whose names differ in upper and lower case only. A part of its curve lies on an interface.
# Its other curve is a crack.
CONFIG = """[shape]
geometry = box
rest = matrix
[shape.box]
type = contour
file = box.poly
[shape.disc]
type = circle
center = 0.6 0.5
radius = 0.15
[shape.half]
type = rectangle
x_min = 0
x_max = 1
y_min = 0
y_max = 0.5
[region.rock]
geometry = disc
[region.Rock]
geometry = half
[curve.fault]
file = fault.xy
[curve.crack]
file = crack.xy
split = true
[meshing]
points = 1500
"""
PLATE = """*INCLUDE, INPUT=plate.inp
*MATERIAL, NAME=STEEL
*ELASTIC
200, 0.25
*SOLID SECTION, ELSET=matrix, MATERIAL=STEEL
1.
*SOLID SECTION, ELSET=rock, MATERIAL=STEEL
1.
*BOUNDARY
box_4, 1
box_1, 2
*STEP
*STATIC
*DSLOAD
box_2, P, -2
*NODE PRINT, NSET=box_2
U
*EL PRINT, ELSET=rock
S
*END STEP
"""


class SolverFormats(unittest.TestCase):
    """A directory with one mesh in both formats."""

    @classmethod
    def setUpClass(cls):
        cls.space = Workspace()
        cls.work = cls.space.__enter__()
        (cls.work / "box.poly").write_text(BOX)
        (cls.work / "fault.xy").write_text("0.2 0.5\n0.35 0.5\n0.5 0.8\n")
        (cls.work / "crack.xy").write_text("0.2 0.7\n0.3 0.75\n0.3 0.9\n")
        (cls.work / "mesh.ini").write_text(CONFIG)
        done = run(cls.work / "mesh.ini", f"output.directory={cls.work}", "output.formats=vtkhdf xdmf abaqus exodus",
                   ranks=2)
        if done.returncode != 0:
            raise AssertionError(done.stdout + done.stderr)
        cls.expected = Expected(cls.work / "mesh.h5")
        cls.areas = by_number(cls.expected.region, areas_of(cls.expected.points, cls.expected.triangles))
        cls.lengths = by_number(cls.expected.labels, lengths_of(cls.expected.points, cls.expected.edges))

    @classmethod
    def tearDownClass(cls):
        cls.space.__exit__(None, None, None)

    def check_sums(self, found, wanted, delta=1e-12):
        self.assertEqual(set(found), set(wanted))
        for number, value in wanted.items():
            self.assertAlmostEqual(found[number], value, delta=delta, msg=number)

    def points_by_label(self):
        edges, labels = self.expected.edges, self.expected.labels
        return {int(label): np.unique(edges[labels == label]) for label in np.unique(labels)}

    def test_abaqus_by_a_separate_reader(self):
        """Every entry has at most 20 characters, as Abaqus demands."""
        expected, inp = self.expected, Inp(self.work / "mesh.inp")
        self.assertLessEqual(inp.longest, 20)
        self.assertEqual(inp.elements["*ELEMENT"]["TYPE"], "CPS3")
        self.assertEqual([int(row[0]) for row in inp.points], list(range(1, len(expected.points) + 1)))
        self.assertLessEqual(np.abs(inp.places() - expected.points).max(), 1e-16)
        names = {number: names for (what, number), names in inp.comments.items() if what == "region"}
        self.assertEqual({name for name, _ in names.values()}, set(expected.regions_with_triangles()))
        self.assertEqual({names[2][1], names[3][1]}, {"rock", "Rock_2"})
        blocks = {number: np.array(inp.blocks[name], dtype=int) for number, (_, name) in names.items()}
        self.assertEqual(len(inp.blocks), len(blocks))
        for number, block in blocks.items():
            np.testing.assert_array_equal(block[:, 0] - 1, np.flatnonzero(expected.region == number))
            np.testing.assert_array_equal(block[:, 1:] - 1, expected.triangles[expected.region == number])
        for (what, label), (name, made) in inp.comments.items():
            if what == "label":
                self.assertEqual(expected.parts[name], label)
                np.testing.assert_array_equal(inp.edges(made), expected.edges[expected.labels == label])
                np.testing.assert_array_equal([int(row[0]) - 1 for row in inp.nsets[made]],
                                              self.points_by_label()[label])
        for found, wanted in zip(inp.sums(), (self.areas, self.lengths)):
            self.check_sums(found, wanted)

    def test_abaqus_by_meshio(self):
        expected, mesh = self.expected, meshio.read(self.work / "mesh.inp")
        self.assertLessEqual(np.abs(mesh.points[:, :2] - expected.points).max(), 1e-16)
        self.assertEqual([block.type for block in mesh.cells], ["triangle"] * 3)
        for number, block in enumerate(mesh.cells, 1):
            np.testing.assert_array_equal(block.data, expected.triangles[expected.region == number])
        self.assertEqual(list(mesh.cell_sets), ["matrix", "rock", "Rock_2"])
        points = {name: np.asarray(numbers).tolist() for name, numbers in mesh.point_sets.items()}
        self.assertEqual(points["box_3"], self.points_by_label()[expected.parts["box.3"]].tolist())

    def test_calculix_stretches_a_plate(self):
        """Plane stress with a pressure on one side: displacements and stresses are exact."""
        (self.work / "plate.ini").write_text(CONFIG[:CONFIG.index("[region.Rock]")] + "[meshing]\npoints = 300\n")
        done = run(self.work / "plate.ini", f"output.directory={self.work}", "output.formats=abaqus", ranks=3)
        self.assertEqual(done.returncode, 0, done.stderr)
        (self.work / "job.inp").write_text(PLATE)
        done = subprocess.run(["ccx", "job"], cwd=self.work, capture_output=True, text=True, timeout=120, check=False)
        self.assertNotIn("*ERROR", done.stdout)
        self.assertEqual(done.returncode, 0, done.stdout)
        rows = [line.split() for line in (self.work / "job.dat").read_text().splitlines() if re.match(r" +\d", line)]
        moved = np.array([row for row in rows if len(row) == 4], dtype=float)
        stress = np.array([row for row in rows if len(row) == 8], dtype=float)[:, 2:]
        self.assertGreater(len(moved), 5)
        np.testing.assert_allclose(moved[:, 1], 2 / 200 * 0.8, rtol=1e-5)
        np.testing.assert_allclose(stress, np.broadcast_to([2, 0, 0, 0, 0, 0], stress.shape), atol=1e-5)

    def test_exodus_by_scipy(self):
        expected, exo = self.expected, Exo(self.work / "mesh.exo")
        self.assertEqual((exo.version, exo.word_size), (2, 8))
        np.testing.assert_array_equal(exo.points, expected.points)
        self.assertEqual(dict(zip(exo.names["eb"], exo.regions)), expected.regions_with_triangles())
        order = exo.arrays["elem_num_map"] - 1
        np.testing.assert_array_equal(exo.triangles, expected.triangles[order])
        np.testing.assert_array_equal(order, np.argsort(expected.region, kind="stable"))
        self.assertEqual(dict(zip(exo.names["ss"], exo.labels)), expected.parts_with_edges())
        self.assertEqual(exo.names["ss"], exo.names["ns"])
        for label, edges in exo.edges.items():
            np.testing.assert_array_equal(edges, expected.edges[expected.labels == label])
            np.testing.assert_array_equal(exo.nodes[label], self.points_by_label()[label])
        for found, wanted in zip(exo.sums(), (self.areas, self.lengths)):
            self.check_sums(found, wanted)

    def test_exodus_by_vtk(self):
        """VTK uses the library of Exodus II itself. It makes coordinates of 32 bits."""
        reader = vtk.vtkExodusIIReader()
        reader.SetFileName(str(self.work / "mesh.exo"))
        reader.UpdateInformation()
        for kind in (reader.ELEM_BLOCK, reader.SIDE_SET, reader.NODE_SET):
            for k in range(reader.GetNumberOfObjects(kind)):
                reader.SetObjectStatus(kind, k, 1)
        reader.Update()
        self.assertEqual(reader.GetNumberOfNodes(), len(self.expected.points))
        areas, lengths = {}, {}
        for kind, sums, measure in ((reader.ELEM_BLOCK, areas, areas_of), (reader.SIDE_SET, lengths, lengths_of)):
            group = reader.GetOutput().GetBlock({reader.ELEM_BLOCK: 0, reader.SIDE_SET: 4}[kind])
            self.assertEqual(group.GetNumberOfBlocks(), reader.GetNumberOfObjects(kind))
            for k in range(group.GetNumberOfBlocks()):
                grid = group.GetBlock(k)
                corners = to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 3 if sums is areas else 2)
                points = to_numpy(grid.GetPoints().GetData())[:, :2]
                numbers = self.expected.regions if sums is areas else self.expected.parts
                sums[numbers[reader.GetObjectName(kind, k)]] = float(measure(points, corners).sum(dtype=float))
        self.check_sums(areas, self.areas, 1e-6)
        self.check_sums(lengths, self.lengths, 1e-6)


if __name__ == "__main__":
    unittest.main()
