#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests curves that are split: pairs of points on both sides, boundary edges with the name of the curve, weirs of
fort14, equal bits on any number of ranks, and that trime_check finds damaged pairs.
"""
import math
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys
import unittest
from collections import Counter

import h5py
import numpy as np

from trime_run import PROGRAM, ROOT, WorkspaceCase, run

sys.path.insert(0, str(ROOT / "scripts" / "python"))
import trime_mpi  # noqa: E402  (found by the line above)

CHECK = os.environ.get("TRIME_CHECK", str(pathlib.Path(PROGRAM).parent / "src" / "check" / "trime_check"))
BASE = """{shape}
{curves}
[meshing]
points = {points}
[output]
directory = {directory}
name = mesh
overwrite = true
formats = {formats}
"""
SQUARE = "[shape]\ngeometry = domain"
LAYOUTS = [(1, 1), (2, 1), (3, 2), (7, 1)]  # ranks, threads
TOLERANCE = 1e-12  # of lengths: sums of fewer than 100 rounded numbers below 1


def section(name, *lines):
    return "\n".join([f"[curve.{name}]", f"file = {name}.xy", *lines]) + "\n"


def split(name, *lines):
    return section(name, "split = true", *lines)


class Mesh:
    """The arrays of a mesh file, and what they say about its split curves."""

    def __init__(self, path):
        with h5py.File(path) as file:
            self.points = file["/Mesh/mesh/geometry"][:]
            self.triangles = file["/Mesh/mesh/topology"][:]
            self.facets = file["/Mesh/facets/topology"][:]
            self.tags = file["/Mesh/facets/values"][:]
            self.labels = file["/Mesh/facets/labels"][:]
            self.region = file["/VTKHDF/CellData/region"][:]
            self.boundary = file["/VTKHDF/PointData/boundary"][:]
            self.names = [name.decode() for table, column in (("tags", "part_name"), ("curves", "curve_name"))
                          for name in file[f"/trime_mpi/{table}/{column}"][:]]
            self.kinds = [name.decode() for name in file["/trime_mpi/tags/edge_kind"][:]]
            self.components = int(file["/trime_mpi"].attrs["components"])
            inner = {name: file[f"/Mesh/{name}"] for name in ("curves", "interfaces", "splits") if name in file["Mesh"]}
            self.curve_edges = inner["curves"]["topology"][:] if "curves" in inner else np.zeros((0, 2), int)
            self.interfaces = inner["interfaces"]["topology"][:] if "interfaces" in inner else np.zeros((0, 2), int)
            self.pairs, self.curves, self.paths = ((inner["splits"][name][:] for name in ("pairs", "curves", "paths"))
                                                   if "splits" in inner else (np.zeros((0, 2), int), [], []))
            arrays = [self.points, self.triangles, self.facets, self.tags, self.labels, self.region, self.boundary]
            arrays += [group[name][:] for group in inner.values() for name in sorted(group)]
        self.bits = [array.tobytes() for array in arrays]

    def sides(self, name):
        """Returns the boundary edges with a name."""
        return self.facets[self.labels == self.names.index(name) + 1]

    def length(self, name):
        ends = self.points[self.sides(name)]
        return math.fsum(np.hypot(*(ends[:, 1] - ends[:, 0]).T))

    def area(self):
        a, b, c = (self.points[self.triangles[:, k]] for k in range(3))
        return math.fsum(0.5 * ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]))

    def joined(self):
        """Returns for each point the lowest point at the same place."""
        lowest = {}
        return np.array([lowest.setdefault(tuple(p), k) for k, p in enumerate(self.points.tolist())])

    def euler(self, numbers=None):
        triangles = self.triangles if numbers is None else numbers[self.triangles]
        sides = np.sort(np.vstack([triangles[:, [k, (k + 1) % 3]] for k in range(3)]), axis=1)
        return len(np.unique(triangles)) - len(np.unique(sides, axis=0)) + len(triangles)

    def copies(self):
        """Returns the number of points at each place that has several, by its coordinates with 12 digits."""
        counts = Counter(map(tuple, self.points.tolist()))
        return {tuple(round(v, 12) for v in place): count for place, count in counts.items() if count > 1}

    def rim(self):
        """Returns the edges with one triangle, which lies on their left."""
        sides = {(t[k], t[(k + 1) % 3]) for t in self.triangles.tolist() for k in range(3)}
        return {edge for edge in sides if edge[::-1] not in sides}

    def path(self, number):
        """Returns the places of the pairs of a path."""
        return self.points[self.pairs[np.asarray(self.paths) == number, 0]]


class Splits(WorkspaceCase):
    def run_config(self, curves, shape=SQUARE, formats="vtkhdf xdmf", points=2000, ranks=1, threads=1):
        config = self.directory / "mesh.ini"
        config.write_text(BASE.format(shape=shape, curves=curves, points=points, directory=self.directory,
                                      formats=formats))
        return run(config, ranks=ranks, threads=threads)

    def mesh(self, curves, **options):
        """Makes a mesh, and checks what holds for any mesh with split curves."""
        done = self.run_config(curves, **options)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.report = done.stdout
        judged = subprocess.run([CHECK, self.directory / "mesh.h5"], capture_output=True, text=True, check=False)
        self.assertEqual(judged.returncode, 0, judged.stdout)
        mesh = Mesh(self.directory / "mesh.h5")
        self.assertEqual(mesh.rim(), set(map(tuple, mesh.facets.tolist())))
        left, right = mesh.points[mesh.pairs[:, 0]], mesh.points[mesh.pairs[:, 1]]
        self.assertEqual(left.tobytes(), right.tobytes())
        self.assertTrue(np.all(mesh.pairs[:, 0] != mesh.pairs[:, 1]))
        self.check_sides(mesh)
        return mesh

    def check_sides(self, mesh):
        """The triangles on the left of the curve have the left points of the pairs, along the whole path."""
        edges = set(map(tuple, mesh.facets.tolist()))
        for path in np.unique(mesh.paths):
            rows = mesh.pairs[np.asarray(mesh.paths) == path].tolist()
            for (left, right), (next_left, next_right) in zip(rows, rows[1:]):
                self.assertIn((left, next_left), edges)
                self.assertIn((next_right, right), edges)

    def same_on_all(self, curves, **options):
        made = [self.mesh(curves, ranks=ranks, threads=threads, **options) for ranks, threads in LAYOUTS]
        for mesh in made[1:]:
            self.assertEqual(mesh.bits, made[0].bits)
        return made[0]

    def test_crack(self):
        """Case 18: a crack with free ends, which is a weir in fort14."""
        self.write("crack.xy", [(0.3, 0.5), (0.7, 0.5)])
        mesh = self.same_on_all(split("crack", "weir_height = 2"), formats="vtkhdf xdmf fort14 medit")
        sides = mesh.sides("crack")
        edges = len(sides) // 2
        self.assertGreater(edges, 10)
        self.assertEqual(len(sides), 2 * edges)
        self.assertAlmostEqual(mesh.length("crack"), 0.8, delta=TOLERANCE)
        self.assertEqual(len(mesh.facets) - len(sides), (mesh.labels == 1).sum())
        self.assertEqual(len(mesh.pairs), edges - 1)
        places = mesh.points[mesh.pairs[:, 0]]
        self.assertTrue(np.all(np.diff(places[:, 0]) > 0))
        self.assertTrue(np.all(places[:, 1] == 0.5))
        self.assertEqual(set(map(tuple, places.round(12).tolist())), set(mesh.copies()))
        self.assertTrue(all(count == 2 for count in mesh.copies().values()))
        self.assertNotIn((0.3, 0.5), mesh.copies())
        self.assertNotIn((0.7, 0.5), mesh.copies())
        self.assertEqual(mesh.euler(), 0)
        self.assertEqual(mesh.euler(mesh.joined()), 1)
        self.assertAlmostEqual(mesh.area(), 1, delta=1e-11)
        self.assertEqual(sorted(mesh.kinds), ["hole", "outer"])
        self.assertEqual(len(mesh.curve_edges), 0)
        above = {v for t in mesh.triangles.tolist() if mesh.points[t][:, 1].max() > 0.5 for v in t}
        self.assertTrue(set(mesh.pairs[:, 0].tolist()) <= above)
        self.assertFalse(set(mesh.pairs[:, 1].tolist()) & above)
        self.assertIn("land boundary: domain; weirs: crack", self.report)
        self.check_weir(mesh, edges - 1)
        self.check_medit(mesh)
        read = trime_mpi.read(self.directory / "mesh.h5")
        self.assertEqual(read.boundaries["crack"].facets.tolist(), sides.tolist())
        self.assertEqual(read.split_pairs.tolist(), mesh.pairs.tolist())
        self.assertEqual((set(read.split_curves.tolist()), set(read.split_paths.tolist())), ({0}, {0}))

    def check_weir(self, mesh, rows):
        """One boundary of type 24, and as many points on land as the file says."""
        lines = (self.directory / "mesh.14").read_text().splitlines()
        lines = lines[2 + len(mesh.points) + len(mesh.triangles):]
        self.assertRegex(lines[2], r"^2 = land boundaries")
        self.assertEqual(int(lines[3].split()[0]), (mesh.labels == 1).sum() + 1 + 2 * rows)
        start = next(k for k, line in enumerate(lines) if re.fullmatch(r"\d+ 24 = crack", line))
        self.assertEqual(int(lines[start].split()[0]), rows)
        self.assertEqual(len(lines), start + 1 + rows)
        for line, (left, right) in zip(lines[start + 1:], mesh.pairs.tolist()):
            self.assertEqual(line.split(), [str(left + 1), str(right + 1), "2", "1", "1"])

    def check_medit(self, mesh):
        """Other programs see both sides as edges with the label of the curve; so does a mesh from `convert`."""
        text = (self.directory / "mesh.mesh").read_text()
        lines = text.splitlines()
        start = lines.index("Edges")
        rows = [tuple(map(int, line.split())) for line in lines[start + 2:start + 2 + int(lines[start + 1])]]
        self.assertEqual({(a - 1, b - 1) for a, b, label in rows if label == 2},
                         set(map(tuple, mesh.sides("crack").tolist())))
        for ending in ("mesh", "14"):
            done = run("convert", self.directory / "mesh.h5", self.directory / f"again.{ending}", ranks=2)
            self.assertEqual(done.returncode, 0, done.stderr)
            again = (self.directory / f"again.{ending}").read_text().splitlines()
            self.assertEqual(again[1:], (self.directory / f"mesh.{ending}").read_text().splitlines()[1:])

    def test_fault_from_rim_to_rim(self):
        """All points are doubled, and the mesh falls into two components."""
        self.write("fault.xy", [(0, 0.4), (1, 0.6)])
        mesh = self.same_on_all(split("fault"))
        edges = len(mesh.sides("fault")) // 2
        self.assertEqual(len(mesh.pairs), edges + 1)
        self.assertTrue(np.allclose(mesh.path(0)[[0, -1]], [[0, 0.4], [1, 0.6]], rtol=0, atol=1e-12))
        self.assertEqual((mesh.euler(), mesh.components, mesh.kinds), (2, 2, ["outer", "outer"]))
        self.assertEqual(len(np.unique(mesh.tags)), 2)
        info = run("info", self.directory / "mesh.h5")
        self.assertEqual(info.returncode, 0, info.stderr)
        self.assertIn("domain+fault", info.stdout.replace("fault+domain", "domain+fault"))

    def test_branches(self):
        """Where three split arms meet there are three copies, and four where two curves cross. Each arm is a path."""
        self.write("bar.xy", [(0.2, 0.5), (0.8, 0.5)])
        self.write("stem.xy", [(0.5, 0.5), (0.5, 0.8)])
        mesh = self.same_on_all(split("bar") + split("stem"))
        self.assertEqual(mesh.copies()[(0.5, 0.5)], 3)
        self.assertEqual(Counter(mesh.copies().values())[3], 1)
        self.assertEqual([int(c) for c in np.unique(mesh.curves)], [0, 1])
        self.assertEqual(len(np.unique(mesh.paths)), 3)
        self.assertEqual(mesh.path(2)[0].tolist(), [0.5, 0.5])
        self.assertEqual((mesh.euler(), mesh.kinds), (0, ["outer", "hole"]))
        self.write("stem.xy", [(0.5, 0.2), (0.5, 0.8)])
        mesh = self.mesh(split("bar") + split("stem"), ranks=3)
        self.assertEqual(mesh.copies()[(0.5, 0.5)], 4)
        info = run("info", self.directory / "mesh.h5")
        copies = sum(count - 1 for count in mesh.copies().values())
        self.assertIn(f"split curves  {len(mesh.pairs)} pairs of points on {len(np.unique(mesh.paths))} paths; "
                      f"{copies} points are copies of others\n", info.stdout)
        self.assertEqual(len(np.unique(mesh.paths)), 4)
        self.assertAlmostEqual(mesh.length("bar"), 1.2, delta=TOLERANCE)
        self.assertAlmostEqual(mesh.length("stem"), 1.2, delta=TOLERANCE)

    def test_one_of_two_that_cross(self):
        """An arm that is not split does not divide: the crossing has two copies."""
        self.write("bar.xy", [(0.2, 0.5), (0.8, 0.5)])
        self.write("stem.xy", [(0.5, 0.2), (0.5, 0.8)])
        mesh = self.same_on_all(split("bar") + section("stem"))
        self.assertEqual(mesh.copies()[(0.5, 0.5)], 2)
        self.assertEqual(len(np.unique(mesh.paths)), 1)
        self.assertEqual(len(mesh.sides("stem")), 0)
        places = mesh.points[mesh.curve_edges]
        self.assertAlmostEqual(math.fsum(np.hypot(*(places[:, 1] - places[:, 0]).T)), 0.6, delta=TOLERANCE)
        at_crossing = [v for edge in mesh.curve_edges.tolist() for v in edge
                       if mesh.points[v].tolist() == [0.5, 0.5]]
        self.assertEqual(sorted(at_crossing), sorted(mesh.pairs[mesh.path(0).tolist().index([0.5, 0.5])].tolist()))
        self.write("stem.xy", [(0.5, 0.5), (0.5, 0.8)])
        mesh = self.mesh(section("bar") + split("stem"), ranks=2)
        self.assertNotIn((0.5, 0.5), mesh.copies())  # a free end on a curve that is not split

    def test_interface(self):
        """A wall on a part of an interface between two regions, which ends there."""
        shape = (SQUARE + "\nrest = low\n[region.high]\ngeometry = above\n"
                 "[shape.above]\ntype = rectangle\nx_min = 0\ny_min = 0.5\nx_max = 1\ny_max = 1")
        self.write("wall.xy", [(0.25, 0.5), (0.75, 0.5)])
        mesh = self.same_on_all(split("wall"), shape=shape)
        self.assertAlmostEqual(mesh.length("wall"), 1, delta=TOLERANCE)
        places = mesh.points[mesh.interfaces]
        self.assertAlmostEqual(math.fsum(np.hypot(*(places[:, 1] - places[:, 0]).T)), 0.5, delta=TOLERANCE)
        regions = {tuple(sorted((t[k], t[(k + 1) % 3]))): set() for t in mesh.triangles.tolist() for k in range(3)}
        for number, t in zip(mesh.region.tolist(), mesh.triangles.tolist()):
            for k in range(3):
                regions[tuple(sorted((t[k], t[(k + 1) % 3])))].add(number)
        between = {edge for edge, found in regions.items() if len(found) == 2}
        self.assertEqual(between, {tuple(sorted(edge)) for edge in mesh.interfaces.tolist()})

    def test_rings(self):
        """A closed curve cuts a disc out; a curve from the rim to a hole joins their loops."""
        ring = [(0.5 + 0.2 * math.cos(k * math.pi / 20), 0.5 + 0.2 * math.sin(k * math.pi / 20)) for k in range(40)]
        self.write("ring.xy", ring + ring[:1])
        mesh = self.same_on_all(split("ring", "weir_height = 0.5"), formats="vtkhdf xdmf fort14")
        edges = len(mesh.sides("ring")) // 2
        self.assertEqual(len(mesh.pairs), edges)
        self.assertEqual((mesh.euler(), mesh.components), (1, 2))
        self.assertEqual(sorted(mesh.kinds), ["hole", "outer", "outer"])
        text = (self.directory / "mesh.14").read_text()
        self.assertIn(f"{edges + 1} 24 = ring", text.splitlines())  # the first pair stands at the end again
        shape = ("[shape]\ngeometry = difference(domain, hole)\n"
                 "[shape.hole]\ntype = circle\ncenter = 0.5 0.5\nradius = 0.2")
        self.write("cut.xy", [(0, 0.5), (0.3, 0.5)])
        mesh = self.mesh(split("cut"), shape=shape, ranks=3)
        self.assertEqual((mesh.euler(), mesh.components, mesh.kinds), (1, 1, ["outer"]))
        self.assertEqual(len(mesh.pairs), len(mesh.sides("cut")) // 2 + 1)

    def test_short(self):
        """A curve that is far shorter than the triangles has one pair between its ends."""
        self.write("dot.xy", [(0.5, 0.5), (0.501, 0.5)])
        mesh = self.mesh(split("dot"))
        self.assertEqual((len(mesh.pairs), len(mesh.curve_edges), len(mesh.sides("dot"))), (1, 0, 4))
        self.assertEqual((mesh.euler(), mesh.euler(mesh.joined())), (0, 1))

    def test_several_curves(self):
        """Curves that follow each other, in both directions, and a branch that reaches the rim."""
        self.write("a.xy", [(0.2, 0.3), (0.5, 0.3)])
        self.write("b.xy", [(0.5, 0.3), (0.8, 0.3)], [(0.8, 0.6), (0.8, 0.3)])
        self.write("c.xy", [(0.8, 0.6), (1, 0.6)])
        mesh = self.same_on_all(split("a") + split("b") + split("c"))
        self.assertEqual((mesh.euler(), mesh.components, mesh.kinds), (1, 1, ["outer"]))
        self.assertEqual(len(np.unique(mesh.paths)), 3)  # the lines of b have been joined to one
        self.assertEqual({count for count in mesh.copies().values()}, {2})
        self.assertIn((1.0, 0.6), mesh.copies())
        self.assertNotIn((0.2, 0.3), mesh.copies())

    def test_networks(self):
        """Segments from a seed at all angles, around a hole: some are split and some are not, some leave the shape."""
        shape = ("[shape]\ngeometry = difference(domain, hole)\n"
                 "[shape.hole]\ntype = circle\ncenter = 0.5 0.5\nradius = 0.1")
        for seed in (1, 2):
            numbers = random.Random(seed)
            for name, count in (("a", 6), ("b", 6), ("c", 3)):
                lines = []
                for _ in range(count):
                    x, y, angle, length = (numbers.uniform(0.05, 0.95), numbers.uniform(0.05, 0.95),
                                           numbers.uniform(0, 2 * math.pi), numbers.uniform(0.05, 0.5))
                    lines.append([(x, y), (x + length * math.cos(angle), y + length * math.sin(angle))])
                self.write(f"{name}.xy", *lines)
            curves = split("a", "clip = true") + split("b", "clip = true") + section("c", "clip = true")
            made = [self.mesh(curves, shape=shape, points=6000, ranks=ranks) for ranks in (1, 3)]
            self.assertEqual(made[0].bits, made[1].bits)
            self.assertGreater(len(made[0].pairs), 50)
            self.assertEqual(made[0].euler(), 2 * made[0].kinds.count("outer") - len(made[0].kinds))

    def test_wall_on_a_whole_interface(self):
        """A wall from rim to rim on the only interface: the regions no longer share an edge."""
        shape = (SQUARE + "\nrest = low\n[region.high]\ngeometry = above\n"
                 "[shape.above]\ntype = rectangle\nx_min = 0\ny_min = 0.5\nx_max = 1\ny_max = 1")
        self.write("wall.xy", [(0, 0.5), (1, 0.5)])
        mesh = self.mesh(split("wall"), shape=shape, ranks=2, formats="vtkhdf xdmf gmsh 2dm")
        self.assertEqual((len(mesh.interfaces), mesh.components, mesh.euler()), (0, 2, 2))
        self.assertAlmostEqual(mesh.length("wall"), 2, delta=TOLERANCE)
        import meshio  # pylint: disable=import-outside-toplevel
        read = meshio.read(self.directory / "mesh.msh")
        of_wall = [edge for block, tags in zip(read.cells, read.cell_data["gmsh:physical"]) if block.type == "line"
                   for edge, tag in zip(block.data.tolist(), tags) if tag == read.field_data["wall"][0]]
        self.assertEqual(sorted(of_wall), sorted(mesh.sides("wall").tolist()))
        text = (self.directory / "mesh.2dm").read_text()
        label = mesh.names.index("wall") + 1
        self.assertIn(f"node string {label}: wall", text.splitlines()[1])
        last = [line.split()[-1] for line in text.splitlines() if line.startswith("NS") and "-" in line]
        self.assertEqual(last.count(str(label)), 2)  # a string on each side

    def test_restart(self):
        """A run that was stopped goes on to the same mesh."""
        self.write("crack.xy", [(0.3, 0.5), (0.7, 0.6)])
        whole = self.mesh(split("crack"))
        config, stop = self.directory / "mesh.ini", self.directory / "stop"
        (self.directory / "mesh.h5").unlink()
        for ranks in (2, 1):
            stop.touch()
            done = run(config, f"checkpoint.stop_file={stop}", "--restart", "auto", ranks=ranks)
            self.assertEqual(done.returncode, 75, done.stdout + done.stderr)
        done = run(config, "--restart", "auto", ranks=3)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual(Mesh(self.directory / "mesh.h5").bits, whole.bits)

    def test_refusals(self):
        self.write("crack.xy", [(0.3, 0.5), (0.7, 0.5)])
        done = self.run_config(section("crack", "weir_height = 2"))
        self.assertEqual(done.returncode, 2)
        self.assertIn("expected 'split = true'", done.stderr)
        done = self.run_config(split("crack"), shape=SQUARE + "\n[domain]\nperiodic_x = true")
        self.assertEqual(done.returncode, 2)
        self.assertIn("periodic", done.stderr)
        self.mesh(split("crack"))
        done = run("refine", self.directory / "mesh.h5", self.directory / "fine.h5", ranks=2)
        self.assertEqual(done.returncode, 2)
        self.assertIn("pairs of its points", done.stderr)
        self.assertFalse((self.directory / "fine.h5").exists())

    def test_finds_damage(self):
        """Each change is found by a check with this name."""
        self.write("crack.xy", [(0.3, 0.5), (0.7, 0.5)])
        self.write("stem.xy", [(0.5, 0.5), (0.5, 1)])
        self.mesh(split("crack") + split("stem"))

        def swap_rows(file):
            pairs = file["/Mesh/splits/pairs"]
            pairs[1:3] = pairs[1:3][::-1]

        def swap_sides(file):
            pairs = file["/Mesh/splits/pairs"]
            pairs[1] = pairs[1][::-1]

        def wrong_partner(file):
            pairs = file["/Mesh/splits/pairs"]
            pairs[1] = [pairs[1][0], pairs[2][1]]

        def move_copy(file):
            point = int(file["/Mesh/splits/pairs"][2][1])
            places = file["/Mesh/mesh/geometry"]  # /VTKHDF/Points shows them
            row = places[point]
            row[0] = np.nextafter(row[0], 1)
            places[point] = row

        def other_curve(file):
            file["/Mesh/splits/curves"][0] = 1

        def unknown_curve(file):
            file["/Mesh/splits/curves"][0] = 7

        def skip_path(file):
            file["/Mesh/splits/paths"][-1] = 9

        def not_split(file):
            file["/trime_mpi/curves/split"][0] = 0

        def fewer_rows(file):
            for name in ("pairs", "curves", "paths"):
                rows = file[f"/Mesh/splits/{name}"][:-1]
                del file[f"/Mesh/splits/{name}"]
                file[f"/Mesh/splits/{name}"] = rows

        def no_pairs(file):
            del file["/Mesh/splits"]

        def other_size(file):
            file["/VTKHDF/PointData/size"][int(file["/Mesh/splits/pairs"][2][1])] *= np.float32(1.01)

        for change, check in ((swap_rows, "split_order"), (swap_sides, "split_order"), (wrong_partner, "split_points"),
                              (move_copy, "split_points"), (other_curve, "split_paths"), (skip_path, "split_paths"),
                              (unknown_curve, "split_curves"), (not_split, "split_curves"),
                              (fewer_rows, "split_listed"), (no_pairs, "tags"), (other_size, "split_fields")):
            damaged = self.directory / "damaged.h5"
            shutil.copy(self.directory / "mesh.h5", damaged)
            with h5py.File(damaged, "r+") as file:
                change(file)
            judged = subprocess.run([CHECK, damaged], capture_output=True, text=True, check=False)
            self.assertEqual(judged.returncode, 5, f"{change.__name__}: {judged.stdout}{judged.stderr}")
            self.assertRegex(judged.stdout, rf"(?m)^WRONG +{check}\b", change.__name__)


if __name__ == "__main__":
    unittest.main()
