#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests that small bodies in a large domain are judged by their own size. Public reports of users of mesh generators
gave the kinds of shape: foils, wells, piles, plates with many holes, holes that touch, needles, films.
"""
import math
import re
import unittest

import h5py
import numpy

from trime_run import Workspace, run

SQUARE = [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)]


def circle(radius, corners, middle=(0, 0)):
    turn = 2 * math.pi / corners
    return [(middle[0] + radius * math.cos(turn * k), middle[1] + radius * math.sin(turn * k)) for k in range(corners)]


def box(side):
    return [(side * x, side * y) for x, y in SQUARE]


def foil(chord, corners=40):
    """The symmetric NACA foil of 12 % thickness."""
    lower, upper = [], []
    for k in range(corners + 1):
        x = 0.5 * (1 - math.cos(math.pi * k / corners))
        y = 0.6 * (0.2969 * math.sqrt(x) - 0.126 * x - 0.3516 * x**2 + 0.2843 * x**3 - 0.1036 * x**4)
        lower.append((chord * x, -chord * y))
        upper.append((chord * x, chord * y))
    return lower + upper[-2:0:-1]


def area_of(ring):
    return abs(sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(ring, ring[1:] + ring[:1]))) / 2


def area_of_mesh(path):
    """Sums over the triangles of the file."""
    with h5py.File(path, "r") as file:
        corners = file["Mesh/mesh/geometry"][:][file["Mesh/mesh/topology"][:]]
    a, b = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    return 0.5 * float(numpy.sum(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]))


class Runs(unittest.TestCase):
    """What the tests below share."""

    def mesh(self, work, rings, *overrides, exits=(0,)):
        """A run on the area between the first ring and the others."""
        (work / "rings.xy").write_text("\n\n".join("\n".join(f"{x!r} {y!r}" for x, y in ring) for ring in rings) + "\n",
                                       "ascii")
        (work / "it.ini").write_text("[shape]\ngeometry = it\n[shape.it]\ntype = contour\nfile = rings.xy\n", "ascii")
        done = run(work / "it.ini", "output.overwrite=true", "--quiet", f"output.directory={work}", *overrides)
        self.assertIn(done.returncode, exits, (overrides, done.stdout + done.stderr))
        return done.stdout + done.stderr

    def points(self, path):
        with h5py.File(path, "r") as file:
            return file["Mesh/mesh/geometry"][:]


class Bodies(Runs):
    def test_area_is_kept_or_the_body_is_named(self):
        """Bodies of 0.001 to 0.1 of the domain."""
        with Workspace() as work:
            for body in (foil, lambda size: circle(0.5 * size, 48), box):
                for size in (0.001, 0.003, 0.01, 0.03, 0.1):
                    for sizing in ("uniform", "automatic"):
                        ring = body(size)
                        text = self.mesh(work, [SQUARE, ring], "meshing.points=2000", f"sizing.type={sizing}")
                        grown = (1 - area_of_mesh(work / "it.h5")) / area_of(ring) - 1
                        case = (size, sizing, grown, text)
                        if grown < -0.999:
                            self.assertIn("1 hole became 0: 1 hole was filled", text, case)
                        elif abs(grown) > 0.02:
                            told = re.search(r"of part 'it' at \(.*\) \[.*rings.xy:\d+\], [\d.]+ h around, "
                                             r"has ([\d.]+) % (more|less) area", text)
                            self.assertIsNotNone(told, case)
                            self.assertEqual(told[2], "more" if grown > 0 else "less", case)
                            self.assertAlmostEqual(float(told[1]) / 100, abs(grown), delta=0.02, msg=case)

    def test_a_tip_that_is_cut_off_is_named(self):
        """It has no area to speak of."""
        thorn = [(-0.2, -0.2), (0.2, -0.2), (0.2, 0.2), (0.001, 0.2), (0, 0.4), (-0.001, 0.2), (-0.2, 0.2)]
        with Workspace() as work:
            text = self.mesh(work, [thorn], "meshing.points=400")
            deepest = max(point[1] for point in self.points(work / "it.h5"))
            if deepest < 0.37:
                self.assertIn("lost a tip that is", text)

    def test_the_table_has_the_area_of_each_loop(self):
        with Workspace() as work:
            self.mesh(work, [SQUARE, circle(0.05, 48), circle(0.1, 48, (0.25, 0.25))], "meshing.points=2000")
            with h5py.File(work / "it.h5", "r") as file:
                table = {name: file["trime_mpi/rings"][name][:] for name in ("area", "mesh_area", "deviation", "reach")}
                given = file["trime_mpi"].attrs["given_area"]
            self.assertAlmostEqual(given, 1 - area_of(circle(0.05, 48)) - area_of(circle(0.1, 48)), places=9)
            areas = sorted(table["mesh_area"])
            self.assertAlmostEqual(areas[2] - areas[1] - areas[0], area_of_mesh(work / "it.h5"), places=12)
            for area, mesh_area, deviation in zip(table["area"], table["mesh_area"], table["deviation"]):
                self.assertLess(mesh_area, area * (1 + 1e-12))
                self.assertLess(deviation, 0.02)
            self.assertEqual(max(table["reach"]), 0)

    def test_holes_of_a_plate(self):
        """Their chords make the plate larger, which a warning says from 0.1 % on."""
        for count, points, quiet in ((10, 2000, False), (10, 40000, True)):
            holes = [circle(0.025, 96, (-0.45 + 0.1 * i, -0.45 + 0.1 * k)) for i in range(count) for k in range(count)]
            with Workspace() as work:
                text = self.mesh(work, [SQUARE] + holes, f"meshing.points={points}")
                grown = area_of_mesh(work / "it.h5") / (1 - count**2 * area_of(holes[0])) - 1
            told = re.search(r"he mesh is ([\d.]+) % larger than the shape, since its edges are chords", text)
            self.assertEqual(grown <= 0.001, told is None, (grown, text))
            if told:
                self.assertAlmostEqual(float(told[1]) / 100, grown, delta=0.1 * grown)


def wedges(degrees, half=40, length=0.5):
    """Two triangles that touch in the origin; above it, the area between them has this angle."""
    def triangle(*directions):
        return [(0, 0)] + [(length * math.cos(math.radians(d)), length * math.sin(math.radians(d)))
                           for d in directions]
    right, left = 90 - degrees / 2, 90 + degrees / 2
    return [triangle(right - 2 * half, right), triangle(left, left + 2 * half)]


class Reports(Runs):
    """Other kinds of public reports."""

    def attributes(self, path):
        with h5py.File(path, "r") as file:
            return dict(file["trime_mpi"].attrs)

    def test_holes_that_touch(self):
        """At any angle and size, in one file or subtracted. Nothing is connected through the place."""
        outer = [(2 * x, 2 * y) for x, y in SQUARE]
        with Workspace() as work:
            for degrees in (1, 2, 5, 11, 20, 30, 45, 60):
                for points in (200, 1000, 5000):
                    for keeps in ("false", "true"):
                        text = self.mesh(work, [outer] + wedges(degrees), f"meshing.points={points}",
                                         f"meshing.keep_features={keeps}")
                        self.assertIn("two rings touch at (0, 0)", text)
                        made = self.attributes(work / "it.h5")
                        self.assertEqual((made["components"], made["holes"]), (1, 1), (degrees, points, keeps, text))

    def test_holes_that_touch_and_are_subtracted(self):
        with Workspace() as work:
            rings = ["\n".join(f"{x!r} {y!r}" for x, y in ring) for ring in wedges(30)]
            (work / "holes.xy").write_text("\n\n".join(rings) + "\n", "ascii")
            (work / "it.ini").write_text(
                "[shape]\ngeometry = difference(box, holes)\n[shape.holes]\ntype = contour\nfile = holes.xy\n"
                "[shape.box]\ntype = rectangle\nx_min = -1\nx_max = 1\ny_min = -1\ny_max = 1\n", "ascii")
            for points in (200, 1000, 5000):
                for keeps in ("false", "true"):
                    done = run(work / "it.ini", "output.overwrite=true", "--quiet", f"output.directory={work}",
                               f"meshing.points={points}", f"meshing.keep_features={keeps}")
                    self.assertEqual(done.returncode, 0, (points, keeps, done.stdout + done.stderr))
                    made = self.attributes(work / "it.h5")
                    self.assertEqual((made["components"], made["holes"]), (1, 1), (points, keeps))

    def test_needles(self):
        """No triangle as long as the wedge is wide is good, so none of these fails."""
        for degrees in (1, 3):
            half = math.tan(math.radians(degrees / 2))
            needle = [(0, 0), (1, -half), (2, -0.6), (2, 0.6), (1, half)]
            with Workspace() as work:
                for points in (1000, 3000, 10000):
                    self.mesh(work, [needle], f"meshing.points={points}")

    def test_a_film_is_refused(self):
        film = [(7.5, -0.5), (2, -0.5), (2, -0.49999997), (7.5, -0.49999997)]
        with Workspace() as work:
            for keys in (["meshing.edge_length=0.01"],
                         ["meshing.points=500", "sizing.type=automatic"]):
                text = self.mesh(work, [film], *keys, exits=(2,))
                self.assertRegex(text, "for this shape", keys)
                self.assertFalse((work / "it.h5").exists())

    def test_advice_of_the_dry_run_is_right(self):
        """Ten shapes: the numbers are taken at their word."""
        holes = [circle(0.004 * (1 + k), 24, (-0.4 + 0.2 * k, 0.1)) for k in range(5)]
        comb = [(-0.5, -0.5), (0.5, -0.5)] + [p for k in range(6) for p in (
            (0.5 - k / 6, 0.4), (0.48 - k / 6, 0.4), (0.48 - k / 6, -0.4), (0.5 - (k + 1) / 6, -0.4))]
        neck = [(0, 0), (1, 0), (1, 0.49), (2, 0.49), (2, 0), (3, 0), (3, 1), (2, 1), (2, 0.51), (1, 0.51), (1, 1),
                (0, 1)]
        shapes = [[SQUARE] + holes, [comb], [neck], [SQUARE, foil(0.1)]]
        cases = [(shape, sizing) for shape in shapes for sizing in ("uniform", "automatic")]
        cases += [([foil(1)], "uniform"), ([SQUARE, box(0.01), circle(0.02, 48, (0.2, 0.2))], "uniform")]
        self.assertEqual(len(cases), 10)
        for rings, sizing in cases:
            with Workspace() as work:
                keys = [f"sizing.type={sizing}", "sizing.gradation=0.2"]
                text = self.mesh(work, rings, "meshing.points=100", *keys, "--dry-run")
                advice = [f"meshing.{key}={number}" for key, number in re.findall(
                    r"(edge_length) = ([0-9.e-]+) keeps everything; that was tried", text)]
                advice += [f"meshing.points={number}" for number in re.findall(
                    r"(\d+) points keep everything; that was tried", text)]
                for number in advice:
                    both = ["meshing.points=", number] if "edge_length" in number else [number]
                    self.mesh(work, rings, *both, *keys, "meshing.max_sweeps=0", exits=(0, 5))
                    made = self.attributes(work / "it.h5")
                    lost = [made[name] for name in ("narrow_cut", "narrow_closed", "narrow_widened", "holes_filled",
                                                    "dropped_lakes", "dropped_islands")]
                    self.assertEqual(sum(lost), 0, (number, lost, text))

    def test_what_components_leaves_out_is_not_lost(self):
        far = [(x + 1.5, y) for x, y in box(0.8)]
        with Workspace() as work:
            text = self.mesh(work, [SQUARE, far], "meshing.points=500", "meshing.components=largest")
            self.assertIn("2 components became 1: 1 component was left out as meshing.components asks for", text)
            for words in ("dropped", "are lost", "is lost (", "More points"):
                self.assertNotIn(words, text)
            with h5py.File(work / "it.h5", "r") as file:
                self.assertEqual(sorted(file["trime_mpi/rings/state"].asstr()[:]), ["kept", "left_out"])
            (work / "points.xy").write_text("1.5 0.1\n", "ascii")
            text = self.mesh(work, [SQUARE, far], "meshing.points=500", "meshing.components=largest",
                             "meshing.fixed_points=points.xy", exits=(3,))
            self.assertRegex(text, r"points.xy:1: the fixed point \(1.5, 0.1\).* lies in a component of the shape that "
                                   r"meshing.components leaves out; expected a point in the component that is meshed")

    def test_cuts_leave_no_pieces_of_a_few_triangles(self):
        """A chain of ponds below the resolution between two lakes: with connect = cut it goes."""
        ring, back = [], []
        for k in range(61):
            x, wide = k / 20, 0.012 + 0.03 * (0.5 - 0.5 * math.cos(2 * math.pi * k / 10))
            ring.append((x, -wide))
            back.append((x, wide))
        east = [(3, -0.5), (4, -0.5), (4, 0.5), (3, 0.5)]
        lakes = [(-1, -0.5), (0, -0.5)] + ring + east + back[::-1] + [(0, 0.5), (-1, 0.5)]
        with Workspace() as work:
            for points in (150, 300, 600, 1200):
                text = self.mesh(work, [lakes], f"meshing.points={points}", "meshing.connect=cut")
                with h5py.File(work / "it.h5", "r") as file:
                    triangles = file["Mesh/mesh/topology"][:]
                parent = {}

                def root(k):
                    while parent.setdefault(k, k) != k:
                        k = parent[k]
                    return k

                for a, b, c in triangles:
                    parent[root(a)] = root(b)
                    parent[root(b)] = root(c)
                sizes = numpy.unique([root(a) for a, _, _ in triangles], return_counts=True)[1]
                self.assertGreaterEqual(min(sizes), 9, (points, sizes, text))
                foretold = self.mesh(work, [lakes], f"meshing.points={points}", "meshing.connect=cut", "--dry-run")
                for words in re.findall(r"1 component became \d+: \d+ necks? w[a-z]+ cut", text):
                    self.assertIn(words, foretold)

    def test_choice_of_component_outside_of_the_shape(self):
        with Workspace() as work:
            text = self.mesh(work, [SQUARE], "meshing.points=500", "meshing.components=at 5 5",
                             f"output.directory={work / 'new'}", exits=(3,))
            self.assertIn("meshing.components = at: the place (5, 5)", text)
            self.assertFalse((work / "new").exists())
            text = self.mesh(work, [SQUARE], "meshing.points=500", "meshing.max_loss=1.5", exits=(2,))
            self.assertIn("'max_loss = 1.5' in [meshing]: expected none or a number from 0 to 1", text)


if __name__ == "__main__":
    unittest.main()
