#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The mesh in the formats of other programs: read back by those programs, the same points, triangles, labels and names
as in the HDF5 file; the same bytes from a run and from `trime_mpi convert`, on any ranks."""
import os
import re
import shutil
import subprocess
import sys
import unittest

import gmsh
import h5py
import meshio
import numpy as np
import vtk
from osgeo import ogr

from trime_run import MPIEXEC, ROOT, Workspace, run

ogr.UseExceptions()

WORDS = "gmsh gmsh2 medit freefem triangle vtu 2dm fort14 geojson"
ENDINGS = ["msh", "msh2", "mesh", "freefem", "node", "vtu", "2dm", "14", "geojson"]
OWN = """[shape]
region = difference(union(open_sea, bay), island)
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
[meshing]
points = 1500
"""
USAGE, FILE = 2, 4


class Expected:
    """What the HDF5 file holds."""

    def __init__(self, path):
        with h5py.File(path) as file:
            self.points = file["/Mesh/mesh/geometry"][:]
            self.triangles = file["/Mesh/mesh/topology"][:]
            self.edges = file["/Mesh/facets/topology"][:]
            self.labels = file["/Mesh/facets/labels"][:]
            if not np.array_equal(self.labels, file["/Mesh/facets/parts"][:] + 1):
                raise AssertionError("labels are numbers of parts, from 1")
            tags = file["/trime_mpi/tags"]
            self.parts = {name.decode(): int(number) + 1 for name, number in zip(tags["part_name"], tags["part_id"])}
            self.regions = {name.decode(): int(number) for name, number in zip(tags["region_name"], tags["region_id"])}

    def edge_rows(self):
        """Edges with their label, in one order."""
        return rows(self.edges, self.labels)

    def point_labels(self):
        """The lowest label of the edges at each point; 0 inside."""
        labels = np.full(len(self.points), 1 << 30)
        for end in (0, 1):
            np.minimum.at(labels, self.edges[:, end], self.labels)
        return np.where(labels < 1 << 30, labels, 0)

    def length(self, label):
        """Of the boundary with a label."""
        ends = self.points[self.edges[self.labels == label]]
        return np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).sum()


def rows(edges, labels):
    """Edges with their label as sorted rows."""
    return sorted(map(tuple, np.column_stack([edges, labels]).tolist()))


def in_order(table):
    """Its rows, sorted by what they round to."""
    return table[np.lexsort(np.round(table, 9).T)]


def with_name(numbers, lines):
    """{name: number} of comments such as `# marker 2: hole`."""
    found = {}
    for line in lines:
        if match := re.match(rf"# {numbers} (\d+): (.*)", line):
            found[match[2]] = int(match[1])
    return found


class Formats(unittest.TestCase):
    """A directory with one mesh in all formats for each of two shapes, made once."""

    @classmethod
    def setUpClass(cls):
        cls.space = Workspace()
        cls.work = cls.space.__enter__()
        (cls.work / "own.ini").write_text(OWN)
        cls.expected = {}
        for config in (cls.work / "own.ini", ROOT / "configs" / "spade.ini"):
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
        np.testing.assert_array_equal(np.vstack([mesh.cells[k].data for k in triangles]), expected.triangles)
        self.assertEqual({int(number) for k in triangles for number in mesh.cell_data[region][k]}, {1})

    def test_gmsh_formats_by_meshio(self):
        for ending in ("msh", "msh2"):
            for path, expected in self.each(ending):
                with self.subTest(file=path.name):
                    mesh = meshio.read(path, file_format="gmsh")
                    self.check_meshio(mesh, expected, "gmsh:physical", "gmsh:physical")
                    found = {name: tuple(value) for name, value in mesh.field_data.items()}
                    wanted = {name: (number, 1) for name, number in expected.parts.items()}
                    self.assertEqual(found, wanted | {name: (number, 2) for name, number in expected.regions.items()})

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
                    self.assertEqual(names, {(name, 1, number) for name, number in expected.parts.items()} |
                                     {(name, 2, number) for name, number in expected.regions.items()})
                    tags, places, _ = gmsh.model.mesh.getNodes()
                    places = places.reshape(-1, 3)[np.argsort(tags), :2]
                    self.assertLessEqual(np.abs(places - expected.points).max(), 1e-15)
                    self.assertEqual(sum(len(t) for t in gmsh.model.mesh.getElements(2)[1]), len(expected.triangles))
                    for label in expected.parts.values():
                        nodes = gmsh.model.mesh.getNodesForPhysicalGroup(1, label)[0]
                        self.assertEqual(set(nodes - 1), set(expected.edges[expected.labels == label].ravel()))
                    gmsh.clear()

    def by_dolfinx(self, reader, path, ranks=1):
        """The words that a script prints on rank 0."""
        environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                           XDG_CACHE_HOME=str(self.work), OMP_NUM_THREADS="1")
        start = [] if ranks == 1 else [MPIEXEC, "-np", str(ranks)]
        done = subprocess.run([*start, sys.executable, "-c", reader, path], env=environment, capture_output=True,
                              text=True, timeout=300, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout.split()

    def test_gmsh_by_dolfinx(self):
        reader = ("import sys, gmsh, numpy as np\nfrom mpi4py import MPI\nfrom dolfinx.io import gmshio\n"
                  "gmsh.initialize()\ngmsh.option.setNumber('General.Terminal', 0)\ngmsh.open(sys.argv[1])\n"
                  "mesh, cells, facets = gmshio.model_to_mesh(gmsh.model, MPI.COMM_WORLD, 0, gdim=2)\n"
                  "print(mesh.geometry.index_map().size_global, mesh.topology.index_map(2).size_global,\n"
                  "      *np.unique(facets.values, return_counts=True)[1])\n")
        for path, expected in self.each("msh"):
            with self.subTest(file=path.name):
                counts = [int((expected.labels == label).sum()) for label in sorted(expected.parts.values())]
                self.assertEqual([int(word) for word in self.by_dolfinx(reader, path)],
                                 [len(expected.points), len(expected.triangles)] + [count for count in counts if count])

    def test_xdmf_by_dolfinx(self):
        """Mesh and mesh tags, on 1 and 2 ranks: points, and the middle of each edge with its label."""
        reader = ("import sys, numpy as np\nfrom mpi4py import MPI\nfrom dolfinx.io import XDMFFile\n"
                  "from dolfinx.mesh import compute_midpoints\nworld = MPI.COMM_WORLD\n"
                  "with XDMFFile(world, sys.argv[1] + '.xdmf', 'r') as file:\n    mesh = file.read_mesh(name='mesh')\n"
                  "mesh.topology.create_connectivity(1, 2)\n"
                  "with XDMFFile(world, sys.argv[1] + '.xmf', 'r') as file:\n"
                  "    tags = file.read_meshtags(mesh, name='facets')\n"
                  "own = tags.indices < mesh.topology.index_map(1).size_local\n"
                  "places = compute_midpoints(mesh, 1, tags.indices[own])[:, :2]\n"
                  "edges = world.gather(np.column_stack([places, tags.values[own]]))\n"
                  "points = world.gather(mesh.geometry.x[:mesh.geometry.index_map().size_local, :2])\n"
                  "if world.rank == 0:\n"
                  "    print(mesh.topology.index_map(2).size_global)\n"
                  "    np.savez(sys.argv[1], points=np.vstack(points), edges=np.vstack(edges))\n"
                  "else:\n    mesh.topology.index_map(2).size_global\n")
        for stem, expected in self.expected.items():
            for ranks in (1, 2):
                with self.subTest(stem=stem, ranks=ranks):
                    words = self.by_dolfinx(reader, self.work / stem, ranks)
                    self.assertEqual([int(word) for word in words], [len(expected.triangles)])
                    with np.load(self.work / f"{stem}.npz") as found:
                        self.assertEqual(len(found["points"]), len(expected.points))
                        self.assertLessEqual(np.abs(in_order(found["points"]) - in_order(expected.points)).max(), 1e-15)
                        middles = expected.points[expected.edges].mean(axis=1)
                        wanted = in_order(np.column_stack([middles, expected.labels]))
                        np.testing.assert_allclose(in_order(found["edges"]), wanted, atol=1e-15)

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
                corners, ends, labels, regions, names = [], [], [], set(), {}
                for number, feature in enumerate(layer):
                    shape, kind = feature.GetGeometryRef(), feature["kind"]
                    if kind == "triangle":
                        self.assertEqual(feature["number"], number)
                        corners.append(shape.GetGeometryRef(0).GetPoints(2))
                        regions.add((feature["name"], feature["region"]))
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
                self.assertEqual(regions, set(expected.regions.items()))

    def test_medit_by_meshio(self):
        for path, expected in self.each("mesh"):
            with self.subTest(file=path.name):
                mesh = meshio.read(path)
                self.check_meshio(mesh, expected, "medit:ref", "medit:ref")
                np.testing.assert_array_equal(mesh.point_data["medit:ref"], expected.point_labels())
                lines = path.read_text().splitlines()
                self.assertEqual(with_name("edges", lines), expected.parts)
                self.assertEqual(with_name("triangles", lines), expected.regions)

    def test_freefem(self):
        for path, expected in self.each("freefem"):
            with self.subTest(file=path.name):
                script = path.with_suffix(".edp")
                lengths = " << ' ' << ".join(f"int1d(Th, {label})(1.)" for label in sorted(expected.parts.values()))
                script.write_text(f'mesh Th("{path}");\ncout.precision(17);\n'
                                  f'cout << "found " << Th.nv << " " << Th.nt << " " << Th.nbe << " " << '
                                  f'{lengths.replace(chr(39), chr(34))} << endl;\n')
                done = subprocess.run(["FreeFem++", "-nw", "-v", "0", script], capture_output=True, text=True,
                                      timeout=120, check=False)
                found = re.search(r"^found (.*)$", done.stdout, re.MULTILINE)
                self.assertTrue(found, done.stdout + done.stderr)
                words = found[1].split()
                self.assertEqual([int(word) for word in words[:3]],
                                 [len(expected.points), len(expected.triangles), len(expected.edges)])
                lengths = [expected.length(label) for label in sorted(expected.parts.values())]
                np.testing.assert_allclose([float(word) for word in words[3:]], lengths, rtol=1e-12)

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
                lines = path.with_suffix(".ele").read_text().splitlines()
                self.assertEqual(with_name("region", lines), expected.regions)
                table = np.loadtxt(path.with_suffix(".edge"), skiprows=1, dtype=int)
                self.assertEqual(rows(table[:, 1:3] - 1, table[:, 3]), expected.edge_rows())

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
                self.assertEqual(grid.GetNumberOfCells(), len(expected.triangles) + len(expected.edges))
                for kind, names in (("label", expected.parts), ("region", expected.regions)):
                    for name, number in names.items():
                        self.assertEqual(grid.GetFieldData().GetArray(f"{kind} {name}").GetValue(0), number)

    def test_2dm(self):
        for path, expected in self.each("2dm"):
            with self.subTest(file=path.name):
                lines = path.read_text().splitlines()
                cards = {card: [line.split()[1:] for line in lines if line.startswith(card + " ")]
                         for card in ("E3T", "ND", "NS")}
                np.testing.assert_array_equal(np.array(cards["E3T"], dtype=int)[:, 1:4], expected.triangles + 1)
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
                self.assertEqual(rows(np.array(edges) - 1, labels), expected.edge_rows())
                for name, number in expected.parts.items():
                    self.assertIn(f"node string {number}: {name}", lines[1])

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
                self.assertEqual(rows(np.array(edges) - 1, labels), expected.edge_rows())
                self.assertEqual(kinds, {"open_sea": {"open"}, "bay": {20}, "island": {21}} if path.stem == "own"
                                 else {"spade": {20}, "hole": {21}})

    def test_convert_makes_the_same_bytes_on_any_ranks(self):
        for stem in self.expected:
            for ranks in (1, 3):
                target = self.work / f"on_{ranks}"
                target.mkdir(exist_ok=True)
                for ending in ENDINGS:
                    done = run("convert", self.work / f"{stem}.h5", target / f"{stem}.{ending}", ranks=ranks)
                    self.assertEqual(done.returncode, 0, done.stderr)
                for path in target.glob(f"{stem}.*"):
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
                 (["convert", own, self.work / "a.stl"], USAGE, r"a\.stl' has none of the endings .* \.msh \(gmsh\)"),
                 (["convert", own, self.work / "own.msh"], FILE, r"own\.msh exists; add --overwrite"),
                 (["convert", self.work / "none.h5", self.work / "a.msh"], FILE, r"cannot open .*none\.h5: No such"),
                 (["convert", self.work / "text.h5", self.work / "a.msh"], FILE, r"cannot open .*text\.h5"),
                 (["convert", plain, self.work / "a.msh"], FILE, r"plain\.h5 is no mesh file of trime_mpi"),
                 (["convert", damaged, self.work / "a.msh"], FILE, r"damaged\.h5 was changed after it was written"),
                 (["convert", own, self.work / "no" / "a.msh"], FILE, r"cannot create .*no/a\.msh"),
                 (["info"], USAGE, r"'trime_mpi info' needs one file, found 0 files"),
                 (["info", plain], FILE, r"no mesh file"),
                 ([self.work / "own.ini", "--overwrite"], USAGE, r"'--overwrite' is for 'trime_mpi convert'"),
                 ([self.work / "own.ini", f"output.directory={self.work}", "output.formats=gmsh", "output.name=own",
                   "output.overwrite=false"], FILE, r"own\.(h5|msh) exists"),
                 ([ROOT / "configs" / "torus.ini", "output.formats=gmsh"], USAGE, r"'formats = gmsh' .* periodic")]
        for arguments, code, message in cases:
            for ranks in (1, 3):
                with self.subTest(arguments=[str(word) for word in arguments], ranks=ranks):
                    done = run(*arguments, ranks=ranks, cwd=self.work)
                    self.assertEqual(done.returncode, code, done.stdout + done.stderr)
                    self.assertRegex(done.stderr, message)
        self.assertFalse((self.work / "a.msh").exists())

    def test_periodic_meshes_are_refused(self):
        done = run(ROOT / "configs" / "torus.ini", f"output.directory={self.work}")
        self.assertEqual(done.returncode, 0, done.stderr)
        done = run("convert", self.work / "torus.h5", self.work / "torus.vtu")
        self.assertEqual(done.returncode, USAGE)
        self.assertRegex(done.stderr, r"the format 'vtu' has no periodic containers")

    def test_info(self):
        done = run("info", self.work / "own.h5", ranks=2)
        self.assertEqual(done.returncode, 0, done.stderr)
        expected = self.expected["own"]
        self.assertIn(f"{len(expected.points)} points, {len(expected.triangles)} triangles", done.stdout)
        for words in (r"island +hole +1 ", r"open_sea|bay +outer", "1 open_sea, 2 bay, 3 island",
                      r"all \d+ checks passed", r"mesh hash +[0-9a-f]{16}", "smallest angle"):
            self.assertRegex(done.stdout, words)

    def test_info_of_damaged_tables(self):
        """Columns of unlike length, and one that claims far more rows than the file holds."""
        for name, rows, words in (("edge_kind", 0, "edge_kind has 0 rows"), ("edge_count", 10**13, "claims to have")):
            damaged = self.work / f"{name}.h5"
            shutil.copyfile(self.work / "own.h5", damaged)
            with h5py.File(damaged, "r+") as file:
                tags = file["trime_mpi/tags"]
                kind = tags[name].dtype
                del tags[name]
                tags.create_dataset(name, shape=(rows,), dtype=kind, chunks=(64,), maxshape=(None,))
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
