#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests shapes that are divided into regions: areas, interfaces, junctions, names, other formats, and what is refused.
Areas, lengths and coordinates are compared with exact values; the arrays must be the same on any ranks and threads.
"""
import math
import os
import pathlib
import re
import subprocess
import unittest

import numpy as np

from region_meshes import (Mesh, by_number, circle, lengths_of, read_by_meshio, read_freefem, read_triangle, rectangle,
                           region, rounded, shoelace, triangle)
from solver_readers import Exo, Inp
from trime_run import PROGRAM, Workspace, run

CHECK = os.environ.get("TRIME_CHECK", str(pathlib.Path(PROGRAM).parent / "src" / "check" / "trime_check"))
LAYOUTS = [(2, 1), (3, 2), (7, 1)]  # ranks, threads; the first mesh is made on 1 rank and 1 thread
EXACT, WITH_SLIVERS = 1e-11, 1e-10
ALL_FORMATS = "vtkhdf xdmf gmsh medit freefem triangle vtu abaqus exodus"


class RegionsTest(unittest.TestCase):
    def setUp(self):
        self.space = Workspace()
        self.directory = self.space.__enter__()

    def tearDown(self):
        self.space.__exit__(None, None, None)

    def write(self, name, *rings):
        text = "\n\n".join("\n".join(f"{x!r} {y!r}" for x, y in ring) for ring in rings)
        (self.directory / name).write_text(text + "\n")

    def run_config(self, text, points=2000, shape="geometry = domain", formats="vtkhdf xdmf", ranks=1, threads=1):
        config = self.directory / "mesh.ini"
        config.write_text(f"[shape]\n{shape}\n{text}[meshing]\npoints = {points}\n"
                          f"[output]\ndirectory = {self.directory}\nname = mesh\noverwrite = true\n"
                          f"formats = {formats}\n")
        return run(config, ranks=ranks, threads=threads)

    def mesh(self, text, **options):
        """Makes a mesh, and checks what holds for any mesh with regions."""
        done = self.run_config(text, formats=ALL_FORMATS, **options)
        self.report = done.stdout + done.stderr
        self.assertEqual(done.returncode, 0, self.report)
        mesh = Mesh(self.directory / "mesh.h5")
        judged = subprocess.run([CHECK, self.directory / "mesh.h5"], capture_output=True, text=True, check=False)
        self.assertEqual(judged.returncode, 0, judged.stdout + judged.stderr)
        self.assertRegex(judged.stdout, r"(?m)^ok +region_places")
        self.check_interfaces(mesh)
        self.assertLessEqual(mesh.largest_angle(), 90 + 1e-9)
        self.assertAlmostEqual(math.fsum(mesh.areas), shoelace(mesh.points, mesh.facets), delta=1e-12)
        self.assertTrue(set(mesh.region.tolist()) <= set(mesh.names))
        self.check_formats(mesh)
        return mesh

    def same_on_all(self, text, **options):
        """The same, with equal arrays on several ranks and threads."""
        mesh = self.mesh(text, **options)
        for ranks, threads in LAYOUTS:
            done = self.run_config(text, ranks=ranks, threads=threads, **options)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            other = Mesh(self.directory / "mesh.h5").arrays()
            self.assertEqual(set(other), set(mesh.arrays()))
            for name, array in mesh.arrays().items():
                self.assertEqual(array.tobytes(), other[name].tobytes(), f"{name} on {ranks} x {threads}")
        return mesh

    def check_interfaces(self, mesh):
        """Interfaces are the edges between regions, each once, with the lower region on the left and a new label."""
        sides = {(t[k], t[(k + 1) % 3]): number for number, t in zip(mesh.region.tolist(), mesh.triangles.tolist())
                 for k in range(3)}
        wanted = {edge: (left, sides[edge[::-1]]) for edge, left in sides.items() if left < sides.get(edge[::-1], 0)}
        rows = list(map(tuple, mesh.edges.tolist()))
        self.assertEqual(len(set(rows)), len(rows))
        self.assertEqual({edge: tuple(pair) for edge, pair in zip(rows, mesh.interfaces["regions"].tolist())}, wanted)
        for pair, number, label in zip(*(mesh.interfaces[name] for name in ("regions", "values", "labels"))):
            self.assertEqual(mesh.pairs[number], "|".join(mesh.names[k] for k in pair))
            self.assertEqual(label, len(mesh.parts) + number + 1)  # these configs have no curves
        self.assertFalse(set(mesh.interfaces["labels"].tolist()) & set(mesh.facet_labels.tolist()))

    def check_formats(self, mesh):
        """Other programs find the same areas by region and the same lengths by label."""
        stem = self.directory / "mesh"
        edges = np.vstack([mesh.facets, mesh.edges])
        labels = np.concatenate([mesh.facet_labels, mesh.interfaces["labels"]])
        wanted = (by_number(mesh.region, mesh.areas), by_number(labels, lengths_of(mesh.points, edges)))
        found = {"gmsh": read_by_meshio(stem.with_suffix(".msh"), "gmsh:physical", "gmsh:physical"),
                 "medit": read_by_meshio(stem.with_suffix(".mesh"), "medit:ref", "medit:ref"),
                 "vtu": read_by_meshio(stem.with_suffix(".vtu"), "label", "region"),
                 "freefem": read_freefem(stem.with_suffix(".freefem")), "triangle": read_triangle(stem),
                 "abaqus": Inp(stem.with_suffix(".inp")).sums(), "exodus": Exo(stem.with_suffix(".exo")).sums()}
        for name, (areas, lengths) in found.items():
            for expected, sums in zip(wanted, (areas, lengths)):
                self.assertEqual(set(sums), set(expected), name)
                for number, value in expected.items():
                    self.assertAlmostEqual(sums[number], value, delta=EXACT, msg=f"{name} {number}")

    def check_areas(self, mesh, expected, delta=EXACT):
        for name, area in expected.items():
            self.assertAlmostEqual(mesh.area(name), area, delta=delta, msg=name)

    def refused(self, text, code, *words, **options):
        """A run that fails with these words in its message, and leaves no mesh."""
        for ranks in (1, 3):
            done = self.run_config(text, ranks=ranks, **options)
            self.assertEqual(done.returncode, code, done.stdout + done.stderr)
            for word in words:
                self.assertRegex(done.stderr, word)
            self.assertFalse((self.directory / "mesh.h5").exists())


class Regions(RegionsTest):
    def test_two_halves(self):
        text = rectangle("part", (0, 0), (0.5, 1)) + region("left", "part")
        mesh = self.same_on_all(text, shape="geometry = domain\nrest = right")
        self.assertEqual(mesh.names, {1: "right", 2: "left"})
        self.check_areas(mesh, {"left": 0.5, "right": 0.5})
        self.assertEqual(mesh.pair_names(), {"right|left"})
        self.assertAlmostEqual(mesh.length(), 1, delta=EXACT)
        self.assertEqual(set(mesh.points[mesh.edges][:, :, 0].ravel().tolist()), {0.5})
        self.assertEqual(mesh.junctions(), {(0.5, 0.0): 3, (0.5, 1.0): 3})
        self.assertEqual((mesh.euler("left"), mesh.euler("right")), (1, 1))
        centroids = mesh.points[mesh.triangles].mean(axis=1)
        np.testing.assert_array_equal(centroids[:, 0] < 0.5, mesh.region == 2)
        self.assertLessEqual(mesh.alpha(), 1.10)

    def test_three_that_meet(self):
        text = (rectangle("bottom", (0, 0), (1, 0.5)) + rectangle("corner", (0, 0.5), (0.5, 1)) +
                rectangle("other", (0.5, 0.5), (1, 1)) + region("low", "bottom") + region("tl", "corner") +
                region("tr", "other"))
        mesh = self.same_on_all(text, shape="geometry = domain\ncover = all")
        self.check_areas(mesh, {"low": 0.5, "tl": 0.25, "tr": 0.25})
        self.assertNotIn(1, mesh.region)
        self.assertEqual(mesh.junctions(), {(0.5, 0.5): 3, (0.0, 0.5): 3, (1.0, 0.5): 3, (0.5, 1.0): 3})
        for pair in ("low|tl", "low|tr", "tl|tr"):
            self.assertAlmostEqual(mesh.length(pair), 0.5, delta=EXACT)
        middle = np.flatnonzero((mesh.points == 0.5).all(axis=1))
        self.assertEqual(len(middle), 1)
        around = (mesh.triangles == middle[0]).any(axis=1)
        self.assertEqual(set(mesh.region[around].tolist()), {2, 3, 4})

    def test_disc(self):
        mesh = self.same_on_all(circle("round", 0.3) + region("disc", "round"), points=3000,
                                shape="geometry = domain\nrest = rest")
        slivers = mesh.segment_areas(mesh.edges, 0.3)
        self.assertAlmostEqual(mesh.area("disc") + slivers, 0.2827433388230814, delta=WITH_SLIVERS)
        self.assertAlmostEqual(mesh.area("rest") - slivers, 0.7172566611769186, delta=WITH_SLIVERS)
        self.assertEqual(mesh.junctions(), {})
        following = dict(mesh.edges.tolist())
        path = [mesh.edges[0, 0]]
        while (after := following[path[-1]]) != path[0]:
            path.append(after)
        self.assertEqual(len(path), len(mesh.edges))
        radii = np.hypot(*(mesh.points[path] - 0.5).T)
        self.assertLessEqual(np.abs(radii - 0.3).max(), 1e-12)
        h = math.sqrt(2 / (math.sqrt(3) * 3000))
        lengths = lengths_of(mesh.points, mesh.edges)
        self.assertGreaterEqual(lengths.min(), 0.9 * h)
        self.assertLessEqual(lengths.max(), 1.1 * h)
        self.assertEqual((mesh.euler("disc"), mesh.euler("rest")), (1, 0))

    def test_three_sectors(self):
        middle, top = (0.5, 0.5), (0.5, 1.5)
        left, right = (-0.3660254037844386, 0.0), (1.3660254037844386, 0.0)
        text = "[domain]\nx_min = -1\ny_min = -1\nx_max = 2\ny_max = 2\n" + circle("disc", 0.4)
        for name, corners in (("a", (middle, top, left)), ("b", (middle, left, right)), ("c", (middle, right, top))):
            text += triangle("of_" + name, *corners) + region(name, f"intersection(disc, of_{name})")
        mesh = self.same_on_all(text, shape="geometry = disc\ncover = all")
        lookup = {tuple(sorted(t[k] for k in pair)): number
                  for number, t in zip(mesh.region.tolist(), mesh.triangles.tolist())
                  for pair in ((0, 1), (1, 2), (2, 0))}
        sector = np.array([lookup[tuple(sorted(facet))] for facet in mesh.facets.tolist()])
        for name in "abc":
            slivers = mesh.segment_areas(mesh.facets[sector == mesh.numbers[name]], 0.4)
            self.assertAlmostEqual(mesh.area(name) + slivers, 0.16755160819145565, delta=WITH_SLIVERS)
        junctions = mesh.junctions()
        self.assertEqual(junctions[middle], 3)
        self.assertEqual(np.count_nonzero((mesh.points == 0.5).all(axis=1)), 1)
        self.assertEqual(list(junctions.values()), [3] * 4)
        rim = sorted(point for point in junctions if point != middle)
        for found, (x, y) in zip(rim, ((0.5 - 0.2 * math.sqrt(3), 0.3), (0.5, 0.9), (0.5 + 0.2 * math.sqrt(3), 0.3))):
            self.assertLess(math.dist(found, (x, y)), 1e-11)
        for pair in ("a|b", "b|c", "a|c"):
            self.assertAlmostEqual(mesh.length(pair), 0.4, delta=WITH_SLIVERS)
        self.assertLessEqual(mesh.alpha(), 1.10)

    def test_ring(self):
        text = (circle("inner", 0.2) + circle("outer", 0.3) + region("core", "inner") +
                region("ring", "difference(outer, inner)"))
        mesh = self.same_on_all(text, points=4000, shape="geometry = domain\nrest = rest")
        self.assertEqual(mesh.pair_names(), {"core|ring", "rest|ring"})
        inner = mesh.segment_areas(mesh.pair_edges("core|ring"), 0.2)
        outer = mesh.segment_areas(mesh.pair_edges("rest|ring"), 0.3)
        self.assertAlmostEqual(mesh.area("core") + inner, 0.12566370614359174, delta=WITH_SLIVERS)
        self.assertAlmostEqual(mesh.area("ring") + outer - inner, 0.15707963267948966, delta=WITH_SLIVERS)
        self.assertAlmostEqual(mesh.area("rest") - outer, 0.7172566611769186, delta=WITH_SLIVERS)
        self.assertEqual([mesh.euler(name) for name in ("core", "ring", "rest")], [1, 0, 0])
        self.assertEqual(mesh.junctions(), {})

    def test_small_discs(self):
        """Where few triangles lie across a disc, the clean-up must insert points, and move those on the interface."""
        radii = [0.045 + 0.004 * k for k in range(9)]  # 4.5 to 7.7 edges
        text = "".join(circle(f"c{k}", radius, f"{1 / 6 + k % 3 / 3!r} {1 / 6 + k // 3 / 3!r}")
                       for k, radius in enumerate(radii))
        text += region("discs", f"union({', '.join(f'c{k}' for k in range(9))})")
        mesh = self.same_on_all(text, points=11500)
        self.assertLessEqual(mesh.alpha(), 1.11)
        ends = np.unique(mesh.edges)
        for k, radius in enumerate(radii):
            away = np.hypot(*(mesh.points[ends] - (1 / 6 + k % 3 / 3, 1 / 6 + k // 3 / 3)).T)
            self.assertLessEqual(np.abs(away[away < 1 / 6] - radius).max(), 1e-12)
        self.assertAlmostEqual(mesh.area("discs"), math.pi * sum(radius**2 for radius in radii), delta=0.02)

    def test_order_of_overlapping_regions(self):
        parts = rectangle("west", (0, 0), (0.6, 1)) + rectangle("east", (0.4, 0), (1, 1))
        for order, areas in (("ab", {"a": 0.6, "b": 0.4}), ("ba", {"a": 0.4, "b": 0.6})):
            sections = {"a": region("a", "west"), "b": region("b", "east")}
            mesh = self.same_on_all(parts + "".join(sections[name] for name in order))
            self.check_areas(mesh, areas)
            self.assertEqual(list(mesh.names.values())[1:], list(order))
            first, second = order
            words = rf"the regions '{first}' and '{second}' share an area of 0\.2, for example at"
            self.assertEqual(len(re.findall(words, self.report)), 1, self.report)

    def test_the_rest(self):
        text = rectangle("corner", (0, 0), (0.5, 0.5)) + region("a", "corner")
        mesh = self.mesh(text)
        self.assertEqual(mesh.names, {1: "domain", 2: "a"})
        self.check_areas(mesh, {"a": 0.25, "domain": 0.75})
        (self.directory / "mesh.h5").unlink()
        self.refused(text, 3, r"\b0\.75\b", r"\([\d.]+, [\d.]+\)", shape="geometry = domain\ncover = all")

    def ragged(self):
        """The config of a part `low` whose upper side is ragged."""
        ring = [(0.0, 0.0), (1.0, 0.0)] + [(1 - 0.005 * k, 0.5 + 0.004 * (-1)**k) for k in range(201)]
        self.write("low.xy", ring)
        return "[shape.below]\ntype = contour\nfile = low.xy\n" + region("low", "below")

    def test_ragged_interface(self):
        mesh = self.same_on_all(self.ragged(), shape="geometry = domain\nrest = top")
        self.assertGreaterEqual(mesh.length(), 1.0)
        self.assertEqual(mesh.junctions(), {(0.0, 0.504): 3, (1.0, 0.504): 3})

    def test_ragged_interface_becomes_smooth(self):
        mesh = self.mesh(self.ragged(), shape="geometry = domain\nrest = top")
        self.check_areas(mesh, {"low": 0.5, "top": 0.5}, 1e-6)
        self.assertLessEqual(mesh.length(), 1.03)
        self.assertLessEqual(mesh.alpha(), 1.25)

    def test_ragged_interface_as_it_is(self):
        mesh = self.mesh(self.ragged(), shape="geometry = domain\nrest = top", points="2000\nsimplify_within = 0")
        self.check_areas(mesh, {"low": 0.5, "top": 0.5})
        self.assertGreaterEqual(len(mesh.edges), 200)

    def test_pinch_out(self):
        text = (rectangle("bottom", (0, 0), (1, 0.5)) + triangle("thin", (0.0, 0.5), (1.0, 0.5), (1.0, 0.6)) +
                region("base", "bottom") + region("wedge", "thin"))
        mesh = self.same_on_all(text, shape="geometry = domain\nrest = top")
        self.assertAlmostEqual(math.fsum(mesh.areas), 1, delta=1e-12)
        self.assertGreaterEqual(mesh.area("wedge"), 0.0465)
        self.assertLessEqual(mesh.area("wedge"), 0.05 + 1e-12)
        if mesh.area("wedge") < 0.05 - 1e-6:
            self.assertIn("wedge to top", self.report)
        x, y = mesh.meeting_point("top", "base", "wedge")
        self.assertLessEqual(abs(y - 0.5), 0.024)
        self.assertLessEqual(x, 0.25)
        self.assertAlmostEqual(mesh.length("top|base"), x, delta=0.02)

    def test_pinch_out_with_all_features(self):
        text = (rectangle("bottom", (0, 0), (1, 0.5)) + triangle("thin", (0.0, 0.5), (1.0, 0.5), (1.0, 0.6)) +
                region("base", "bottom") + region("wedge", "thin"))
        mesh = self.same_on_all(text, shape="geometry = domain\nrest = top", points="2000\nkeep_features = true")
        self.check_areas(mesh, {"wedge": 0.05, "base": 0.5, "top": 0.45})
        self.assertEqual(mesh.junctions()[(0.0, 0.5)], 4)
        self.assertIn((0.0, 0.5), {rounded(point) for point in mesh.points[mesh.edges].reshape(-1, 2)})
        degrees = [angle for name, column in mesh.sharp.items() if "degrees" in name for angle in column.tolist()]
        self.assertTrue(any(abs(angle - 5.71) < 0.005 for angle in degrees), mesh.sharp)


POLY = """8 2 0 1
1 0 0 1
2 1 0 1
3 1 1 1
4 0 1 1
5 0.25 0.25 2
6 0.75 0.25 2
7 0.75 0.75 2
8 0.25 0.75 2
8 1
1 1 2 11
2 2 3 12
3 3 4 13
4 4 1 14
5 5 6 20
6 6 7 20
7 7 8 20
8 8 5 21
0
2
1 0.1 0.1 3 -1
2 {} 7 0.0005
"""


class OfTriangle(RegionsTest):
    """A .poly file with region points, largest areas and markers."""
    CONFIG = ("[shape]\ngeometry = plate\n[shape.plate]\ntype = contour\nfile = two.poly\n[region.m]\nfile = two.poly\n"
              "area_limits = {}\n[curve.line]\nfile = two.poly\n[sizing]\nscale = absolute\nmax_size = 0.06\n")

    def run_poly(self, point="0.5 0.5", limits="true", ranks=1):
        (self.directory / "two.poly").write_text(POLY.format(point))
        config = self.directory / "mesh.ini"
        config.write_text(self.CONFIG.format(limits) +
                          f"[output]\ndirectory = {self.directory}\nname = mesh\noverwrite = true\n")
        return run(config, ranks=ranks)

    def test_points_areas_and_markers(self):
        hashes = set()
        for ranks in (1, 3):
            done = self.run_poly(ranks=ranks)
            report = done.stdout + done.stderr
            self.assertEqual(done.returncode, 0, report)
            self.assertNotIn("region points", report)
            mesh = Mesh(self.directory / "mesh.h5")
            hashes.add(mesh.points.tobytes() + mesh.triangles.tobytes() + mesh.region.tobytes())
        self.assertEqual(len(hashes), 1)
        self.check_areas(mesh, {"m.3": 0.75, "m.7": 0.25})
        inside = [number for number, name in mesh.names.items() if name == "m.7"]
        areas = mesh.areas[np.isin(mesh.region, inside)]
        self.assertTrue(475 <= len(areas) <= 600, len(areas))
        self.assertLess(areas.max(), 0.001)
        self.assertLess(len(mesh.areas) - len(areas), 900)
        rim = by_number(mesh.facet_labels, lengths_of(mesh.points, mesh.facets))
        self.assertEqual({mesh.parts[label - 1]: round(length, 12) for label, length in rim.items()},
                         {f"plate.{marker}": 1 for marker in (11, 12, 13, 14)})
        self.assertEqual({name: round(length, 12) for name, length in mesh.curve_lengths.items()},
                         {"line.20": 1.5, "line.21": 0.5})
        judged = subprocess.run([CHECK, self.directory / "mesh.h5"], capture_output=True, text=True, check=False)
        self.assertEqual(judged.returncode, 0, judged.stdout + judged.stderr)

    def test_areas_need_a_key(self):
        done = self.run_poly(limits="false")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("'area_limits = true' in [region.m]", done.stdout + done.stderr)
        mesh = Mesh(self.directory / "mesh.h5")
        self.assertLess(len(mesh.areas), 900)

    def test_two_points_in_one_face(self):
        for ranks in (1, 3):
            done = self.run_poly("0.1 0.9", ranks=ranks)
            self.assertEqual(done.returncode, 3, done.stdout + done.stderr)
            self.assertRegex(done.stderr, r"two\.poly:\d+: the region points \(0\.1, 0\.9\) and \(0\.1, 0\.1\)")
            self.assertFalse((self.directory / "mesh.h5").exists())


class OfRaster(RegionsTest):
    """A raster of labels: areas are those of the cells, also where cells of one label meet in a corner only."""
    SIDE, LABELS = 24, (3, 5, 40)

    def run_raster(self, cells, ranks=1):
        text = f"ncols {self.SIDE}\nnrows {self.SIDE}\nxllcorner 0\nyllcorner 0\ncellsize {1 / self.SIDE!r}\n"
        (self.directory / "a.asc").write_text(text + "\n".join(" ".join(map(str, row)) for row in cells) + "\n")
        return self.run_config("[shape.map]\ntype = contour\nfile = a.asc\n[region.r]\nfile = a.asc\n", points=6000,
                               shape="geometry = map", ranks=ranks)

    def test_areas_of_labels(self):
        coarse = np.random.default_rng(7).choice(self.LABELS, size=(self.SIDE // 2, self.SIDE // 2))
        cells = coarse.repeat(2, 0).repeat(2, 1)
        seen = set()
        for ranks in (1, 3):
            done = self.run_raster(cells, ranks)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            mesh = Mesh(self.directory / "mesh.h5")
            seen.add(mesh.points.tobytes() + mesh.triangles.tobytes() + mesh.region.tobytes())
        self.assertEqual(len(seen), 1)
        self.assertEqual([mesh.names[number] for number in sorted(mesh.names)],
                         ["map"] + [f"r.{label}" for label in self.LABELS])
        self.check_areas(mesh, {f"r.{label}": (cells == label).sum() / self.SIDE ** 2 for label in self.LABELS})
        judged = subprocess.run([CHECK, self.directory / "mesh.h5"], capture_output=True, text=True, check=False)
        self.assertEqual(judged.returncode, 0, judged.stdout + judged.stderr)


class BadInput(RegionsTest):
    def test_names_that_do_not_exist(self):
        for geometry, word in (("nowhere", "nowhere"), ("difference(domain, nowhere)", "nowhere"), ("", "geometry")):
            self.refused(region("rock", geometry), 2, word, "rock")
        self.refused("[region.rock]\ngeometri = domain\n", 2, "geometri")

    def test_two_sections_of_one_name(self):
        text = rectangle("part", (0, 0), (0.5, 1)) + region("rock", "part")
        self.refused(text + region("rock", "part"), 2, r"region\.rock")
        self.refused(text, 2, "rock", shape="geometry = domain\nrest = rock")

    def test_regions_without_a_place(self):
        beyond = rectangle("beyond", (0.6, 0.6), (0.9, 0.9)) + rectangle("body", (0.1, 0.1), (0.5, 0.5))
        self.refused(beyond + region("rock", "beyond"), 3, "'rock'", "outside", shape="geometry = body")
        empty = rectangle("west", (0, 0), (0.3, 1)) + rectangle("east", (0.7, 0), (1, 1))
        self.refused(empty + region("rock", "intersection(west, east)"), 3, "'rock'")
        inner = rectangle("large", (0, 0), (0.6, 1)) + rectangle("small", (0.2, 0.2), (0.4, 0.4))
        self.refused(inner + region("soil", "large") + region("rock", "small"), 3, "'rock'", "'soil'")

    def test_cover(self):
        text = rectangle("part", (0, 0), (0.5, 1)) + region("rock", "part")
        self.refused(text, 2, "cover", shape="geometry = domain\ncover = some")
        self.refused(text, 3, r"\b0\.5\b", shape="geometry = domain\ncover = all")


if __name__ == "__main__":
    unittest.main()
