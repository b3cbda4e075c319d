#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests the mesh in the formats of other programs.

Those programs read the same points, triangles, labels and names as the HDF5 file has. A run and `trime_mpi convert`
give the same bytes on any number of ranks.
"""
import json
import os
import shutil
import subprocess
import sys
import unittest
from xml.etree import ElementTree

import gmsh
import h5py
import meshio
import numpy as np
import vtk
from osgeo import ogr
from vtk.util.numpy_support import vtk_to_numpy as to_numpy

from format_readers import BY_DOLFINX, BY_FREEFEM, BY_QGIS, Expected, in_order, rows, with_name
from trime_run import MPIEXEC, ROOT, Workspace, run

ogr.UseExceptions()

WORDS = "gmsh gmsh2 medit freefem triangle vtu 2dm fort14 geojson abaqus exodus"
ENDINGS = ["msh", "msh2", "mesh", "freefem", "node", "vtu", "2dm", "14", "geojson", "inp", "exo"]
OWN = """[shape]
geometry = difference(union(open_sea, bay, sunk), island)
[shape.open_sea]
type = rectangle
x_min = 0.1
x_max = 0.6
y_min = 0.1
y_max = 0.9
[shape.bay]
type = rectangle
x_min = 0.5
x_max = 0.9
y_min = 0.3
y_max = 0.7
[shape.island]
type = circle
center = 0.7 0.5
radius = 0.1
[shape.sunk]
; no edge follows it
type = circle
center = 0.3 0.3
radius = 0.1
[meshing]
points = 1500
"""
# No triangle belongs to the rest. A part of the curve lies on an interface.
LAYERS = """[shape]
geometry = difference(box, hole)
rest = nothing
[shape.box]
type = rectangle
x_min = 0.1
x_max = 0.9
y_min = 0.1
y_max = 0.9
[shape.hole]
type = circle
center = 0.3 0.3
radius = 0.08
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
[region.lens]
geometry = disc
[region.low]
geometry = half
[region.top]
geometry = domain
[curve.fault]
file = fault.xy
[meshing]
points = 1500
"""
USAGE, FILE = 2, 4


class Formats(unittest.TestCase):
    """A directory with one mesh in all formats for each of three shapes, made once."""

    @classmethod
    def setUpClass(cls):
        cls.space = Workspace()
        cls.work = cls.space.__enter__()
        (cls.work / "own.ini").write_text(OWN)
        (cls.work / "layers.ini").write_text(LAYERS)
        (cls.work / "fault.xy").write_text("0.2 0.5\n0.35 0.5\n0.5 0.8\n")
        cls.expected = {}
        for config in (cls.work / "own.ini", ROOT / "configs" / "spade.ini", cls.work / "layers.ini"):
            done = run(config, f"output.directory={cls.work}", f"output.formats=vtkhdf xdmf {WORDS}",
                       "meshing.points=1500", ranks=2)
            if done.returncode != 0:
                raise AssertionError(done.stdout + done.stderr)
            cls.expected[config.stem] = Expected(cls.work / f"{config.stem}.h5")

    @classmethod
    def tearDownClass(cls):
        cls.space.__exit__()

    def each(self, ending):
        """Path and expected content of each file of a format."""
        return [(self.work / f"{stem}.{ending}", expected) for stem, expected in self.expected.items()]

    def check_meshio(self, mesh, expected, label, region):
        self.assertLessEqual(np.abs(mesh.points[:, :2] - expected.points).max(), 1e-15)
        lines = [k for k, block in enumerate(mesh.cells) if block.type == "line"]
        self.assertEqual(rows(np.vstack([mesh.cells[k].data for k in lines]),
                              np.concatenate([mesh.cell_data[label][k] for k in lines])), expected.edge_rows())
        triangles = [k for k, block in enumerate(mesh.cells) if block.type == "triangle"]
        self.assertEqual(rows(np.vstack([mesh.cells[k].data for k in triangles]),
                              np.concatenate([mesh.cell_data[region][k] for k in triangles])),
                         rows(expected.triangles, expected.region))

    def test_gmsh_formats_by_meshio(self):
        for ending in ("msh", "msh2"):
            for path, expected in self.each(ending):
                with self.subTest(file=path.name):
                    mesh = meshio.read(path, file_format="gmsh")
                    self.check_meshio(mesh, expected, "gmsh:physical", "gmsh:physical")
                    found = {name: tuple(value) for name, value in mesh.field_data.items()}
                    wanted = {name: (number, 1) for name, number in expected.parts_with_edges().items()}
                    regions = expected.regions_with_triangles()
                    self.assertEqual(found, wanted | {name: (number, 2) for name, number in regions.items()})

    def test_gmsh_formats_by_gmsh(self):
        gmsh.initialize()
        self.addCleanup(gmsh.finalize)
        gmsh.option.setNumber("General.Terminal", 0)
        for ending in ("msh", "msh2"):
            for path, expected in self.each(ending):
                with self.subTest(file=path.name):
                    gmsh.open(str(path))
                    groups = gmsh.model.getPhysicalGroups()
                    names = {(gmsh.model.getPhysicalName(*group), *group) for group in groups}
                    parts = expected.parts_with_edges().items()
                    regions = expected.regions_with_triangles().items()
                    self.assertEqual(names, {(name, 1, number) for name, number in parts} |
                                     {(name, 2, number) for name, number in regions})
                    tags, places, _ = gmsh.model.mesh.getNodes()
                    places = places.reshape(-1, 3)[np.argsort(tags), :2]
                    self.assertLessEqual(np.abs(places - expected.points).max(), 1e-15)
                    for _, number in regions:
                        self.assertEqual(self.of_group(2, number).tolist(),
                                         expected.triangles[expected.region == number].tolist())
                    for label in expected.parts_with_edges().values():
                        wanted = expected.edges[expected.labels == label]
                        self.assertEqual(sorted(self.of_group(1, label).tolist()), sorted(wanted.tolist()))
                    gmsh.clear()

    def of_group(self, dimension, number):
        """The elements of a physical group of the open model, as rows of points from 0."""
        found = [gmsh.model.mesh.getElements(dimension, entity)[2][0].reshape(-1, dimension + 1)
                 for entity in gmsh.model.getEntitiesForPhysicalGroup(dimension, number)]
        return np.vstack(found).astype(int) - 1 if found else np.empty((0, dimension + 1), int)

    def test_gmsh_and_xdmf_by_dolfinx(self):
        """Mesh and mesh tags, on 1 and 2 ranks: points, triangles, and the middle of each edge with its label."""
        environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                           XDG_CACHE_HOME=str(self.work), OMP_NUM_THREADS="1")
        for ranks in (1, 2):
            start = [] if ranks == 1 else [MPIEXEC, "-np", str(ranks)]
            done = subprocess.run([*start, sys.executable, "-c", BY_DOLFINX,
                                   *[self.work / stem for stem in self.expected]],
                                  env=environment, capture_output=True, text=True, timeout=300, check=False)
            self.assertEqual(done.returncode, 0, done.stderr)
            for stem, expected in self.expected.items():
                for ending in ("msh", "xdmf"):
                    with self.subTest(stem=stem, ranks=ranks, ending=ending), np.load(
                            self.work / f"{stem}.{ending}.npz") as found:
                        self.assertEqual(len(found["points"]), len(expected.points))
                        self.assertLessEqual(np.abs(in_order(found["points"]) - in_order(expected.points)).max(), 1e-15)
                        middles = expected.points[expected.triangles].mean(axis=1)
                        np.testing.assert_allclose(in_order(found["triangles"]), in_order(middles), atol=1e-15)
                        middles = expected.points[expected.edges].mean(axis=1)
                        wanted = in_order(np.column_stack([middles, expected.labels]))
                        np.testing.assert_allclose(in_order(found["edges"]), wanted, atol=1e-15)
                        if ending == "msh" or stem == "layers":
                            middles = expected.points[expected.triangles].mean(axis=1)
                            wanted = in_order(np.column_stack([middles, expected.region]))
                            np.testing.assert_allclose(in_order(found["regions"]), wanted, atol=1e-15)

    def test_xdmf_facets_by_meshio(self):
        for stem, expected in self.expected.items():
            mesh = meshio.read(self.work / f"{stem}.xmf")
            self.assertEqual(rows(mesh.cells[0].data, mesh.cell_data["labels"][0]), expected.edge_rows())
            self.assertLessEqual(np.abs(mesh.points[:, :2] - expected.points).max(), 1e-15)

    def test_geojson_by_gdal(self):
        """Without a reference system the coordinates are those of the mesh."""
        for path, expected in self.each("geojson"):
            with self.subTest(file=path.name):
                source = ogr.Open(str(path))
                layer = source.GetLayer(0)
                self.assertEqual(layer.GetFeatureCount(), len(expected.triangles) + len(expected.edges))
                corners, ends, labels, regions, names = [], [], [], [], {}
                for number, feature in enumerate(layer):
                    shape, kind = feature.GetGeometryRef(), feature["kind"]
                    if kind == "triangle":
                        self.assertEqual(feature["number"], number)
                        corners.append(shape.GetGeometryRef(0).GetPoints(2))
                        regions.append((feature["name"], feature["region"]))
                    else:
                        self.assertEqual((kind, feature["number"]), ("edge", number - len(expected.triangles)))
                        ends.append(shape.GetPoints(2))
                        labels.append(feature["label"])
                        names[feature["name"]] = feature["label"]
                np.testing.assert_allclose(np.array(corners)[:, :3], expected.points[expected.triangles], rtol=1e-15)
                np.testing.assert_array_equal(np.array(corners)[:, 3], np.array(corners)[:, 0])
                np.testing.assert_allclose(np.array(ends), expected.points[expected.edges], rtol=1e-15)
                np.testing.assert_array_equal(labels, expected.labels)
                self.assertEqual(names, {name: label for name, label in expected.parts.items() if label in labels})
                self.assertEqual(set(regions), set(expected.regions_with_triangles().items()))
                np.testing.assert_array_equal([number for _, number in regions], expected.region)

    def test_medit_by_meshio(self):
        for path, expected in self.each("mesh"):
            with self.subTest(file=path.name):
                mesh = meshio.read(path)
                self.check_meshio(mesh, expected, "medit:ref", "medit:ref")
                np.testing.assert_array_equal(mesh.point_data["medit:ref"], expected.point_labels())
                lines = path.read_text().splitlines()
                self.assertEqual(with_name("edges", lines), expected.parts)
                self.assertEqual(with_name("triangles", lines), expected.regions)

    def test_freefem_and_medit_by_freefem(self):
        """All numbers as FreeFEM++ has them, and its integral along each label."""
        script, files = "cout.precision(17);\n", self.each("freefem") + self.each("mesh")
        for path, expected in files:
            read = f'= readmesh("{path}")' if path.suffix == ".mesh" else f'("{path}")'
            labels = str(sorted(expected.parts.values()))
            script += BY_FREEFEM.replace("READ", read).replace("FILE", str(path)).replace("LABELS", labels)
        (self.work / "read.edp").write_text(script)
        done = subprocess.run(["FreeFem++", "-nw", "-v", "0", self.work / "read.edp"], capture_output=True, text=True,
                              timeout=120, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        for path, expected in files:
            with self.subTest(file=path.name):
                found = {}
                text = done.stdout[done.stdout.index(f"file {path}\n"):]
                for line in text[:text.index("\nend")].splitlines()[1:]:
                    word, *numbers = line.split()
                    found.setdefault(word, []).append([float(number) for number in numbers])
                found = {word: np.array(numbers) for word, numbers in found.items()}
                self.assertLessEqual(np.abs(found["vertex"][:, :2] - expected.points).max(), 1e-15)
                np.testing.assert_array_equal(found["vertex"][:, 2], expected.point_labels())
                np.testing.assert_array_equal(found["triangle"][:, :3], expected.triangles)
                np.testing.assert_array_equal(found["triangle"][:, 3], expected.region)
                edges = found["edge"].astype(int)
                self.assertEqual(rows(np.sort(edges[:, :2]), edges[:, 2]),
                                 rows(np.sort(expected.edges), expected.labels))
                lengths = [expected.length(label) for label in sorted(expected.parts.values())]
                np.testing.assert_allclose(found["length"][:, 0], lengths, rtol=1e-12)

    def test_triangle_files(self):
        for path, expected in self.each("node"):
            with self.subTest(file=path.name):
                lines = path.read_text().splitlines()
                self.assertEqual(lines[0].split(), [str(len(expected.points)), "2", "0", "1"])
                self.assertEqual(with_name("marker", lines), expected.parts)
                table = np.loadtxt(path, skiprows=1)
                np.testing.assert_array_equal(table[:, 0], np.arange(1, len(expected.points) + 1))
                np.testing.assert_array_equal(table[:, 1:3], expected.points)
                np.testing.assert_array_equal(table[:, 3], expected.point_labels())
                table = np.loadtxt(path.with_suffix(".ele"), skiprows=1, dtype=int)
                np.testing.assert_array_equal(table[:, 1:4], expected.triangles + 1)
                np.testing.assert_array_equal(table[:, 4], expected.region)
                lines = path.with_suffix(".ele").read_text().splitlines()
                self.assertEqual(with_name("region", lines), expected.regions)
                table = np.loadtxt(path.with_suffix(".edge"), skiprows=1, dtype=int)
                edges = len(expected.points) + len(expected.triangles) - (1 - expected.holes)  # Euler's formula
                self.assertEqual(len(table), edges)
                np.testing.assert_array_equal(table[:, 0], np.arange(1, edges + 1))
                on_rim = table[:, 3] > 0
                self.assertEqual(rows(table[on_rim, 1:3] - 1, table[on_rim, 3]), expected.edge_rows())
                sides = expected.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
                self.assertEqual(set(map(tuple, np.sort(table[:, 1:3] - 1).tolist())),
                                 set(map(tuple, np.sort(sides).tolist())))
                self.assertFalse(np.any(table[~on_rim, 3]))

    def test_triangle_files_by_dolfin(self):
        """The converter of FEniCS before dolfinx: points, triangles, and the marker of each side of each triangle."""
        for path, expected in self.each("node"):
            with self.subTest(file=path.name):
                target = path.with_suffix(".xml")
                done = subprocess.run(["dolfin-convert", path, target], text=True,
                                      capture_output=True, timeout=60, check=False)
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                tree = ElementTree.parse(target)
                points = [[float(vertex.get(axis)) for axis in "xy"] for vertex in tree.iter("vertex")]
                self.assertLessEqual(np.abs(np.array(points) - expected.points).max(), 1e-15)
                corners = np.array([[int(cell.get(f"v{k}")) for k in range(3)] for cell in tree.iter("triangle")])
                np.testing.assert_array_equal(corners, np.sort(expected.triangles))
                marked = np.array([[int(value.get(name)) for name in ("cell_index", "local_entity", "value")]
                                   for value in tree.iter("value")])
                self.assertEqual(len(marked), 3 * len(corners))
                opposite = np.array([[1, 2], [0, 2], [0, 1]])  # corners of each side
                sides = corners[marked[:, 0][:, None], opposite[marked[:, 1]]]
                has_label = marked[:, 2] > 0
                found = set(rows(sides[has_label], marked[has_label, 2]))  # edges inside have two triangles
                self.assertEqual(sorted(found), rows(np.sort(expected.edges), expected.labels))
                regions = ElementTree.parse(path.with_suffix(".attr0.xml"))
                self.assertEqual([float(value.get("value")) for value in regions.iter("value")],
                                 expected.region.tolist())

    def test_vtu_by_meshio_and_vtk(self):
        for path, expected in self.each("vtu"):
            with self.subTest(file=path.name):
                mesh = meshio.read(path)
                self.check_meshio(mesh, expected, "label", "region")
                np.testing.assert_array_equal(mesh.point_data["label"], expected.point_labels())
                reader = vtk.vtkXMLUnstructuredGridReader()
                reader.SetFileName(str(path))
                reader.Update()
                grid = reader.GetOutput()
                self.assertLessEqual(np.abs(to_numpy(grid.GetPoints().GetData())[:, :2] - expected.points).max(), 1e-15)
                corners = to_numpy(grid.GetCells().GetConnectivityArray())
                ends = to_numpy(grid.GetCells().GetOffsetsArray())
                labels = to_numpy(grid.GetCellData().GetArray("label"))
                sides = np.diff(ends)
                first = {count: ends[:-1][sides == count] for count in (2, 3)}
                self.assertEqual(len(sides), len(first[2]) + len(first[3]))
                np.testing.assert_array_equal(np.column_stack([corners[first[3] + k] for k in range(3)]),
                                              expected.triangles)
                self.assertEqual(rows(np.column_stack([corners[first[2] + k] for k in range(2)]), labels[sides == 2]),
                                 expected.edge_rows())
                for kind, names in (("label", expected.parts), ("region", expected.regions)):
                    for name, number in names.items():
                        self.assertEqual(grid.GetFieldData().GetArray(f"{kind} {name}").GetValue(0), number)

    def test_2dm(self):
        for path, expected in self.each("2dm"):
            with self.subTest(file=path.name):
                lines = path.read_text().splitlines()
                cards = {card: [line.split()[1:] for line in lines if line.startswith(card + " ")]
                         for card in ("E3T", "ND", "NS")}
                table = np.array(cards["E3T"], dtype=int)
                np.testing.assert_array_equal(table[:, 1:4], expected.triangles + 1)
                np.testing.assert_array_equal(table[:, 4], expected.region)
                np.testing.assert_array_equal(np.array(cards["ND"], dtype=float)[:, 1:3], expected.points)
                edges, labels, string = [], [], []
                for words in cards["NS"]:
                    numbers = [int(word) for word in words]
                    last = next((k for k, number in enumerate(numbers) if number < 0), None)
                    string += numbers if last is None else numbers[:last] + [-numbers[last]]
                    if last is not None:
                        edges += list(zip(string, string[1:]))
                        labels += [numbers[last + 1]] * (len(string) - 1)
                        string = []
                self.assertEqual(rows(np.array(edges) - 1, labels), expected.rim_rows())
                for name, number in expected.rim_parts.items():
                    self.assertIn(f"node string {number}: {name}", lines[1])
                if path.stem == "layers":
                    self.assertIn("material 3: low", lines[1])

    def test_2dm_by_qgis(self):
        """Points and triangles; QGIS keeps no node strings."""
        names = [str(path) for path, _ in self.each("2dm")]
        done = subprocess.run([sys.executable, "-c", BY_QGIS, *names], capture_output=True, text=True, timeout=120,
                              env=dict(os.environ, QT_QPA_PLATFORM="offscreen", HOME=str(self.work)), check=False)
        if "No module named 'qgis'" in done.stderr:
            self.skipTest("no python3-qgis here")
        self.assertEqual(done.returncode, 0, done.stderr)
        for path, expected in self.each("2dm"):
            with self.subTest(file=path.name), np.load(path.with_suffix(".2dm.npz")) as found:
                self.assertLessEqual(np.abs(found["points"] - expected.points).max(), 1e-15)
                np.testing.assert_array_equal(found["triangles"], expected.triangles)

    def test_fort14(self):
        for path, expected in self.each("14"):
            with self.subTest(file=path.name):
                lines = path.read_text().splitlines()
                points, triangles = len(expected.points), len(expected.triangles)
                self.assertEqual([int(word) for word in lines[1].split()], [triangles, points])
                table = np.array([line.split() for line in lines[2:2 + points]], dtype=float)
                np.testing.assert_array_equal(table[:, 1:3], expected.points)
                table = np.array([line.split() for line in lines[2 + points:2 + points + triangles]], dtype=int)
                np.testing.assert_array_equal(table[:, 2:], expected.triangles + 1)
                rest, edges, labels, kinds = iter(lines[2 + points + triangles:]), [], [], {}
                for kind in ("open", "land"):
                    segments, total = int(next(rest).split()[0]), int(next(rest).split()[0])
                    for _ in range(segments):
                        head, name = next(rest).split(" = ")
                        words = head.split()
                        string = [int(next(rest)) for _ in range(int(words[0]))]
                        total -= len(string)
                        edges += list(zip(string, string[1:]))
                        labels += [expected.parts[name]] * (len(string) - 1)
                        kinds.setdefault(name, set()).add(kind if kind == "open" else int(words[1]))
                    self.assertEqual(total, 0)
                self.assertEqual(rows(np.array(edges) - 1, labels), expected.rim_rows())
                self.assertEqual(kinds, {"own": {"open_sea": {"open"}, "bay": {20}, "island": {21}},
                                         "spade": {"spade": {20}, "hole": {21}},
                                         "layers": {"box": {20}, "hole": {21}}}[path.stem])

    def open_and_land(self, path):
        """Names of the open and of the land boundaries of a fort.14."""
        head, land = path.read_text().split(" = land boundaries")
        return [{line.split(" = ")[1] for line in text.splitlines() if " = " in line and not line.endswith("boundaries")
                 and not line.endswith("points on them")} for text in (head, land)]

    def test_open_boundary(self):
        """The names that the user gives decide; convert finds them in the mesh file."""
        work = self.work / "open"
        for names, wanted in (("bay", {"bay"}), (" island ,bay", {"bay", "island"}), ("none", set()),
                              ("auto", {"open_sea"})):
            with self.subTest(names=names):
                done = run(self.work / "own.ini", f"output.directory={work}", "output.formats=fort14",
                           "output.overwrite=true", f"output.open_boundary={names}", ranks=2)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertEqual(self.open_and_land(work / "own.14"), [wanted, {"open_sea", "bay", "island"} - wanted])
                said = ", ".join(name for name in ("open_sea", "bay", "island") if name in wanted) or "none"
                self.assertIn(f"open boundary: {said}; land boundary: ", done.stdout)
                done = run("convert", work / "own.h5", work / "again.14", "--overwrite")
                self.assertEqual(done.returncode, 0, done.stderr)
                lines = [path.read_text().splitlines()[1:] for path in (work / "own.14", work / "again.14")]
                self.assertEqual(*lines)
        done = run(self.work / "own.ini", "output.open_boundary=bay, ilsand", "--validate", ranks=3)
        self.assertEqual(done.returncode, USAGE, done.stderr)
        self.assertRegex(done.stderr, r"open_boundary: no part .* the name 'ilsand'; did you mean 'island'\?; "
                                      "the names are open_sea, bay, island, sunk")

    def test_words_of_a_map_that_open_a_boundary(self):
        """Only whole words behind the dot do, unless the key names the text before the dot."""
        lines = [([[5, 60], [5.4, 60]], "Open Sea"), ([[5.4, 60], [5.4, 60.2]], "Chelsea"),
                 ([[5.4, 60.2], [5, 60.2], [5, 60]], "land")]
        (self.work / "sea.geojson").write_text(json.dumps({"type": "FeatureCollection", "features": [
            {"type": "Feature", "properties": {"kind": kind}, "geometry": {"type": "LineString", "coordinates": line}}
            for line, kind in lines]}))
        (self.work / "sea.ini").write_text(
            "[shape]\ngeometry = sea\nprojection = auto\n[shape.sea]\ntype = contour\nfile = sea.geojson\n"
            f"attribute = kind\n[meshing]\npoints = 300\n[output]\ndirectory = {self.work}\noverwrite = true\n")
        all_names = {"sea.Open Sea", "sea.Chelsea", "sea.land"}
        for more, wanted in (([], {"sea.Open Sea"}), (["output.open_boundary=land"], {"sea.land"}),
                             (["output.open_boundary=sea"], all_names)):
            done = run(self.work / "sea.ini", "output.formats=fort14 2dm", *more)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(self.open_and_land(self.work / "sea.14"), [wanted, all_names - wanted])
        done = run(self.work / "sea.ini", "output.formats=fort14 2dm", "output.coordinates=degrees",
                   "output.open_boundary=sea", "output.name=degrees", ranks=3)
        self.assertEqual(done.returncode, 0, done.stderr)
        text = {ending: (self.work / f"degrees.{ending}").read_text().splitlines() for ending in ("14", "2dm")}
        count = int(text["14"][1].split()[1])
        places = [np.array([line.split()[1:3] for line in text["14"][2:2 + count]], dtype=float),
                  np.array([line.split()[2:4] for line in text["2dm"] if line.startswith("ND ")], dtype=float)]
        np.testing.assert_array_equal(*places)
        for corner in ([5, 60], [5.4, 60], [5.4, 60.2], [5, 60.2]):
            self.assertLess(np.abs(places[0] - corner).max(axis=1).min(), 1e-9)
        for ending in ("14", "2dm"):
            done = run("convert", self.work / "sea.h5", self.work / f"again.{ending}", "--degrees", ranks=2)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual((self.work / f"again.{ending}").read_text().splitlines()[1:], text[ending][1:])

    def test_degrees_need_a_reference_system(self):
        for arguments in ([self.work / "own.ini", "--validate", "output.coordinates=degrees"],
                          ["convert", self.work / "own.h5", self.work / "none.14", "--degrees"]):
            done = run(*arguments, ranks=3)
            self.assertEqual(done.returncode, USAGE, done.stderr)
            self.assertRegex(done.stderr, r"'coordinates = degrees' needs .* 'projection = auto' in \[shape\]")

    def test_a_region_and_a_part_of_one_name(self):
        """meshio keeps one group of a name."""
        (self.work / "disc.ini").write_text("[shape]\ngeometry = disc\n[shape.disc]\ntype = circle\n"
                                            "center = 0.5 0.5\nradius = 0.4\n[meshing]\npoints = 200\n")
        done = run(self.work / "disc.ini", f"output.directory={self.work}", "output.formats=gmsh gmsh2")
        self.assertEqual(done.returncode, 0, done.stderr)
        for ending in ("msh", "msh2"):
            mesh = meshio.read(self.work / f"disc.{ending}", file_format="gmsh")
            found = {name: tuple(value) for name, value in mesh.field_data.items()}
            self.assertEqual(found, {"disc": (1, 1), "region disc": (1, 2)})

    def test_convert_makes_the_same_bytes_on_any_ranks(self):
        """The runs had 2 ranks."""
        for stem, ranks, endings in (("own", 3, ENDINGS), ("spade", 1, ["node", "14", "geojson"]),
                                     ("layers", 3, ["msh", "mesh", "node", "vtu", "inp", "exo"])):
            target = self.work / f"on_{ranks}"
            target.mkdir(exist_ok=True)
            for ending in endings:
                done = run("convert", self.work / f"{stem}.h5", target / f"{stem}.{ending}", ranks=ranks)
                self.assertEqual(done.returncode, 0, done.stderr)
            paths = list(target.glob(f"{stem}.*"))
            self.assertEqual(len(paths), len(endings) + 2)  # .ele and .edge belong to .node
            for path in paths:
                self.assertEqual(path.read_bytes(), (self.work / path.name).read_bytes(), path)

    def test_convert_without_the_plain_arrays(self):
        done = run(self.work / "own.ini", f"output.directory={self.work / 'vtk'}", "output.formats=vtkhdf")
        self.assertEqual(done.returncode, 0, done.stderr)
        done = run("convert", self.work / "vtk" / "own.h5", self.work / "vtk" / "own.msh", ranks=2)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((self.work / "vtk" / "own.msh").read_bytes(), (self.work / "own.msh").read_bytes())

    def test_bad_use(self):
        damaged, plain = self.work / "damaged.h5", self.work / "plain.h5"
        damaged.write_bytes((self.work / "own.h5").read_bytes())
        with h5py.File(damaged, "a") as file:
            file["/Mesh/mesh/geometry"][7, 0] += 1e-3
        with h5py.File(plain, "w") as file:
            file["x"] = [1]
        (self.work / "text.h5").write_text("no mesh\n")
        own = self.work / "own.h5"
        cases = [(["convert", own], USAGE, r"needs two files, found 1 file; usage: .*convert IN.h5 OUT.ENDING"),
                 (["convert", own, self.work / "a.stl"], USAGE,
                  r"the ending of '.*a\.stl' is not that of a format: .* \.msh \(gmsh\)"),
                 (["convert", own, self.work / "own.msh"], FILE, r"own\.msh exists; add --overwrite"),
                 (["convert", self.work / "none.h5", self.work / "a.msh"], FILE, r"cannot open .*none\.h5: No such"),
                 (["convert", self.work / "text.h5", self.work / "a.msh"], FILE,
                  r"cannot read .*text\.h5: expected a mesh file"),
                 (["convert", plain, self.work / "a.msh"], FILE, r"plain\.h5 is not a mesh file of trime_mpi"),
                 (["convert", damaged, self.work / "a.msh"], FILE, r"damaged\.h5 was changed after it was written"),
                 (["convert", own, self.work / "no" / "a.msh"], FILE, r"cannot create .*no/a\.msh"),
                 (["info"], USAGE, r"'trime_mpi info' needs one file, found 0 files"),
                 (["info", self.work / "own.xdmf"], FILE, r"it only describes a mesh file .* open .*own\.h5"),
                 ([self.work / "own.ini", "--degrees"], USAGE, r"'--degrees' belongs to 'trime_mpi convert'"),
                 ([self.work / "own.ini", "--all"], USAGE, r"'--all' belongs to 'trime_mpi info'"),
                 (["info", plain], FILE, r"is not a mesh file"),
                 ([self.work / "own.ini", "--overwrite"], USAGE, r"'--overwrite' belongs to 'trime_mpi convert'"),
                 ([self.work / "own.ini", f"output.directory={self.work}", "output.formats=gmsh", "output.name=own",
                   "output.overwrite=false"], FILE, r"own\.(h5|msh) exists"),
                 ([ROOT / "configs" / "torus.ini", "output.formats=gmsh"], USAGE, r"'formats = gmsh' .* periodic")]
        for arguments, code, message in cases:
            with self.subTest(arguments=[str(word) for word in arguments]):
                done = run(*arguments, ranks=3, cwd=self.work)
                self.assertEqual(done.returncode, code, done.stdout + done.stderr)
                self.assertRegex(done.stderr, message)
        self.assertEqual(run(*cases[1][0]).returncode, cases[1][1])
        self.assertFalse((self.work / "a.msh").exists())

    def test_periodic_meshes_are_refused(self):
        done = run(ROOT / "configs" / "torus.ini", f"output.directory={self.work}")
        self.assertEqual(done.returncode, 0, done.stderr)
        done = run("convert", self.work / "torus.h5", self.work / "torus.vtu")
        self.assertEqual(done.returncode, USAGE)
        self.assertRegex(done.stderr, r"the format 'vtu' cannot hold a periodic mesh")

    def test_info(self):
        done = run("info", self.work / "own.h5", ranks=2)
        self.assertEqual(done.returncode, 0, done.stderr)
        expected = self.expected["own"]
        self.assertIn(f"{len(expected.points)} points, {len(expected.triangles)} triangles", done.stdout)
        for words in (r"island +hole +1 ", r"open_sea|bay +outer", "1 open_sea, 2 bay, 3 island",
                      r"all \d+ checks passed", r"mesh hash +[0-9a-f]{16}", "smallest angle"):
            self.assertRegex(done.stdout, words)

    def with_table_of_regions(self):
        """The path of a copy of the mesh with regions that has the table of the regions."""
        path = self.work / "table.h5"
        shutil.copyfile(self.work / "layers.h5", path)
        with h5py.File(path, "r+") as file:
            about, region = file["trime_mpi"], file["VTKHDF/CellData/region"][:]
            if "regions" not in about:
                names = about["tags/region_name"]
                about.create_group("regions")
                columns = {"region_id": np.arange(1, 5, dtype=np.int32), "region_name": names[:].astype(names.dtype),
                           "triangles": np.bincount(region, minlength=5)[1:], "area": np.array([0, 0.25, 0.125, 0.5]),
                           "given_area": np.array([0, 0.25, 0.125, 0.5])}
                for name, values in columns.items():
                    about["regions"].create_dataset(name, data=values)
        return path

    def test_the_table_of_regions(self):
        """`info` prints it, and the refined mesh has four times as many triangles in the same areas."""
        path, fine = self.with_table_of_regions(), self.work / "fine_table.h5"
        done = run("refine", path, fine, ranks=2)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        expected = self.expected["layers"]
        for file, factor in ((path, 1), (fine, 4)):
            text = run("info", file).stdout
            for name, number in expected.regions.items():
                count = factor * int((expected.region == number).sum())
                self.assertRegex(text, rf"\n{name} +{number} +{count}  [0-9.]+\n")
        with h5py.File(fine) as file:
            areas = file["trime_mpi/regions/area"][:]
            corners = file["Mesh/mesh/geometry"][:][file["Mesh/mesh/topology"][:]]
            sides = corners[:, 1:] - corners[:, :1]
            each = (sides[:, 0, 0] * sides[:, 1, 1] - sides[:, 0, 1] * sides[:, 1, 0]) / 2
            found = np.bincount(file["VTKHDF/CellData/region"], each, minlength=5)[1:]
            np.testing.assert_allclose(areas, found, rtol=1e-12, atol=1e-15)

    def test_info_of_regions(self):
        done = run("info", self.work / "layers.h5")
        self.assertEqual(done.returncode, 0, done.stderr)
        labels = self.expected["layers"].parts
        for name in ("fault", "lens|low", "lens|top", "low|top"):
            self.assertRegex(done.stdout, rf"labels of edges inside in other formats:.* {labels[name]} {name}".replace(
                "|", "[|]"))
        for name, number in self.expected["layers"].regions.items():
            self.assertRegex(done.stdout, rf"\n{name} +{number}\b")

    def test_regions_by_python(self):
        """Names of regions, curves and interfaces in the Python package."""
        sys.path.insert(0, str(ROOT / "scripts" / "python"))
        import trime_mpi  # pylint: disable=import-outside-toplevel
        expected = self.expected["layers"]
        for in_place in (False, True):
            mesh = trime_mpi.read(self.work / "layers.h5", in_place=in_place)
            self.assertEqual(set(mesh.interfaces), {"lens|low", "lens|top", "low|top"})
            self.assertEqual(set(mesh.curves), {"fault"})
            low = mesh.in_region("low")
            np.testing.assert_array_equal(low, expected.region == expected.regions["low"])
            np.testing.assert_array_equal(mesh.in_region(["low", "top", "nothing"]), mesh.region != 2)
            edge = mesh.interfaces["low|top"]
            self.assertEqual((edge.left, edge.right), ("low", "top"))
            self.assertEqual(edge.label, expected.parts["low|top"])
            sides = {tuple(side) for side in mesh.triangles[low][:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2).tolist()}
            self.assertLessEqual({tuple(ends) for ends in edge.edges.tolist()}, sides, "low is on the left")
            self.assertLess(abs(mesh.points[edge.vertices][:, 1] - 0.5).max(), 1e-12)
            np.testing.assert_array_equal(mesh.interface_edges[edge.rows], edge.edges)
            self.assertTrue((mesh.interface_curves[edge.rows] >= 0).any())
            self.assertRaises(KeyError, mesh.in_region, "lava")
            self.assertEqual(trime_mpi.read(self.work / "own.h5").interfaces, {})

    def test_refined_regions(self):
        """Twice as many interfaces on the same lines, on any ranks, and the same names."""
        made = []
        for ranks in (1, 3):
            fine = self.work / f"fine{ranks}.h5"
            done = run("refine", self.work / "layers.h5", fine, ranks=ranks)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            with h5py.File(fine) as file, h5py.File(self.work / "layers.h5") as coarse:
                arrays = {name: values[:] for group in ("curves", "interfaces", "lines")
                          for name, values in file["Mesh"][group].items()}
                made.append({name: values.tolist() for name, values in arrays.items()})
                for group in ("curves", "interfaces", "lines"):
                    self.assertEqual(len(file["Mesh"][group]["labels"]), 2 * len(coarse["Mesh"][group]["labels"]))
                for name in ("pair_name", "left", "right", "label"):
                    np.testing.assert_array_equal(file["trime_mpi/interfaces"][name],
                                                  coarse["trime_mpi/interfaces"][name])
                np.testing.assert_array_equal(np.bincount(file["VTKHDF/CellData/region"]),
                                              4 * np.bincount(coarse["VTKHDF/CellData/region"]))
        self.assertEqual(*made)

    def test_info_of_long_lists(self):
        """20 names of each list; all of them with --all."""
        path = self.work / "long.h5"
        shutil.copyfile(self.work / "layers.h5", path)
        with h5py.File(path, "r+") as file:
            tags = file["trime_mpi/tags"]
            for name, values in (("part_name", [f"side {k}" for k in range(1000)]),
                                 ("region_name", [f"unit {k}" for k in range(21)]),
                                 ("region_id", np.arange(1, 22, dtype=np.int32))):
                kind = tags[name].dtype
                del tags[name]
                tags.create_dataset(name, data=np.array(values, dtype="S10" if kind.kind == "S" else kind))
            if "regions" in file["trime_mpi"]:
                del file["trime_mpi/regions"]
        done = run("info", path)
        self.assertEqual(done.returncode, 0, done.stderr)
        for words in (r"boundary edges in other formats: 1 side 0, 2 side 1, .*, 20 side 19, and 980 more\n",
                      r"\nunit 19 +20\nand 1 more\n", r"\n'trime_mpi info .*long\.h5 --all' prints whole lists\n"):
            self.assertRegex(done.stdout, words)
        self.assertNotIn("unit 20", done.stdout)
        done = run("info", path, "--all")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r", 1000 side 999\n")
        self.assertRegex(done.stdout, r"\nunit 20 +21\n")
        self.assertNotIn(" more", done.stdout)

    def test_info_of_damaged_tables(self):
        """Columns of unlike length, and one that claims far more rows than the file holds."""
        for name, count, words in (("edge_kind", 0, "edge_kind has 0 rows"), ("edge_count", 10**13, "claims to have")):
            damaged = self.work / f"{name}.h5"
            shutil.copyfile(self.work / "own.h5", damaged)
            with h5py.File(damaged, "r+") as file:
                tags = file["trime_mpi/tags"]
                kind = tags[name].dtype
                del tags[name]
                tags.create_dataset(name, shape=(count,), dtype=kind, chunks=(64,), maxshape=(None,))
            done = run("info", damaged)
            self.assertEqual(done.returncode, 4, done.stdout + done.stderr)
            self.assertIn(words, done.stderr)

    def test_convert_of_an_array_that_claims_too_much(self):
        """Memory is asked for by what the file can hold, in chunks or in one piece."""
        for chunks in (None, (64, 2)):
            damaged = self.work / "claims.h5"
            shutil.copyfile(self.work / "own.h5", damaged)
            with h5py.File(damaged, "r+") as file:
                del file["Mesh/mesh/geometry"]
                file["Mesh/mesh"].create_dataset("geometry", shape=(10**13, 2), dtype="f8", chunks=chunks)
            done = run("convert", damaged, self.work / "claims.vtu", ranks=2)
            self.assertEqual(done.returncode, 4, done.stdout + done.stderr)
            self.assertRegex(done.stderr, r"/Mesh/mesh/geometry in .*claims\.h5 claims to have 1\.6e\+14 bytes")


if __name__ == "__main__":
    unittest.main()
