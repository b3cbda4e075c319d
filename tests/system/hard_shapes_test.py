#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests shapes that break meshers. Each run ends soon, with a certified mesh of the right topology, or with an error
that names the place.

Usage: hard_shapes_test.py [HardShapes.test_NAME ...]      all tests without a name
"""
import math
import random
import unittest

import h5py

from trime_run import Workspace, run

TIMEOUT = 300  # seconds, on a busy machine; all take a few


def rectangle(x_min, y_min, x_max, y_max):
    return [(x_min, y_min), (x_max, y_min), (x_max, y_max), (x_min, y_max)]


SQUARE = rectangle(0.1, 0.1, 0.9, 0.9)


def wedge(degrees):
    """An isosceles triangle with so sharp a tip."""
    angle = math.radians(degrees)
    return [(0.1, 0.5), (0.9, 0.5), (0.1 + 0.8 * math.cos(angle), 0.5 + 0.8 * math.sin(angle))]


def comb(teeth, width):
    """Teeth on a bar, as wide as the gaps between them."""
    ring = [(0.1, 0.1), (0.1 + (2 * teeth - 1) * width, 0.1)]
    for tooth in range(teeth - 1, -1, -1):
        left = 0.1 + 2 * tooth * width
        ring += [(left + width, 0.9), (left, 0.9)]
        if tooth > 0:
            ring += [(left, 0.2), (left - width, 0.2)]
    return ring


def star(spikes, inner, outer):
    radius = (outer, inner)
    return [(0.5 + radius[k % 2] * math.cos(math.pi * k / spikes), 0.5 + radius[k % 2] * math.sin(math.pi * k / spikes))
            for k in range(2 * spikes)]


def koch(level):
    """Snowflake with 3 * 4^level segments."""
    ring = [0.5 + 0.5j + 0.45 * complex(math.cos(a), math.sin(a))
            for a in (math.pi / 2, -math.pi / 6, -5 * math.pi / 6)]
    outward = complex(0.5, math.sqrt(0.75))
    for _ in range(level):
        ring = [p for a, b in zip(ring, ring[1:] + ring[:1])
                for p in (a, a + (b - a) / 3, a + (b - a) / 3 + (b - a) / 3 * outward, a + 2 * (b - a) / 3)]
    return [(p.real, p.imag) for p in ring]


def islands(count, seed=1):
    """Rings of 3 to 20 vertices and of very different sizes, apart from each other."""
    rng, discs, rings = random.Random(seed), [], []
    while len(discs) < count:
        x, y, r = rng.uniform(0.12, 0.88), rng.uniform(0.12, 0.88), 10 ** rng.uniform(-3.5, -1.5)
        if min(x, y, 1 - x, 1 - y) - r > 0.11 and all(math.hypot(x - a, y - b) > 1.05 * (r + s) for a, b, s in discs):
            discs.append((x, y, r))
    for x, y, r in discs:
        n = rng.randint(3, 20)
        radii = [r * rng.uniform(0.6, 1) for _ in range(n)]
        rings.append([(x + radii[k] * math.cos(2 * math.pi * k / n), y + radii[k] * math.sin(2 * math.pi * k / n))
                      for k in range(n)])
    return rings


def disc(name, x, y, radius):
    return f"[shape.{name}]\ntype = circle\ncenter = {x!r} {y!r}\nradius = {radius!r}\n"


def block(name, x_min, y_min, x_max, y_max):
    return (f"[shape.{name}]\ntype = rectangle\nx_min = {x_min!r}\nx_max = {x_max!r}\n"
            f"y_min = {y_min!r}\ny_max = {y_max!r}\n")


def config(shape, work):
    """Path of the config of a shape: rings, or the text of its sections."""
    if not isinstance(shape, str):
        (work / "c.xy").write_text("\n".join("".join(f"{x!r} {y!r}\n" for x, y in ring) for ring in shape), "ascii")
        shape = "[shape]\ngeometry = c\n[shape.c]\ntype = contour\nfile = c.xy\n"
    (work / "c.ini").write_text(shape, encoding="ascii")
    return work / "c.ini"


def two(region, first, second):
    """Sections of a region of two parts a and b."""
    return f"[shape]\ngeometry = {region}(a, b)\n" + first + second


ANNULUS = "[shape]\ngeometry = difference(a, b)\n" + disc("a", 0.5, 0.5, 0.4)


# What is finer than the triangles has bad ones; here the certificate is asked, not the angles.
ANY_ANGLES = "meshing.worst_alpha=1e300"


class HardShapes(unittest.TestCase):
    def mesh(self, shape, *overrides, euler=1, ranks=1):
        """Asserts a certified mesh; returns its hash and number of points."""
        with Workspace() as work:
            done = run(config(shape, work), ANY_ANGLES, *overrides, f"output.directory={work}", ranks=ranks,
                       timeout=TIMEOUT)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            with h5py.File(work / "c.h5", "r") as file:
                checks = file["trime_mpi/checks"]
                failed = [name for name, passed in zip(checks["name"][:], checks["passed"][:]) if not passed]
                found = dict(zip(checks["name"][:], checks["found"][:]))
                self.assertEqual(failed, [])
                self.assertEqual(found[b"euler_characteristic"], euler)
                self.assertEqual(len(file["Mesh/facets/values"]), found[b"boundary_segments"])
                return str(file["trime_mpi"].attrs["mesh_hash"]), len(file["Mesh/mesh/geometry"])

    def error(self, shape, *overrides, code, says):
        """Asserts an error with all of these words, a place among them."""
        with Workspace() as work:
            done = run(config(shape, work), *overrides, f"output.directory={work}", timeout=TIMEOUT)
            self.assertEqual(done.returncode, code, done.stdout + done.stderr)
            for words in says:
                self.assertIn(words, done.stderr)

    def test_sharp(self):
        self.mesh([wedge(1)], "meshing.points=1000")
        self.mesh([wedge(0.1)], "meshing.points=1000")
        self.error([wedge(1e-4)], "meshing.points=1000", "meshing.keep_features=true", code=3,
                   says=["too narrow near (0.1", "simplify the contour"])
        self.mesh([wedge(1e-4)], "meshing.points=1000")
        self.mesh([star(1000, 0.2, 0.45)], "meshing.points=20000")
        self.mesh([[(0.1, 0.1), (0.5, 0.1 + 7e-7), (0.9, 0.1), (0.9, 0.9), (0.1, 0.9)]], "meshing.points=500")

    def test_comb(self):
        first, _ = self.mesh([comb(10, 0.01)], "meshing.edge_length=0.04")
        self.assertEqual(self.mesh([comb(10, 0.01)], "meshing.edge_length=0.04", ranks=3)[0], first)

    def test_halving_runs_from_tooth_to_tooth(self):
        self.mesh([comb(40, 0.01)], "meshing.points=3000")
        self.mesh([comb(40, 0.01)], "meshing.points=1000", "sizing.type=automatic")
        self.error([comb(40, 0.01)], "meshing.points=1000", "sizing.type=automatic", "meshing.keep_features=true",
                   code=2,
                   says=["points = 1000 are too few", "boundary alone needs",
                         "the shortest boundary edge, 0.01 long, is at ("])

    def test_touching(self):
        self.error(two("union", disc("a", 0.3, 0.5, 0.2), disc("b", 0.7, 0.5, 0.2)), "meshing.points=1000", code=3,
                   says=["touches itself at (0.5, 0.5) (part 'a', 'b')", "move the parts apart"])
        self.error(two("union", block("a", 0.1, 0.1, 0.5, 0.5), block("b", 0.5, 0.5, 0.9, 0.9)), "meshing.points=1000",
                   code=3, says=["touches itself at (0.5, 0.5)"])
        self.error([rectangle(0.1, 0.1, 0.5, 0.5), rectangle(0.5, 0.2, 0.9, 0.4)], "meshing.points=1000", code=3,
                   says=["c.xy:2: the edge that starts here touches", "(0.5, 0.2)", "dissolve their common borders"])

    def test_rings_that_touch_in_a_vertex(self):
        self.mesh([rectangle(0.1, 0.1, 0.5, 0.5), rectangle(0.5, 0.5, 0.9, 0.9)], "meshing.points=1000", euler=2)
        self.mesh([SQUARE, [(0.5, 0.1), (0.6, 0.3), (0.4, 0.3)]], "meshing.points=1000")  # the hole becomes a bay
        self.mesh([[(0.1, 0.1), (0.5, 0.5), (0.9, 0.1), (0.9, 0.9), (0.5, 0.5), (0.1, 0.9)]], "meshing.points=1000",
                  "sizing.type=automatic", euler=2)

    def test_nearly_touching(self):
        near = two("union", disc("a", 0.3, 0.5, 0.2), disc("b", 0.7, 0.5, 0.2 - 1e-7))
        self.mesh(near, "meshing.points=1000", euler=2)
        self.mesh(near, "meshing.points=1000", "sizing.type=automatic", euler=2)
        self.error(near, "meshing.points=1000", "sizing.type=automatic", "meshing.keep_features=true", code=2,
                   says=["too few", " is at (0.5", ", 0.499"])
        self.mesh(two("union", block("a", 0.1, 0.1, 0.5, 0.5), block("b", 0.5, 0.2, 0.9, 0.4)), "meshing.points=500")

    def test_slit(self):
        self.error([SQUARE[:2] + [(0.9, 0.5), (0.5, 0.5), (0.9, 0.5)] + SQUARE[2:]], "meshing.points=1000", code=3,
                   says=["c.xy:4: the ring turns straight back at (0.5, 0.5)", "remove the spike"])
        self.error([SQUARE, [(0.3, 0.5), (0.5, 0.5), (0.7, 0.5)]], "meshing.points=1000", code=3,
                   says=["c.xy:6:", "encloses no area"])
        for width in (1e-3, 1e-6, 1e-11):
            self.mesh([SQUARE, rectangle(0.3, 0.5, 0.7, 0.5 + width)], "meshing.points=1000", euler=0)
        fine = [SQUARE, rectangle(0.3, 0.5, 0.7, 0.5 + 1e-6)]
        self.mesh(fine, "meshing.points=1000", "sizing.type=automatic", euler=0)
        self.error(fine, "meshing.points=1000", "sizing.type=automatic", "meshing.keep_features=true", code=2,
                   says=["boundary alone needs more than 1500", "simplify the shape there"])

    def test_islands(self):
        sea, keep = [SQUARE] + islands(200), "meshing.keep_features=true"
        first, points = self.mesh(sea, "meshing.points=8000", keep, euler=1 - 200)
        self.assertGreater(points, 7900)
        self.assertEqual(self.mesh(sea, "meshing.points=8000", keep, euler=1 - 200, ranks=3)[0], first)

    def test_annulus(self):
        for width in (0.02, 0.003):
            self.mesh(ANNULUS + disc("b", 0.5, 0.5, 0.4 - width), "meshing.edge_length=0.01", euler=0)
        pinhole = ANNULUS + disc("b", 0.5, 0.5, 1e-6)
        self.mesh(pinhole, "meshing.points=1000", "meshing.keep_features=true", euler=0)
        self.mesh(pinhole, "meshing.points=1000", euler=1)  # below the resolution
        thin = ANNULUS + disc("b", 0.5, 0.5, 0.4 - 1e-5)
        self.mesh(thin, "meshing.points=1000", "sizing.type=automatic", euler=0)
        self.error(thin, "meshing.points=1000", "sizing.type=automatic", "meshing.keep_features=true", code=2,
                   says=["boundary alone needs more than"])

    def test_needle(self):
        self.mesh([rectangle(0.05, 0.5, 0.95, 0.50009)], "meshing.points=1000")

    def test_snowflake(self):
        self.mesh([koch(7)], "meshing.points=100000")
        self.mesh([rectangle(0.01, 0.01, 0.99, 0.99), koch(5)], "meshing.points=10000", euler=0)
        self.error([koch(7)], "meshing.points=1000", "meshing.keep_features=true", code=2,
                   says=["boundary alone needs more than 49152"])


if __name__ == "__main__":
    unittest.main()
