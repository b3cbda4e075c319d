#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests curves inside a shape: their edges, nodes, names and sizes, and what is refused. Lengths and coordinates are
compared with exact values.
"""
import json
import math
import os
import pathlib
import random
import re
import subprocess
import unittest
from collections import Counter

import h5py
import numpy

from trime_run import PROGRAM, WorkspaceCase, run

CHECK = os.environ.get("TRIME_CHECK", str(pathlib.Path(PROGRAM).parent / "src" / "check" / "trime_check"))
BASE = """[shape]
geometry = domain
{curves}
[meshing]
points = {points}
[output]
directory = {directory}
name = mesh
overwrite = true
formats = {formats}
"""
LAYOUTS = [(1, 1), (2, 1), (3, 2), (7, 1)]  # ranks, threads
DIGITS = 12  # coordinates are rounded to the lattice of the container


def rounded(point):
    return tuple(round(float(v), DIGITS) for v in point)


class Mesh:
    """The arrays of a mesh file, with the edges on curves by name."""

    def __init__(self, path):
        with h5py.File(path) as file:
            self.points = file["/Mesh/mesh/geometry"][:]
            self.triangles = file["/Mesh/mesh/topology"][:]
            self.fixed = file["/VTKHDF/PointData/fixed"][:]
            self.hash = int(file["/trime_mpi"].attrs["mesh_hash"])
            self.edges = file["/Mesh/curves/topology"][:] if "curves" in file["/Mesh"] else numpy.zeros((0, 2), int)
            self.names, self.labels = [], []
            if len(self.edges) > 0:
                names = [name.decode() for name in file["/trime_mpi/curves/curve_name"][:]]
                self.names = [names[k] for k in file["/Mesh/curves/values"][:]]
                self.labels = file["/Mesh/curves/labels"][:].tolist()
            self.size = file["/VTKHDF/PointData/size"][:]

    def length(self, name=None):
        chosen = [k for k in range(len(self.edges)) if name in (None, self.names[k])]
        ends = self.points[self.edges[chosen]]
        return math.fsum(numpy.hypot(*(ends[:, 1] - ends[:, 0]).T))

    def nodes(self):
        """Returns the number of curve edges at each point that has other than two."""
        degrees = Counter(self.edges.ravel().tolist())
        return {rounded(self.points[k]): n for k, n in degrees.items() if n != 2}

    def angles(self):
        """Returns the largest angle opposite to an edge on a curve, in degrees, and how often each edge is a side."""
        wanted = {tuple(sorted(edge)) for edge in self.edges.tolist()}
        sides, largest = Counter(), 0.0
        for triangle in self.triangles.tolist():
            for k in range(3):
                a, b, apex = triangle[k], triangle[(k + 1) % 3], triangle[(k + 2) % 3]
                side = (min(a, b), max(a, b))
                if side in wanted:
                    sides[side] += 1
                    u, v = self.points[a] - self.points[apex], self.points[b] - self.points[apex]
                    largest = max(largest, math.degrees(math.acos(u @ v / math.hypot(*u) / math.hypot(*v))))
        return largest, sides

    def areas(self):
        a, b, c = (self.points[self.triangles[:, k]] for k in range(3))
        return 0.5 * numpy.abs((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0])

    def alpha(self):
        a, b, c = (self.points[self.triangles[:, k]] for k in range(3))
        sides = [numpy.hypot(*(p - q).T) for p, q in ((a, b), (b, c), (c, a))]
        area = self.areas()
        return sides[0] * sides[1] * sides[2] * sum(sides) / (16 * area * area)

    def euler(self):
        sides = numpy.sort(numpy.vstack([self.triangles[:, [k, (k + 1) % 3]] for k in range(3)]), axis=1)
        return len(self.points) - len(numpy.unique(sides, axis=0)) + len(self.triangles)


def section(name, file, *lines):
    return "\n".join([f"[curve.{name}]", f"file = {file}", *lines]) + "\n"


class Curves(WorkspaceCase):
    def run_config(self, curves, points=2000, formats="vtkhdf xdmf", extra="", ranks=1, threads=1):
        config = self.directory / "mesh.ini"
        config.write_text(BASE.format(curves=curves, points=points, directory=self.directory, formats=formats) + extra)
        return run(config, ranks=ranks, threads=threads)

    def mesh(self, curves, code=0, **options):
        done = self.run_config(curves, **options)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        self.report = done.stdout + done.stderr
        mesh = Mesh(self.directory / "mesh.h5")
        judged = subprocess.run([CHECK, self.directory / "mesh.h5"], capture_output=True, text=True, check=False)
        self.assertEqual(judged.returncode, 0, judged.stdout)
        largest, sides = mesh.angles()
        self.assertLessEqual(largest, 90 + 1e-9)
        self.assertTrue(all(count == 2 for count in sides.values()))
        self.assertEqual(len(sides), len(mesh.edges))
        return mesh

    def same_on_all(self, curves, **options):
        """Meshes on several ranks and threads. Returns the mesh."""
        made = []
        for ranks, threads in LAYOUTS:
            mesh = self.mesh(curves, ranks=ranks, threads=threads, **options)
            edges = {(*mesh.points[a].tolist(), *mesh.points[b].tolist()) for a, b in mesh.edges.tolist()}
            made.append((mesh.hash, edges))
        self.assertTrue(all(one == made[0] for one in made), [one[0] for one in made])
        return mesh

    def test_two_that_cross(self):
        self.write("x.xy", [(0.2, 0.2), (0.8, 0.8)])
        self.write("y.xy", [(0.2, 0.8), (0.8, 0.2)])
        mesh = self.same_on_all(section("x", "x.xy") + section("y", "y.xy"))
        self.assertEqual(mesh.nodes(), {(0.5, 0.5): 4, (0.2, 0.2): 1, (0.8, 0.8): 1, (0.2, 0.8): 1, (0.8, 0.2): 1})
        self.assertAlmostEqual(mesh.length(), 1.697056274847714, delta=1e-12)
        for name in ("x", "y"):
            self.assertAlmostEqual(mesh.length(name), 1.697056274847714 / 2, delta=1e-12)
        self.assertLessEqual(mesh.alpha().max(), 1.10)
        self.assertAlmostEqual(math.fsum(mesh.areas()), 1, delta=1e-11)
        self.assertEqual(mesh.euler(), 1)
        nodes = mesh.nodes()
        self.assertTrue(all(mesh.fixed[k] == 1 for k in range(len(mesh.points)) if rounded(mesh.points[k]) in nodes))
        self.assertEqual(set(mesh.labels), {2, 3})  # after the part `domain` of the boundary

    def test_rings_and_branches(self):
        """A ring, a curve across the shape, and a branch that ends on it, in one file."""
        self.write("net.xy", [(0.2, 0.6), (0.4, 0.6), (0.4, 0.8), (0.2, 0.8), (0.2, 0.6)], [(0, 0.3), (1, 0.3)],
                   [(0.5, 0.3), (0.7, 0.9)])
        mesh = self.same_on_all(section("net", "net.xy"))
        self.assertEqual(mesh.nodes(), {(0.0, 0.3): 1, (1.0, 0.3): 1, (0.5, 0.3): 3, (0.7, 0.9): 1})
        self.assertAlmostEqual(mesh.length(), 1.8 + math.hypot(0.2, 0.6), delta=1e-11)
        self.assertAlmostEqual(math.fsum(mesh.areas()), 1, delta=1e-11)

    def test_itself(self):
        """A curve that crosses itself and runs along a part of itself."""
        self.write("loop.xy", [(0.2, 0.2), (0.8, 0.8), (0.8, 0.4), (0.2, 0.4)], [(0.3, 0.4), (0.9, 0.4)])
        mesh = self.mesh(section("loop", "loop.xy"))
        self.assertEqual(mesh.nodes()[(0.4, 0.4)], 4)
        self.assertEqual(mesh.nodes()[(0.8, 0.4)], 3)
        self.assertAlmostEqual(mesh.length(), 0.6 * math.sqrt(2) + 0.4 + 0.7, delta=1e-11)

    def test_fault_network(self):
        """Segments from a seed at all angles: whatever they do, all of them are edges of a certified mesh."""
        for seed in (1, 2, 3):
            numbers = random.Random(seed)
            lines = []
            while len(lines) < 25:
                x, y, angle, length = (numbers.uniform(0.1, 0.9), numbers.uniform(0.1, 0.9),
                                       numbers.uniform(0, 2 * math.pi), numbers.uniform(0.05, 0.3))
                end = (x + length * math.cos(angle), y + length * math.sin(angle))
                if all(0.02 < v < 0.98 for v in end):
                    lines.append([(x, y), end])
            self.write("net.xy", *lines)
            mesh = self.mesh(section("net", "net.xy"), points=8000)
            given = math.fsum(math.dist(*line) for line in lines)
            self.assertAlmostEqual(mesh.length(), given, delta=1e-10)
            degrees = Counter(mesh.nodes().values())
            self.assertEqual(degrees[1], 2 * len(lines))

    def test_river(self):
        """A winding line with details far below the size of the triangles: simplified, and fine where the size is."""
        line = []
        for k in range(4001):
            t = k / 4000
            line.append((0.1 + 0.8 * t, 0.5 + 0.15 * math.sin(9 * t) + 0.004 * math.sin(900 * t)))
        self.write("river.xy", line)
        mesh = self.same_on_all(section("river", "river.xy"), points=4000)
        self.assertLess(mesh.alpha().max(), 1.5)
        self.assertLess(len(mesh.edges), 150)
        self.assertEqual(set(mesh.nodes()), {rounded(line[0]), rounded(line[-1])})
        finer = self.mesh(section("river", "river.xy"), points=20000)
        self.assertGreater(finer.length(), mesh.length())

    def test_confluences(self):
        """Tributaries that end just before or beyond a river, and one that follows it for a while."""
        self.write("rivers.xy", [(0.1, 0.5), (0.9, 0.5)],
                   [(0.2, 0.502), (0.25, 0.8)],               # ends before the river
                   [(0.4, 0.498), (0.41, 0.8)],               # beyond it
                   [(0.5, 0.5), (0.58, 0.503), (0.7, 0.2)],   # crosses it again
                   [(0.75, 0.506), (0.75, 0.8)])              # stays away by 0.25 h
        mesh = self.same_on_all(section("river", "rivers.xy"), points=2000)
        nodes = mesh.nodes()
        self.assertEqual(nodes[(0.2, 0.502)], 3)
        self.assertNotIn((0.4, 0.498), nodes)
        self.assertEqual(nodes[(0.75, 0.506)], 1)
        self.assertEqual(sorted(Counter(nodes.values()).items()), [(1, 7), (3, 3)])
        self.assertIn("1 end of curves beyond other curves or interfaces is left out", self.report)
        self.assertLess(mesh.alpha().max(), 1.5)

    def test_isobaths(self):
        """Lines of many vertices that come near to each other and part again: no small angle arises."""
        lines = [[(0.05 + 0.9 * j / 300, 0.3 + 0.02 * k + 0.03 * math.sin(7 * j / 300)
                   + 0.1 * math.exp(-((j - 150) / 50) ** 2) * (6 - k) / 6) for j in range(301)] for k in range(12)]
        self.write("isobaths.xy", *lines)
        mesh = self.same_on_all(section("isobath", "isobaths.xy"), points=3000)
        self.assertIn("follow another curve, or end just before it", self.report)
        self.assertLess(mesh.alpha().max(), 1.8)

    def test_many_from_one_place(self):
        """Sixteen curves from one place: the clean-up tries pairs of changes between them, and refines."""
        angles = [k * math.pi / 8 for k in range(16)]
        self.write("spokes.xy", *([(0.5, 0.5), (0.5 + 0.4 * math.cos(a), 0.5 + 0.4 * math.sin(a))] for a in angles))
        mesh = self.mesh(section("spoke", "spokes.xy"), points=5000)
        self.assertEqual(mesh.nodes()[(0.5, 0.5)], 16)
        self.assertAlmostEqual(mesh.length(), 16 * 0.4, delta=1e-10)
        self.assertLess(mesh.alpha().max(), 1.8)

    def test_beside_the_boundary(self):
        """Lines next to the boundary, nearer than the triangles can show, and lines that end just before it."""
        h = 1.07 / math.sqrt(2000)
        self.write("lines.xy",
                   [(0.1 + 0.02 * k, h * (0.06 + 0.03 * (k % 3))) for k in range(41)],    # all along one side
                   [(0.4, 0.7), (0.5, 1 - 0.1 * h), (0.6, 1 - 0.1 * h), (0.7, 0.7)],      # for a while
                   [(0.2, 0.5), (0.1 * h, 0.5)])                                          # ends before the left side
        mesh = self.same_on_all(section("line", "lines.xy"), points=2000)
        self.assertIn("follow the boundary, or end just before it", self.report)
        self.assertLess(mesh.alpha().max(), 1.4)
        self.assertGreater(len(mesh.points), 1950)
        nodes = mesh.nodes()
        self.assertEqual(nodes[(0, 0.5)], 1)
        self.assertEqual(len(nodes), 6)  # three lines are left

    def test_along_interfaces(self):
        """Curves along a wavy border and along a circle, a curve that weaves over the border, and two on both sides."""
        h = 1.07 / math.sqrt(2000)

        def border(angle, away=0.0):
            radius = away + 0.15 * (1 + 0.08 * math.sin(2 * angle) + 0.04 * math.sin(3 * angle + 1))
            return (0.3 + radius * math.cos(angle), 0.3 + radius * math.sin(angle))

        def ring(radius, first, last):
            angles = [first + (last - first) * k / 60 for k in range(61)]
            return [(0.7 + radius * math.cos(a), 0.7 + radius * math.sin(a)) for a in angles]

        def write(name, *lines):
            self.write(name, *lines)
            return self.directory / name

        wavy = write("border.xy", [border(2 * math.pi * k / 60) for k in range(61)])
        self.write("fault.xy", [(0.03, 0.6)] + [border(2 - 0.05 * k, 0.15 * h) for k in range(40)])
        self.write("river.xy", [border(3.5 + 0.01 * k, 0.3 * h * math.sin(0.09 * k)) for k in range(200)])
        self.write("outside.xy", ring(0.15 + 0.1 * h, 0, 2))
        self.write("inside.xy", ring(0.15 - 0.1 * h, 1, 3), [(0.6, 0.85 - 0.1 * h), (0.95, 0.85 - 0.1 * h)])
        regions = (f"[shape.wavy]\ntype = contour\nfile = {wavy}\n[region.wavy]\ngeometry = wavy\n"
                   "[shape.round]\ntype = circle\ncenter = 0.7 0.7\nradius = 0.15\n[region.round]\ngeometry = round\n")
        curves = "".join(section(name, f"{name}.xy") for name in ("fault", "river", "outside", "inside"))
        made = [self.mesh(curves + regions, ranks=ranks) for ranks in (1, 3)]
        self.assertEqual(made[0].hash, made[1].hash)
        self.assertIn("follow an interface, or end just before it", self.report)
        self.assertLess(made[0].alpha().max(), 1.5)
        self.assertAlmostEqual(made[0].length("outside"), 0.15 * 2, delta=h)

    def test_more_curves_than_points(self):
        """A net that is finer than the triangles: refused soon, with the number that it takes."""
        lines = [[(k / 16 + 0.03, 0), (k / 16 + 0.03, 1)] for k in range(16)]
        self.write("net.xy", *lines, *([(y, x) for x, y in line] for line in lines))
        done = self.run_config(section("net", "net.xy"), points=150)
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
        needed = re.search(r"; ([0-9]+) points are enough", done.stderr)
        self.assertTrue(needed, done.stderr)
        self.mesh(section("net", "net.xy"), points=int(needed[1]))

    def test_sizes(self):
        """Lengths on a curve, and distances to it in a formula."""
        self.write("wall.xy", [(0.3, 0.5), (0.7, 0.5)])
        config = self.directory / "mesh.ini"
        for sizing in ("max_size = 0.05\nsize_at = wall 0.01\ngradation = 0.2",
                       "type = expression\nexpression = min(0.05, 0.01 + 0.2*dist(wall))"):
            text = BASE.format(curves=section("wall", "wall.xy"), points=0, directory=self.directory,
                               formats="vtkhdf xdmf").replace("points = 0\n", "")
            config.write_text(text + f"[sizing]\nscale = absolute\n{sizing}\n")
            done = run(config)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            mesh = Mesh(self.directory / "mesh.h5")
            ends = mesh.points[mesh.edges]
            lengths = numpy.hypot(*(ends[:, 1] - ends[:, 0]).T)
            self.assertLess(abs(numpy.median(lengths) - 0.01), 0.0005)
            far = [size for p, size in zip(mesh.points, mesh.size) if p[1] > 0.8 or p[1] < 0.2]
            self.assertAlmostEqual(min(far), 0.05, delta=1e-3)

    def test_names_from_a_map(self):
        features = [{"type": "Feature", "properties": {"kind": kind}, "geometry": {"type": "LineString",
                     "coordinates": line}} for kind, line in
                    (("main", [[0.1, 0.5], [0.9, 0.5]]), ("side", [[0.5, 0.5], [0.7, 0.8]]),
                     ("main", [[0.2, 0.2], [0.4, 0.3]]))]
        (self.directory / "rivers.geojson").write_text(json.dumps({"type": "FeatureCollection", "features": features}))
        mesh = self.mesh(section("river", "rivers.geojson", "attribute = kind"))
        self.assertEqual(set(mesh.names), {"river.main", "river.side"})
        self.assertAlmostEqual(mesh.length("river.main"), 0.8 + math.hypot(0.2, 0.1), delta=1e-11)
        self.assertAlmostEqual(mesh.length("river.side"), math.hypot(0.2, 0.3), delta=1e-11)

    def test_formats(self):
        """Edges with names in the formats of other programs, also after `convert`."""
        self.write("x.xy", [(0.2, 0.2), (0.8, 0.8)])
        mesh = self.mesh(section("x", "x.xy"), formats="vtkhdf xdmf gmsh medit freefem triangle vtu geojson")
        lines = (self.directory / "mesh.mesh").read_text().splitlines()
        self.assertIn("# edges 2: x", lines)
        start = lines.index("Edges")
        rows = [tuple(map(int, line.split())) for line in lines[start + 2:start + 2 + int(lines[start + 1])]]
        found = {(a - 1, b - 1) for a, b, label in rows if label == 2}
        self.assertEqual(found, {tuple(edge) for edge in mesh.edges.tolist()})
        import meshio  # pylint: disable=import-outside-toplevel
        read = meshio.read(self.directory / "mesh.msh")
        of_curve = [block.data[k] for block, tags in zip(read.cells, read.cell_data["gmsh:physical"])
                    if block.type == "line" for k in range(len(tags)) if tags[k] == 2]
        self.assertEqual(len(of_curve), len(mesh.edges))
        self.assertEqual(read.field_data["x"].tolist(), [2, 1])
        done = run("convert", self.directory / "mesh.h5", self.directory / "again.mesh")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((self.directory / "again.mesh").read_bytes(), (self.directory / "mesh.mesh").read_bytes())

    def test_refine(self):
        """Each edge on a curve becomes two, with the same name."""
        self.write("x.xy", [(0.2, 0.2), (0.8, 0.8)])
        self.write("y.xy", [(0.2, 0.8), (0.8, 0.2)])
        mesh = self.mesh(section("x", "x.xy") + section("y", "y.xy"))
        made = []
        for ranks in (1, 3):
            fine = self.directory / f"fine{ranks}.h5"
            done = run("refine", self.directory / "mesh.h5", fine, ranks=ranks)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            judged = subprocess.run([CHECK, fine], capture_output=True, text=True, check=False)
            self.assertEqual(judged.returncode, 0, judged.stdout)
            refined = Mesh(fine)
            made.append((refined.edges.tolist(), refined.names))
            self.assertEqual(len(refined.edges), 2 * len(mesh.edges))
            self.assertEqual(refined.nodes(), mesh.nodes())
            for name in ("x", "y"):
                self.assertAlmostEqual(refined.length(name), mesh.length(name), delta=1e-11)
        self.assertEqual(made[0], made[1])

    def test_fixed_points_and_islands(self):
        """A fixed point at a vertex of a curve, and a curve around a hole of the shape."""
        (self.directory / "points.xy").write_text("0.3 0.6\n")
        self.write("bent.xy", [(0.1, 0.6), (0.3, 0.6), (0.5, 0.61)])
        config = self.directory / "mesh.ini"
        config.write_text("[shape]\ngeometry = difference(domain, hole)\n"
                          "[shape.hole]\ntype = circle\ncenter = 0.5 0.3\nradius = 0.1\n"
                          f"{section('bent', 'bent.xy')}[meshing]\npoints = 1500\n"
                          f"fixed_points = points.xy\n[output]\ndirectory = {self.directory}\nname = mesh\n")
        done = run(config)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        mesh = Mesh(self.directory / "mesh.h5")
        self.assertIn((0.3, 0.6), {rounded(p) for p in mesh.points[mesh.edges].reshape(-1, 2)})
        self.assertEqual(mesh.euler(), 0)

    def test_on_the_boundary(self):
        self.write("along.xy", [(0.3, 0), (0.7, 0), (0.7, 0.4)])
        mesh = self.mesh(section("along", "along.xy"))
        self.assertAlmostEqual(mesh.length(), 0.4, delta=1e-12)
        self.assertIn("curve 'along': a length of 0.4 lies on the boundary", self.report)

    def test_clip(self):
        self.write("long.xy", [(0.5, 0.5), (1.5, 0.5)])
        done = self.run_config(section("long", "long.xy"))
        self.assertEqual(done.returncode, 3)
        self.assertRegex(done.stderr, r"curve 'long' \(.*long.xy:1\) lies outside of the shape at .*clip = true")
        self.assertFalse((self.directory / "mesh.h5").exists())
        mesh = self.mesh(section("long", "long.xy", "clip = true"))
        self.assertAlmostEqual(mesh.length(), 0.5, delta=1e-12)
        self.assertIn("a length of 0.5 lies outside", self.report)

    def test_restart(self):
        """A run that stops after some sweeps goes on to the same mesh."""
        self.write("x.xy", [(0.2, 0.2), (0.8, 0.7)])
        whole = self.mesh(section("x", "x.xy"), points=3000)
        config, stop = self.directory / "mesh.ini", self.directory / "stop"
        (self.directory / "mesh.h5").unlink()
        for ranks in (2, 3, 1, 2):
            stop.touch()
            done = run(config, f"checkpoint.stop_file={stop}", "--restart", "auto", ranks=ranks)
            self.assertEqual(done.returncode, 75, done.stdout + done.stderr)
        done = run(config, "--restart", "auto", ranks=3)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual(Mesh(self.directory / "mesh.h5").hash, whole.hash)

    def test_bad_input(self):
        self.write("x.xy", [(0.2, 0.2), (0.8, 0.7)])
        (self.directory / "point.xy").write_text("0.5 0.5\n0.5 0.5\n")
        (self.directory / "nan.xy").write_text("0.5 0.5\n0.6 nan\n")
        cases = [(section("c", "none.xy"), 4, "cannot open"),
                 (section("c", "point.xy"), 3, "two different points"),
                 (section("c", "nan.xy"), 3, "finite"),
                 ("[curve.c]\nclip = true\n", 2, "needs 'file'"),
                 (section("c", "x.msh"), 2, "known are .xy, .geojson, .poly and .shp"),
                 (section("union", "x.xy"), 2, "cannot name a curve"),
                 (section("c", "x.xy", "attribute = kind"), 2, "attribute"),
                 (section("c", "x.xy", "normalize_with = other"), 2, "normalize"),
                 (section("c", "x.xy") + "split = true\n[domain]\nperiodic_x = true\n", 2, "periodic"),
                 (section("c", "x.xy", "clipp = true"), 2, "clip")]
        for ranks in (1, 3):
            for curves, code, words in cases:
                done = self.run_config(curves, ranks=ranks)
                self.assertEqual(done.returncode, code, done.stdout + done.stderr)
                self.assertIn(words, done.stderr)
                self.assertFalse((self.directory / "mesh.h5").exists())


if __name__ == "__main__":
    unittest.main()
