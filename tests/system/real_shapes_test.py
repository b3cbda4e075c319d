#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests that the shapes of real_shapes.py have their promised properties, and that judge.py measures correctly on
known meshes."""
import math
import pathlib
import subprocess
import sys
import unittest

import numpy as np

import judge
import real_shapes
from mesh_measures import Curve, MeshMeasures, distance_to_segments
from real_coasts import coast
from ring_tools import crossings, even_odd_area, rings_of, signed_area, simple_rings, text_of
from trime_run import Workspace, run

SQUARE = np.array([(0.0, 0.0), (1, 0), (1, 1), (0, 1)])


def shortest_and_size(rings):
    """Lengths of all sides, and the longer side of the box."""
    points = np.concatenate(rings)
    sides = np.concatenate([np.hypot(*(np.roll(ring, -1, axis=0) - ring).T) for ring in rings])
    return sides, np.ptp(points, axis=0).max()


def angle_at(ring, vertex):
    """Inside angle of a counter-clockwise ring, in degrees."""
    before, at, after = (ring[(vertex + k) % len(ring)] for k in (-1, 0, 1))
    out, back = after - at, before - at
    return math.degrees(math.atan2(out[0] * back[1] - out[1] * back[0], out @ back)) % 360


class Shapes(unittest.TestCase):
    def test_no_two_sides_cross_and_counts_are_as_asked(self):
        for kind in real_shapes.KINDS:
            for seed, vertices in ((31, 400), (32, 1200)):
                with self.subTest(kind=kind, seed=seed):
                    rings = rings_of(text_of(real_shapes.shape(kind, seed, vertices)))
                    self.assertEqual(sum(map(len, rings)), vertices)
                    self.assertGreater(even_odd_area(rings), 0)
                    if kind == "twice":
                        self.assertEqual(set(map(tuple, rings[-1])), set(map(tuple, rings[1])))
                        rings = rings[:-1]
                    self.assertEqual(crossings(rings), [])

    def test_a_seed_gives_one_text(self):
        for kind in real_shapes.KINDS:
            texts = [text_of(real_shapes.shape(kind, seed, 300)) for seed in (5, 5, 6)]
            self.assertEqual(texts[0], texts[1], kind)
            self.assertNotEqual(texts[0], texts[2], kind)

    def test_the_sets_share_no_seed(self):
        self.assertTrue(all(seed < 1000 for _, seed, _ in real_shapes.TUNING))
        self.assertTrue(all(seed > 1000 for _, seed, _ in real_shapes.HELD_OUT))
        for shapes in (real_shapes.TUNING, real_shapes.HELD_OUT):
            self.assertEqual({kind for kind, _, _ in shapes}, set(real_shapes.KINDS))
            self.assertEqual(len(set(shapes)), len(shapes))

    def test_a_coast_has_islands_by_power_law_and_lakes(self):
        rings = coast(2, 4000)
        areas = np.array([signed_area(ring) for ring in rings])
        self.assertGreater((areas < 0).sum(), 10)
        self.assertGreater((areas > 0).sum(), 30)
        self.assertGreater(np.abs(areas).max() / np.abs(areas).min(), 1e5)
        self.assertEqual(sum(map(len, coast(4, 30000))), 30000)

    def test_vertices_that_nearly_coincide(self):
        sides, size = shortest_and_size(real_shapes.shape("near_vertices", 3, 1000))
        self.assertEqual((sides < 1.1e-7 * size).sum(), 500)
        self.assertGreater(sides.min(), 1e-9 * size)

    def test_the_three_cases_of_the_issue(self):
        ring, = real_shapes.shape("crack", 1, 8)
        np.testing.assert_array_equal(ring[3:5], [(0.5, 0.5), (0.5, 0.5001)])
        ring, = real_shapes.shape("tip", 1, 9)
        np.testing.assert_array_equal(np.round(ring[3:6], 9), [(1.3, 0.499999), (1.3000004, 0.5), (1.3, 0.500001)])
        ring, = real_shapes.shape("wave", 1, 5000)
        self.assertAlmostEqual(float(np.hypot(*ring.T).max()), 1.101, places=4)

    def test_needles_have_their_angles(self):
        ring, = real_shapes.shape("needles", 7, 36)
        self.assertGreater(signed_area(ring), 0)
        sharp = sorted(angle for k in range(36) if (angle := angle_at(ring, k)) < 16)
        np.testing.assert_allclose(sharp, [2, 2, 5, 5, 15, 15], rtol=0.01)
        notches = sorted(360 - angle for k in range(36) if (angle := angle_at(ring, k)) > 340)
        np.testing.assert_allclose(notches, [2, 2, 5, 5, 15, 15], rtol=0.01)

    def test_cells_nearly_touch(self):
        cells = real_shapes.shape("near_touch", 8, 1000)
        gaps = []
        for k, cell in enumerate(cells):
            others = [ring for m, ring in enumerate(cells) if m != k]
            curve = Curve(np.concatenate(others), np.concatenate([np.roll(ring, -1, axis=0) for ring in others]))
            gaps.append(curve.distance(cell)[0].min())
        self.assertTrue(all(0 < gap < 1e-3 for gap in gaps), gaps)
        self.assertLess(min(gaps), 1e-5)

    def test_rings_that_touch(self):
        rings = real_shapes.shape("touching", 9, 400)
        points = [tuple(point) for ring in rings for point in ring]
        self.assertEqual(len(points) - len(set(points)), 5 + 1 + 1)  # knots, the pair, the hole
        self.assertEqual(len(simple_rings(rings)), len(rings) + 5)

    def test_crossings_are_found(self):
        for other in (SQUARE + (0.5, 0.25), SQUARE[:3] * 0.5 + (0.5, 0), SQUARE + (1, 0.5), SQUARE,
                      np.array([(1.0, 0.5), (2, 0.2), (2, 0.8)])):
            self.assertNotEqual(crossings([SQUARE, other]), [], other)
        for other in (SQUARE + (1, 1), SQUARE * 0.5 + 0.25, SQUARE + (1 + 1e-12, 0)):
            self.assertEqual(crossings([SQUARE, other]), [], other)

    def test_area_by_even_odd(self):
        inner = [SQUARE * 0.5 + 0.25, SQUARE * 0.25 + 0.375]
        self.assertAlmostEqual(even_odd_area([SQUARE, *inner]), 1 - 0.25 + 0.0625)
        self.assertAlmostEqual(even_odd_area([SQUARE, inner[0], inner[0][::-1]]), 0.75)
        bow_tie = np.array([(0.0, 0.0), (1, 1), (1, 0), (0, 0), (-1, 0), (-1, 1)])
        self.assertAlmostEqual(even_odd_area([bow_tie]), 1)


class Measures(unittest.TestCase):
    def test_distance_is_that_of_trying_all(self):
        rng = np.random.default_rng(1)
        starts = rng.random((300, 2))
        ends = starts + rng.normal(size=(300, 2)) * 10.0 ** -rng.integers(0, 5, (300, 1))
        points = 3 * rng.random((500, 2)) - 1
        found, which = Curve(starts, ends).distance(points)
        every = np.stack([distance_to_segments(points, np.tile(a, (500, 1)), np.tile(b, (500, 1)))
                          for a, b in zip(starts, ends)])
        np.testing.assert_allclose(found, every.min(axis=0), rtol=1e-12)
        np.testing.assert_allclose(every[which, np.arange(500)], found, rtol=1e-12)

    def test_a_needle_excuses_only_what_lies_in_it(self):
        # A strip of bad triangles from the tip of 5 degrees; h = 0.1, so the arms are near up to 1.38.
        height = math.tan(math.radians(5))
        x = np.arange(0.0, 3.01, 0.1)
        n, along = len(x) - 1, np.stack([x[1:], 0 * x[1:]], axis=1)
        points = np.concatenate([[(0.0, 0.0)], along, along + np.stack([0 * x[1:], height * x[1:]], axis=1)])
        triangles = [(0, 1, n + 1)]
        for k in range(1, n):
            triangles += [(k, k + 1, n + k + 1), (k, n + k + 1, n + k)]
        ring = np.array([(0.0, 0.0), (3.0, 0.0), (3.0, 3 * height)])
        mesh = MeshMeasures(points, np.array(triangles), np.full(len(points), 0.1), [ring])
        marked = mesh.at_sharp_corners(np.ones(len(points), bool))
        middles = mesh.corners.mean(axis=1)[:, 0]
        self.assertTrue(marked[middles < 1.3].all())
        self.assertFalse(marked[middles > 1.45].any())
        self.assertFalse(mesh.at_sharp_corners(np.zeros(len(points), bool)).any())
        self.assertLess(max(mesh.deviation()[0], mesh.lost()[0]), 1e-9)
        self.assertEqual(mesh.loops(), 1)
        self.assertAlmostEqual(mesh.area, 4.5 * height)

    def test_what_is_cut_is_lost_and_what_strays_deviates(self):
        points = np.array([(0.0, 0.0), (1, 0), (1, 1), (0, 1), (0.5, 0.5)])
        triangles = np.array([(0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)])
        spit = np.array([(0.0, 0.0), (1, 0), (1, 0.5), (1.3, 0.5), (1, 0.51), (1, 1), (0, 1)])
        mesh = MeshMeasures(points, triangles, np.full(5, 0.1), [spit])
        self.assertAlmostEqual(mesh.lost()[0], 3.0)
        self.assertLess(mesh.deviation()[0], 0.06)  # the middle of the root, 0.005 from its ends at most
        mesh = MeshMeasures(points + (0.02, 0.0), triangles, np.full(5, 0.1), [SQUARE])
        self.assertAlmostEqual(mesh.deviation()[0], 0.2)
        np.testing.assert_allclose(mesh.alpha, (1 + math.sqrt(2)) / 2)
        np.testing.assert_allclose(mesh.angle, 45)

    def test_fans_that_touch_are_two_loops(self):
        points = np.array([(0.0, 0.0), (1, 0), (1, 1), (-1, 0), (-1, -1)])
        triangles = np.array([(0, 1, 2), (0, 3, 4)])
        mesh = MeshMeasures(points, triangles, np.full(5, 1.0), list(points[triangles]))
        self.assertEqual(mesh.loops(), 2)

    def test_a_run_of_the_program(self):
        with Workspace() as work:
            text = text_of(real_shapes.shape("sea", 3, 300))
            (work / "it.xy").write_text(text, encoding="ascii")
            (work / "it.ini").write_text(judge.config_text(1000, "0.1"), encoding="ascii")
            done = run(work / "it.ini", f"output.directory={work}")
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            row = judge.judge_file(pathlib.Path(work) / "it.h5", rings_of(text))
            drawn = subprocess.run([sys.executable, pathlib.Path(__file__).with_name("worst_places.py"), work / "it.h5",
                                    work / "it.xy", "-o", work / "worst.png", "--places", "2"], capture_output=True,
                                   text=True, check=False)
            self.assertEqual(drawn.returncode, 0, drawn.stderr)
            self.assertIn(f"alpha {row['max']:.3f} at", drawn.stdout)
            self.assertGreater((work / "worst.png").stat().st_size, 10000)
        self.assertTrue(900 <= row["points"] <= 1000, row)
        self.assertTrue(1 < row["mean"] < 1.06 and row["mean"] < row["free"] <= row["max"], row)
        self.assertLess(row["deviation"], 0.5)
        self.assertLess(abs(row["area"]), 1)
        self.assertLess(row["loops"], row["rings"])
        self.assertEqual(row["failed"], [])
        self.assertIn("free=", judge.one_line(row))
        run_of_it = {"shape": "sea 3 300", "vertices": 300, "asked": 1000, "sizing": "0.1", "exit": 0}
        told = judge.markdown([{**row, **run_of_it, "deviation": 0.9}])
        self.assertIn("| **0.9** |", told)


if __name__ == "__main__":
    unittest.main()
