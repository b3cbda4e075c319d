#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests regions and curves in periodic containers: lines that cross the sides of the container or wind around it.
Areas, lengths and numbers of junctions are compared with exact values; the arrays must be the same on any ranks and
threads.
"""
import json
import math
import os
import pathlib
import random
import subprocess
import unittest
from collections import Counter

import h5py
import numpy as np

from region_meshes import circle, rectangle, region
from trime_run import PROGRAM, WorkspaceCase, run

CHECK = os.environ.get("TRIME_CHECK", str(pathlib.Path(PROGRAM).parent / "src" / "check" / "trime_check"))
LAYOUTS = [(2, 1), (3, 2), (7, 1)]  # ranks, threads; the first mesh is made on 1 rank and 1 thread
EXACT = 1e-11
BOTH, ALONG_X = (1, 1), (1, 0)


class PeriodicMesh:
    """The arrays of a mesh in a periodic container."""

    def __init__(self, path):
        with h5py.File(path) as file:
            metadata = file["/trime_mpi"]
            self.period = np.array([metadata.attrs["period_x"], metadata.attrs["period_y"]])
            self.points, self.triangles = file["/Mesh/mesh/geometry"][:], file["/Mesh/mesh/topology"][:]
            cells = file["/VTKHDF/CellData"]
            self.region = cells["region"][:] if "region" in cells else np.ones(len(self.triangles), int)
            self.facets = file["/Mesh/facets/topology"][:]
            tags = file["/trime_mpi/tags"]
            self.numbers = {name.decode(): int(k) for k, name in zip(tags["region_id"], tags["region_name"])}
            self.lists = {f"{group}/{name}": array[:] for group in ("interfaces", "curves") if group in file["/Mesh"]
                          for name, array in file[f"/Mesh/{group}"].items()}
            self.curve_names = [name.decode() for name in file["/trime_mpi/curves/curve_name"][:]] \
                if "curves" in metadata else []
            self.hash = metadata.attrs["mesh_hash"] if "mesh_hash" in metadata.attrs else None
        none = np.zeros((0, 2), int)
        self.edges = self.lists.get("interfaces/topology", none)
        self.curve_edges = self.lists.get("curves/topology", none)
        b, c = (self.way(self.triangles[:, 0], self.triangles[:, k]) for k in (1, 2))
        self.areas = 0.5 * (b[:, 0] * c[:, 1] - b[:, 1] * c[:, 0])

    def way(self, start, end):
        """The vectors from points to the nearest images of other points."""
        way = self.points[end] - self.points[start]
        return way - self.period * np.round(way / np.where(self.period > 0, self.period, 1))

    def lengths(self, edges):
        return np.hypot(*self.way(edges[:, 0], edges[:, 1]).T)

    def area(self, name):
        return math.fsum(self.areas[self.region == self.numbers[name]])

    def length(self):
        return math.fsum(self.lengths(self.edges))

    def curve_length(self, name):
        return math.fsum(self.lengths(self.curve_edges[self.lists["curves/values"] == self.curve_names.index(name)]))

    def euler(self, name):
        own = self.triangles[self.region == self.numbers[name]]
        sides = np.unique(np.sort(own[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)), axis=0)
        return len(np.unique(own)) - len(sides) + len(own)

    def degrees(self):
        """Returns how many points have which number of chords above two."""
        chords = np.unique(np.sort(np.vstack([self.facets, self.edges, self.curve_edges])), axis=0)
        return Counter(n for n in Counter(chords.ravel().tolist()).values() if n > 2)

    def free_ends(self):
        return sum(n == 1 for n in Counter(self.curve_edges.ravel().tolist()).values())

    def arrays(self):
        return {"points": self.points, "triangles": self.triangles, "region": self.region, **self.lists}


class PeriodicRegions(WorkspaceCase):
    def run_config(self, text, periodic=BOTH, points=2000, shape="geometry = domain", ranks=1, threads=1, more=""):
        config = self.directory / "mesh.ini"
        words = ["true" if one else "false" for one in periodic]
        config.write_text(f"[domain]\nx_min = 0\nx_max = 1\ny_min = 0\ny_max = 1\nperiodic_x = {words[0]}\n"
                          f"periodic_y = {words[1]}\n[shape]\n{shape}\n{text}[meshing]\npoints = {points}\n{more}"
                          f"[output]\ndirectory = {self.directory}\nname = mesh\noverwrite = true\n")
        return run(config, ranks=ranks, threads=threads)

    def mesh(self, text, **options):
        """Makes a mesh on several ranks and threads, which must give equal arrays, and lets trime_check judge it."""
        done = self.run_config(text, **options)
        self.report = done.stdout + done.stderr
        self.assertEqual(done.returncode, 0, self.report)
        mesh = PeriodicMesh(self.directory / "mesh.h5")
        judged = subprocess.run([CHECK, self.directory / "mesh.h5"], capture_output=True, text=True, check=False)
        self.assertEqual(judged.returncode, 0, judged.stdout + judged.stderr)
        if len(mesh.edges) > 0 and "geojson" not in text:
            for name in ("region_places", "interface_places", "region_corners", "region_area"):
                self.assertRegex(judged.stdout, rf"(?m)^ok +{name}")
        self.check_interfaces(mesh)
        for ranks, threads in LAYOUTS:
            done = self.run_config(text, ranks=ranks, threads=threads, **options)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            other = PeriodicMesh(self.directory / "mesh.h5")
            self.assertEqual(other.hash, mesh.hash)
            self.assertEqual(set(other.arrays()), set(mesh.arrays()))
            for name, array in mesh.arrays().items():
                self.assertEqual(array.tobytes(), other.arrays()[name].tobytes(), f"{name} on {ranks} x {threads}")
        return mesh

    def check_interfaces(self, mesh):
        """Interfaces are the edges between regions, each once, with the lower region on the left."""
        sides = {(t[k], t[(k + 1) % 3]): number for number, t in zip(mesh.region.tolist(), mesh.triangles.tolist())
                 for k in range(3)}
        wanted = {edge for edge, left in sides.items() if left < sides.get(edge[::-1], 0)}
        self.assertEqual(set(map(tuple, mesh.edges.tolist())), wanted)
        self.assertEqual(len(mesh.edges), len(wanted))

    def check_disc(self, mesh, name, centers, radius):
        """The points of the interface lie on circles, and the region has the area of the polygons between them."""
        ends = mesh.points[np.unique(mesh.edges)]
        way = ends[:, None] - np.array(centers)[None]
        way -= mesh.period * np.round(way / np.where(mesh.period > 0, mesh.period, 1))
        self.assertLess(np.abs(np.hypot(way[..., 0], way[..., 1]) - radius).min(axis=1).max(), 1e-12)
        half = np.arcsin(np.minimum(1, mesh.lengths(mesh.edges) / (2 * radius)))
        polygons = math.fsum(radius * radius * np.sin(half) * np.cos(half))
        self.assertAlmostEqual(mesh.area(name), polygons, delta=EXACT)
        self.assertAlmostEqual(math.fsum(half), math.pi * len(centers), delta=1e-9)

    def refused(self, text, code, word, **options):
        for ranks in (1, 3):
            done = self.run_config(text, ranks=ranks, **options)
            self.assertEqual(done.returncode, code, done.stdout + done.stderr)
            self.assertRegex(done.stderr, word)
            self.assertFalse((self.directory / "mesh.h5").exists())

    def test_disc_inside(self):
        mesh = self.mesh(circle("disc", 0.2) + region("phase", "disc"))
        self.check_disc(mesh, "phase", [(0.5, 0.5)], 0.2)
        self.assertEqual((mesh.euler("phase"), mesh.euler("domain")), (1, -1))
        self.assertAlmostEqual(math.fsum(mesh.areas), 1, delta=EXACT)

    def test_disc_across_sides(self):
        for center in ((0.0, 0.5), (1.0, 0.05), (0.03, 0.98)):
            with self.subTest(center=center):
                text = circle("disc", 0.2, f"{center[0]} {center[1]}") + region("phase", "disc")
                mesh = self.mesh(text)
                self.check_disc(mesh, "phase", [center], 0.2)
                self.assertEqual((mesh.euler("phase"), mesh.euler("domain"), mesh.degrees()), (1, -1, Counter()))

    def test_stripe_around_torus(self):
        mesh = self.mesh(rectangle("part", (0.3, 0), (0.6, 1)) + region("stripe", "part"))
        self.assertAlmostEqual(mesh.area("stripe"), 0.3, delta=EXACT)
        self.assertAlmostEqual(mesh.length(), 2, delta=EXACT)
        self.assertEqual((mesh.euler("stripe"), mesh.euler("domain"), mesh.degrees()), (0, 0, Counter()))

    def test_stripe_on_the_side(self):
        """A border of the stripe is the side of the container."""
        for low, high in ((0, 0.25), (0.75, 1), (0.9, 1.15)):
            with self.subTest(low=low):
                mesh = self.mesh(rectangle("part", (0, low), (1, high)) + region("stripe", "part"))
                self.assertAlmostEqual(mesh.area("stripe"), 0.25, delta=EXACT)
                self.assertAlmostEqual(mesh.length(), 2, delta=EXACT)

    def test_stripes_of_a_cylinder(self):
        across = self.mesh(rectangle("part", (0.3, 0), (0.6, 1)) + region("stripe", "part"), periodic=ALONG_X)
        self.assertAlmostEqual(across.area("stripe"), 0.3, delta=EXACT)
        self.assertAlmostEqual(across.length(), 2, delta=EXACT)
        self.assertEqual((across.euler("stripe"), across.euler("domain"), across.degrees()), (1, 1, Counter({3: 4})))
        along = self.mesh(rectangle("part", (0, 0.3), (1, 0.6)) + region("stripe", "part"), periodic=ALONG_X)
        self.assertAlmostEqual(along.area("stripe"), 0.3, delta=EXACT)
        self.assertEqual((along.euler("stripe"), along.euler("domain"), along.degrees()), (0, 0, Counter()))

    def test_stripe_across_the_side(self):
        """From wall to wall, half on each side of the container; the interface meets the walls in junctions."""
        mesh = self.mesh(rectangle("part", (0.9, 0), (1.2, 1)) + region("stripe", "part"), periodic=ALONG_X)
        self.assertAlmostEqual(mesh.area("stripe"), 0.3, delta=EXACT)
        self.assertEqual(mesh.degrees(), Counter({3: 4}))

    def test_checkerboard(self):
        squares = [(i, j) for i in range(4) for j in range(4) if (i + j) % 2 == 0]
        text = "".join(rectangle(f"s{i}{j}", (i / 4, j / 4), ((i + 1) / 4, (j + 1) / 4)) for i, j in squares)
        mesh = self.mesh(text + region("black", f"union({', '.join(f's{i}{j}' for i, j in squares)})"), points=3000)
        self.assertAlmostEqual(mesh.area("black"), 0.5, delta=EXACT)
        self.assertAlmostEqual(mesh.length(), 8, delta=EXACT)
        self.assertEqual(mesh.degrees(), Counter({4: 16}))

    def test_three_regions_around_a_node(self):
        """The upper half and two quarters: nodes with three regions, some of them on the sides of the container."""
        text = rectangle("upper", (0, 0.5), (1, 1)) + rectangle("quarter", (0, 0), (0.5, 0.5))
        mesh = self.mesh(text + region("upper", "upper") + region("quarter", "quarter"))
        self.assertAlmostEqual(mesh.area("upper"), 0.5, delta=EXACT)
        self.assertAlmostEqual(mesh.area("quarter"), 0.25, delta=EXACT)
        self.assertEqual(mesh.degrees(), Counter({3: 4}))

    def test_random_discs(self):
        chance, centers = random.Random(40), []
        while len(centers) < 60:
            p = (chance.random(), chance.random())
            way = [(abs(p[0] - q[0]), abs(p[1] - q[1])) for q in centers]
            if all(math.hypot(min(x, 1 - x), min(y, 1 - y)) > 0.095 for x, y in way):
                centers.append(p)
        text = "".join(circle(f"d{k}", 0.03, f"{x!r} {y!r}") for k, (x, y) in enumerate(centers))
        mesh = self.mesh(text + region("discs", f"union({', '.join(f'd{k}' for k in range(60))})"), points=8000)
        self.check_disc(mesh, "discs", centers, 0.03)
        self.assertEqual((mesh.euler("discs"), mesh.euler("domain")), (60, -60))

    def test_grains(self):
        """A map of 25 quadrangles that tile the torus; those at the sides reach beyond them."""
        n, chance = 5, random.Random(7)
        nodes = {(i, j): ((i + 0.5 * chance.random()) / n, (j + 0.5 * chance.random()) / n)
                 for i in range(n) for j in range(n)}

        def node(i, j):
            x, y = nodes[i % n, j % n]
            return [x + i // n, y + j // n]

        rings = {f"g{i}{j}": [node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1), node(i, j)]
                 for i in range(n) for j in range(n)}
        features = [{"type": "Feature", "properties": {"grain": name},
                     "geometry": {"type": "Polygon", "coordinates": [ring]}} for name, ring in rings.items()]
        (self.directory / "grains.geojson").write_text(json.dumps({"type": "FeatureCollection", "features": features}))
        mesh = self.mesh("cover = all\n[region.unit]\nfile = grains.geojson\nattribute = grain\n", points=4000)
        for name, ring in rings.items():
            area = 0.5 * math.fsum(a[0] * b[1] - a[1] * b[0] for a, b in zip(ring, ring[1:]))
            self.assertAlmostEqual(mesh.area(f"unit.{name}"), area, delta=EXACT, msg=name)
            self.assertEqual(mesh.euler(f"unit.{name}"), 1)
        self.assertEqual(mesh.degrees(), Counter({4: 25}))

    def test_holes_and_regions(self):
        """A stripe that a hole at the corner of the container interrupts."""
        text = circle("hole", 0.2, "0 0") + rectangle("part", (0, 0.9), (1, 1.1)) + region("stripe", "part")
        mesh = self.mesh(text, shape="geometry = difference(domain, hole)\nrest = rock")
        self.assertEqual(mesh.degrees(), Counter({3: 4}))
        self.assertAlmostEqual(mesh.length(), 2 * (1 - 2 * math.sqrt(0.03)), delta=EXACT)
        self.assertEqual((mesh.euler("stripe"), mesh.euler("rock")), (1, 0))

    def test_curves(self):
        self.write("inside.xy", [(0.2, 0.2), (0.5, 0.3)])
        self.write("across.xy", [(0.8, 0.7), (1.2, 0.8)])
        self.write("around.xy", [(0, 0.4), (0.5, 0.6), (1, 0.4)])
        text = "".join(f"[curve.{name}]\nfile = {name}.xy\n" for name in ("inside", "across", "around"))
        mesh = self.mesh(text)
        self.assertAlmostEqual(mesh.curve_length("inside"), math.hypot(0.3, 0.1), delta=EXACT)
        self.assertAlmostEqual(mesh.curve_length("across"), math.hypot(0.4, 0.1), delta=EXACT)
        self.assertAlmostEqual(mesh.curve_length("around"), 2 * math.hypot(0.5, 0.2), delta=EXACT)
        self.assertEqual((mesh.free_ends(), mesh.degrees()), (4, Counter()))

    def test_curves_that_cross(self):
        """Two lines around the torus cross each other, and one ends on the other; with walls, a line joins them."""
        self.write("one.xy", [(0, 0.5), (1, 0.5)])
        self.write("two.xy", [(0, 0), (1, 1)])
        text = "".join(f"[curve.{name}]\nfile = {name}.xy\n" for name in ("one", "two"))
        mesh = self.mesh(text)
        self.assertAlmostEqual(mesh.curve_length("two"), math.sqrt(2), delta=EXACT)
        self.assertEqual((mesh.free_ends(), mesh.degrees()), (0, Counter({4: 1})))
        self.write("wall.xy", [(0.9, 0), (1.1, 1)])
        mesh = self.mesh("[curve.wall]\nfile = wall.xy\n", periodic=ALONG_X)
        self.assertAlmostEqual(mesh.curve_length("wall"), math.hypot(0.2, 1), delta=EXACT)
        self.assertEqual(mesh.degrees(), Counter({3: 2}))
        sizes = "[sizing]\nscale = absolute\nmax_size = 0.06\nsize_at = wall 0.02\n"
        mesh = self.mesh("[curve.wall]\nfile = wall.xy\n" + sizes, periodic=ALONG_X, points=20000)
        self.assertLess(abs(mesh.lengths(mesh.curve_edges) / 0.02 - 1).max(), 0.3)

    def test_size_in_a_region(self):
        text = (circle("disc", 0.2, "0 0") + region("phase", "disc") + "size = 0.02\n" +
                "[sizing]\nscale = absolute\nmax_size = 0.08\n")
        mesh = self.mesh(text, points=20000)
        inside = mesh.areas[mesh.region == mesh.numbers["phase"]]
        self.assertLess(inside.mean(), 0.45 * 0.02**2)
        self.assertGreater(mesh.areas.max(), 4 * inside.max())

    def test_refused(self):
        self.write("crack.xy", [(0.2, 0.2), (0.5, 0.3)])
        self.refused("[curve.crack]\nfile = crack.xy\nsplit = true\n", 2, "cannot be split yet")
        self.refused(circle("disc", 0.1, "0.5 2.3") + region("phase", "disc"), 3, "at most one period")


if __name__ == "__main__":
    unittest.main()
