#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests what regions lose when their interfaces are simplified: ragged interfaces keep areas, thin wedges are cut, thin
layers stay whole, and the table of losses explains each area.
"""
import math
import re
import subprocess
import unittest

import h5py
import numpy as np

from regions_test import CHECK, RegionsTest
from region_meshes import Mesh, circle, rectangle, region, triangle

ROUNDING = 1e-12


def area_of(ring):
    return 0.5 * math.fsum(a[0] * b[1] - b[0] * a[1] for a, b in zip(ring, ring[1:] + ring[:1]))


def ragged_circle(seed, count, noise):
    radii = 0.3 * (1 + noise * np.random.default_rng(seed).uniform(-1, 1, count))
    return [(0.5 + r * math.cos(2 * math.pi * k / count), 0.5 + r * math.sin(2 * math.pi * k / count))
            for k, r in enumerate(radii.tolist())]


def ragged_wave(seed, count, noise):
    heights = 0.5 + noise * np.random.default_rng(seed).uniform(-1, 1, count + 1)
    return [(0.0, 0.0), (1.0, 0.0)] + [(1 - k / count, y + 0.05 * math.sin(4 * math.pi * k / count))
                                       for k, y in enumerate(heights.tolist())]


def components(mesh, name):
    """The number of parts of a region whose triangles are connected by edges."""
    own = mesh.triangles[mesh.region == mesh.numbers[name]].tolist()
    root = list(range(len(own)))

    def find(k):
        while root[k] != k:
            root[k] = k = root[root[k]]
        return k
    first = {}
    for k, corners in enumerate(own):
        for a, b in zip(corners, corners[1:] + corners[:1]):
            root[find(k)] = find(first.setdefault((min(a, b), max(a, b)), k))
    return sum(find(k) == k for k in range(len(own)))


class LossesTest(RegionsTest):
    def table(self):
        """{(loser, winner, reason): area}; trime_check has added it up if there are any rows."""
        with h5py.File(self.directory / "mesh.h5") as file:
            names = [name.decode() for name in file["/trime_mpi/tags/region_name"]]
            rows = file.get("/trime_mpi/region_losses")
            return {} if rows is None else {
                (names[loser - 1], names[winner - 1], reason.decode()): area for loser, winner, reason, area in
                zip(*(rows[name][:] for name in ("loser", "winner", "reason", "area")))}

    def lost_by(self, name):
        """The area that a region has lost, less what it has gained."""
        return math.fsum(area * ((loser == name) - (winner == name))
                         for (loser, winner, _), area in self.table().items())

    def fan(self, middle, angles, length=0.45):
        """Regions between rays from a point: triangles with the given angles in degrees, and their names."""
        text, names = "", []
        start = 0.3
        for k, angle in enumerate(angles):
            ends = [(middle[0] + length * math.cos(a), middle[1] + length * math.sin(a))
                    for a in (math.radians(start), math.radians(start + angle))]
            text += triangle(f"t{k}", middle, *ends) + region(f"r{k}", f"t{k}")
            names.append(f"r{k}")
            start += angle
        return text, names


class Ragged(LossesTest):
    def test_areas_stay(self):
        for name, ring in (("circle", ragged_circle(11, 500, 0.015)), ("circle", ragged_circle(12, 900, 0.01)),
                           ("wave", ragged_wave(13, 400, 0.005)), ("wave", ragged_wave(14, 900, 0.003))):
            self.write("part.xy", ring)
            mesh = self.mesh("[shape.part]\ntype = contour\nfile = part.xy\n" + region("inner", "part"))
            self.assertAlmostEqual(mesh.area("inner"), area_of(ring), delta=ROUNDING, msg=name)
            self.assertLessEqual(mesh.alpha(), 1.2)
            self.assertEqual(self.table(), {})

    def test_smooth_circles_keep_their_points(self):
        """Chords of a circle lose their segments, and the table says it; no point leaves the circle."""
        mesh = self.mesh("[shape.part]\ntype = circle\ncenter = 0.5 0.5\nradius = 0.3\n" + region("inner", "part"))
        (key, lost), = self.table().items()
        self.assertEqual(key, ("inner", "domain", "chords"))
        self.assertAlmostEqual(mesh.area("inner") + lost, 0.09 * math.pi, delta=1e-10)
        self.assertLess(np.abs(np.hypot(*(mesh.points[mesh.edges.ravel()] - 0.5).T) - 0.3).max(), 1e-12)


class Followed(LossesTest):
    def test_curves_along_circles(self):
        """A curve that follows a circular interface nearer than the triangles can show becomes one line with it."""
        for distance, first, last in ((0.05, 0.0, 1.0), (0.15, 0.0, 0.4), (-0.15, 0.1, 0.7)):
            radius = 0.2 + distance * 0.024
            arc = [(0.5 + radius * math.cos(2 * math.pi * t), 0.5 + radius * math.sin(2 * math.pi * t))
                   for t in np.linspace(first, last, 60).tolist()]
            self.write("line.xy", arc)
            done = self.run_config(circle("part", 0.2) + region("inner", "part") + "[curve.line]\nfile = line.xy\n")
            self.assertEqual(done.returncode, 0, done.stderr)
            judged = subprocess.run([CHECK, self.directory / "mesh.h5"], capture_output=True, text=True, check=False)
            self.assertEqual(judged.returncode, 0, judged.stdout)
            mesh = Mesh(self.directory / "mesh.h5")
            self.assertLessEqual(mesh.alpha(), 1.3, distance)
            self.assertAlmostEqual(mesh.area("inner") + self.lost_by("inner"), 0.04 * math.pi, delta=1e-10)
            length = mesh.curve_lengths["line"]
            self.assertAlmostEqual(length / (2 * math.pi * 0.2 * (last - first)), 1, delta=0.03)


class Wedges(LossesTest):
    def wedge(self, angle):
        height = math.tan(math.radians(angle))
        return (rectangle("bottom", (0, 0), (1, 0.25)) + region("base", "bottom") +
                triangle("thin", (0.0, 0.25), (1.0, 0.25), (1.0, 0.25 + height)) + region("wedge", "thin"))

    def test_thin_tips_are_cut(self):
        for angle in (3.0, 8.0, 19.0):
            mesh = self.same_on_all(self.wedge(angle), shape="geometry = domain\nrest = top")
            (key, lost), = self.table().items()
            self.assertEqual(key, ("wedge", "top", "pinch-out"))
            self.assertAlmostEqual(mesh.area("wedge") + lost, 0.5 * math.tan(math.radians(angle)), delta=ROUNDING)
            x, y = mesh.meeting_point("top", "base", "wedge")
            self.assertLess(abs(y - 0.25), ROUNDING)
            self.assertAlmostEqual(2 * x * math.sin(math.radians(0.5 * angle)), 0.5 * 0.024, delta=0.002)
            self.assertIn((0.0, 0.25), mesh.junctions())
            self.assertIn("wedge to top", self.report)

    def test_wide_tips_stay(self):
        for angle in (21.0, 35.0):
            mesh = self.mesh(self.wedge(angle), shape="geometry = domain\nrest = top")
            self.assertAlmostEqual(mesh.area("wedge"), 0.5 * math.tan(math.radians(angle)), delta=ROUNDING)
            self.assertEqual(self.table(), {})

    def test_regions_keep_their_components(self):
        """Rays that meet inside of the shape; each region stays in one part and keeps most of its area."""
        for seed in (21, 22, 23):
            random = np.random.default_rng(seed)
            angles = random.uniform(4, 30, 8).tolist()
            text, names = self.fan((0.45 + 0.1 * random.random(), 0.5), angles)
            mesh = self.mesh(text, shape="geometry = domain\nrest = rest", points=3000)
            self.assertAlmostEqual(math.fsum(mesh.areas), 1, delta=ROUNDING)
            self.assertTrue(any(reason == "pinch-out" for _, _, reason in self.table()))
            for name, angle in zip(names, angles):
                self.assertEqual(components(mesh, name), 1, name)
                self.assertGreater(mesh.area(name), 0.5 * 0.5 * 0.45**2 * math.sin(math.radians(angle)))

    def test_thin_layers_stay_whole(self):
        """A dyke with a width of 0.3 h, and one that begins as a wedge and is never as wide as the cut."""
        h = 0.024
        for bottom in ([(0.0, 0.5), (1.0, 0.5)], [(0.05, 0.5), (1.0, 0.5)]):
            is_wedge = bottom[0][0] > 0
            ring = bottom + [(1.0, 0.5 + 0.3 * h), (0.1, 0.5 + 0.3 * h)] + ([] if is_wedge else [(0.0, 0.5 + 0.3 * h)])
            self.write("dyke.xy", ring)
            self.write("low.xy", [(0.0, 0.0), (1.0, 0.0), (1.0, 0.5), *(bottom[:1] if is_wedge else []), (0.0, 0.5)])
            text = ("[shape.vein]\ntype = contour\nfile = dyke.xy\n[shape.below]\ntype = contour\nfile = low.xy\n" +
                    region("low", "below") + region("dyke", "vein"))
            mesh = self.mesh(text, shape="geometry = domain\nrest = top")
            self.assertEqual(components(mesh, "dyke"), 1)
            self.assertAlmostEqual(mesh.area("dyke") + self.lost_by("dyke"), area_of(ring), delta=1e-11)
            self.assertFalse(any(reason == "pinch-out" for _, _, reason in self.table()))
            self.assertLess(abs(self.lost_by("dyke")), 0.01 * area_of(ring))

    def test_a_thin_layer_makes_no_region_vanish(self):
        """A seam of 0.17 h across the shape takes more points than there are: an error with a number that suffices.
        Runs with too few points once made the triangles larger until the layers next to the seam were gone."""
        text = (rectangle("across", (-0.1, 0.5), (1.1, 0.504)) + rectangle("below", (-0.1, -0.1), (1.1, 0.5)) +
                region("seam", "across") + region("low", "below"))
        done = self.run_config(text, points=2000, shape="geometry = domain\nrest = top", ranks=3)
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
        enough = int(re.search(r"points = 2000 are too few .*; (\d+) points are enough", done.stderr)[1])
        mesh = self.mesh(text, points=enough, shape="geometry = domain\nrest = top")
        for name, area in (("seam", 0.004), ("low", 0.5), ("top", 0.496)):
            self.assertAlmostEqual(mesh.area(name), area, delta=1e-9)


class Table(LossesTest):
    def test_damage_is_found(self):
        self.mesh("[shape.part]\ntype = circle\ncenter = 0.5 0.5\nradius = 0.3\n" + region("inner", "part"))
        judged = subprocess.run([CHECK, self.directory / "mesh.h5"], capture_output=True, text=True, check=False)
        self.assertRegex(judged.stdout, r"(?m)^ok +region_losses")
        for name, value in (("area", 1e-3), ("loser", 1), ("winner", 7)):
            with h5py.File(self.directory / "mesh.h5", "r+") as file:
                column = file["/trime_mpi/region_losses/" + name]
                before = column[0]
                column[0] = value
            judged = subprocess.run([CHECK, self.directory / "mesh.h5"], capture_output=True, text=True, check=False)
            self.assertRegex(judged.stdout, r"(?m)^WRONG +region_loss")
            with h5py.File(self.directory / "mesh.h5", "r+") as file:
                file["/trime_mpi/region_losses/" + name][0] = before


if __name__ == "__main__":
    unittest.main()
