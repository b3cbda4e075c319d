#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests what a user of maps tries, with the messages that lead on.

A bay of lines and islands gets "200 m at the coast, 2 km offshore, 15 % growth". Lines may have spikes, be given twice
or be cut at 180 degrees. trime_check judges united, repaired and cut maps.
"""
import copy
import json
import math
import os
import random
import subprocess
import unittest

import h5py
import numpy

from trime_run import ROOT, Workspace, run

CHECK = os.environ.get("TRIME_CHECK", str(ROOT / "build" / "ci" / "src" / "check" / "trime_check"))
CONFIG = """[shape]
geometry = water
projection = auto
[shape.water]
type = contour
file = {}
attribute = kind
[sizing]
scale = absolute
max_size = {}
size_at = {}
gradation = 0.15
"""


def feature(kind, coordinates, properties):
    return {"type": "Feature", "properties": properties, "geometry": {"type": kind, "coordinates": coordinates}}


def collection(features):
    return json.dumps({"type": "FeatureCollection", "features": features})


def ragged(a, b, level, rng):
    """A broken line from a to b, without b."""
    if level == 0:
        return [a]
    t = rng.uniform(-0.12, 0.12)
    middle = [(a[0] + b[0]) / 2 + t * (b[1] - a[1]), (a[1] + b[1]) / 2 - t * (b[0] - a[0])]
    return ragged(a, middle, level - 1, rng) + ragged(middle, b, level - 1, rng)


def island(x, y, radius, count, rng):
    """A closed ring."""
    ring = []
    for k in range(count):
        t = 2 * math.pi * k / count
        r = radius * (1 + 0.2 * math.sin(3 * t) + rng.uniform(-0.08, 0.08))
        ring.append([x + 1.7 * r * math.cos(t), y + r * math.sin(t)])
    return ring + ring[:1]


def bay():
    """Features of a bay that is open to the south: coast, open sea, three islands."""
    rng = random.Random(5)
    base = [[8.0, 54.0], [8.0, 54.3], [8.2, 54.45], [8.45, 54.42], [8.6, 54.25], [8.6, 54.0]]
    coast = [p for a, b in zip(base, base[1:]) for p in ragged(a, b, 6, rng)] + [base[-1]]
    return [feature("LineString", coast, {"kind": "coast"}),
            feature("LineString", [base[-1], base[0]], {"kind": "open sea"})] + [
        feature("Polygon", [island(*where, rng)], {"kind": "coast", "name": name})
        for name, where in {"Big": (8.3, 54.25, 0.03, 60), "Small": (8.42, 54.18, 0.012, 40),
                            "Rock": (8.15, 54.12, 0.015, 40)}.items()]


def square(x, y, side, name):
    ring = [[x, y], [x + side, y], [x + side, y + side], [x, y + side], [x, y]]
    return feature("Polygon", [ring], {"kind": "coast", "name": name})


class MapUser(unittest.TestCase):
    def setUp(self):
        space = Workspace()
        self.work = space.__enter__()
        self.addCleanup(space.__exit__)

    def mesh(self, features, *overrides, size_at="coast 200", max_size=2000, ranks=1):
        """The run that makes out/map.h5 of a map."""
        (self.work / "map.geojson").write_text(collection(features))
        (self.work / "map.ini").write_text(CONFIG.format("map.geojson", max_size, size_at))
        return run("map.ini", "output.overwrite=true", *overrides, cwd=self.work, ranks=ranks)

    def good(self, *arguments, **more):
        done = self.mesh(*arguments, **more)
        self.assertEqual(done.returncode, 0, done.stderr + done.stdout)
        return done

    def refused(self, words, *arguments, **more):
        done = self.mesh(*arguments, **more)
        self.assertIn(done.returncode, (2, 3), done.stdout)
        self.assertRegex(done.stderr, words)
        return done

    def holes(self):
        with h5py.File(self.work / "out" / "map.h5") as file:
            return int(file["trime_mpi"].attrs["holes"])

    def confirmed(self):
        """trime_check finds nothing wrong, and judges the curves."""
        if not os.path.exists(CHECK):
            return
        done = subprocess.run([CHECK, "out/map.h5"], cwd=self.work, capture_output=True, text=True, timeout=120,
                              check=False)
        self.assertEqual(done.returncode, 0, done.stdout)
        for check in ("on_curve", "outside", "uncovered_curves", "uncovered_places", "container"):
            self.assertRegex(done.stdout, rf"(?m)^ok +{check} ")

    def check_finds(self, names, features):
        """trime_check finds these checks wrong if the map is another one than that of the mesh."""
        if not os.path.exists(CHECK):
            return
        (self.work / "map.geojson").write_text(collection(features))
        done = subprocess.run([CHECK, "out/map.h5"], cwd=self.work, capture_output=True, text=True, timeout=120,
                              check=False)
        self.assertEqual(done.returncode, 5, done.stdout)
        for check in names:
            self.assertRegex(done.stdout, rf"(?m)^WRONG +{check} ")

    def test_200_m_at_the_coast(self):
        done = self.good(bay())
        with h5py.File(self.work / "out" / "map.h5") as file:
            points, size = file["Mesh/mesh/geometry"][:], file["VTKHDF/PointData/size"][:]
            cells, facets = file["Mesh/mesh/topology"][:], file["Mesh/facets/topology"][:]
            labels = file["Mesh/facets/labels"][:]
            names = [name.decode() for name in file["trime_mpi/tags/part_name"][:]]
        at_coast = facets[labels == 1 + names.index("water.coast")]
        lengths = numpy.hypot(*(points[at_coast[:, 0]] - points[at_coast[:, 1]]).T)
        self.assertAlmostEqual(numpy.median(lengths), 200, delta=10)
        edges = numpy.concatenate([cells[:, [0, 1]], cells[:, [1, 2]], cells[:, [2, 0]]])
        far = numpy.hypot(*(points[edges[:, 0]] - points[edges[:, 1]]).T)
        growth = abs(size[edges[:, 0]] - size[edges[:, 1]]) / far
        self.assertLess(numpy.percentile(growth, 99), 0.153)
        self.assertAlmostEqual(size.max(), 2000, delta=1)
        self.assertEqual(self.holes(), 3)
        shortest = next(line for line in done.stdout.splitlines() if line.startswith("Shortest"))
        self.assertEqual(shortest.count("longitude"), 1, shortest)
        self.assertIn("[map.geojson (feature ", shortest)

    def test_messages_say_what_to_do(self):
        self.refused("known names: coast, open sea.*write a list as", bay(), size_at="coast 200 open sea 2000")
        self.refused(r"'attribute = FIELD' in \[shape\.water\]", bay(), "shape.water.attribute=")
        self.refused(r"'max_size = 0\.02' in \[sizing\] asks for 4\.6e\+12 or more points.*usually metres", bay(),
                     size_at="coast 0.002", max_size=0.02)
        self.refused(r"\[longitude 0, latitude .*\] lies outside", bay(), "meshing.components=at 0 0")
        self.refused("without 'coordinates' the files have", bay(), "shape.projection=", "output.coordinates=degrees",
                     "output.formats=fort14", "sizing.size_at=coast 0.01", "sizing.max_size=0.02")
        self.refused("only geometries of type Point", [feature("Point", [8, 54], {"kind": "coast"})])
        self.refused(r"unknown name 'distance'; in the formula of a size, dist\(\)", bay(), "sizing.size_at=",
                     "sizing.type=expression", "sizing.expression=min(2000, 200+0.15*distance)")
        done = self.good(bay(), "sizing.size_at=", max_size=1e6)
        self.assertRegex(done.stderr + done.stdout, r"max_size = 1e\+06 is longer than the whole shape \(5.*unit of")
        done = run("info", "map.ini", cwd=self.work)
        self.assertEqual(done.returncode, 4)
        self.assertRegex(done.stderr, r"map\.ini: expected a mesh file NAME\.h5")
        islands = [square(178 + k, -17, 0.5, "east") for k in (0, 1)] + [square(-180, -17, 0.5, "west"),
                                                                         square(179.5, -17, 0.5, "middle")]
        done = self.mesh(islands, "shape.projection=", size_at="coast 0.1", max_size=0.2)
        self.assertIn("begins at -180 and ends at 180; set 'projection = auto'", done.stderr + done.stdout)
        done = self.mesh(islands, "shape.projection=", "shape.water.attribute=", "sizing.size_at=", max_size=1000)
        self.assertIn("max_size = 1000 is longer than the whole shape", done.stderr + done.stdout)

    def test_lines_are_repaired_like_polygons(self):
        self.good(bay())
        clean = h5py.File(self.work / "out" / "map.h5")["trime_mpi"].attrs["mesh_hash"]
        dirty = bay()
        line = dirty[0]["geometry"]["coordinates"]
        line[41:41] = [[line[40][0] - 0.05, line[40][1] + 0.02], line[40]]  # a spike
        line[100:100] = [line[100]] * 2
        dirty += [copy.deepcopy(dirty[1])]  # the open sea twice
        self.refused(r"map\.geojson \(feature 1, 'coast'\): the ring turns straight back.*try 'repair = true'", dirty)
        done = self.good(dirty, "shape.water.repair=true")
        self.assertRegex(done.stderr + done.stdout,
                         r"\(feature 6, 'open sea'\): this line is the same as an earlier one")
        with h5py.File(self.work / "out" / "map.h5") as file:
            self.assertEqual(file["trime_mpi"].attrs["mesh_hash"], clean)
        self.confirmed()

    def test_lines_cut_at_180_degrees(self):
        whole = [[178, -19], [182, -19], [182.5, -17], [182, -15], [178, -15]]
        east = [[180, -15], [178, -15], [178, -19], [180, -19]]
        west = [[-180, -19], [-178, -19], [-177.5, -17], [-178, -15], [-180, -15]]
        self.good([feature("LineString", whole + whole[:1], {"kind": "coast"})], size_at="coast 5000", max_size=20000)
        with h5py.File(self.work / "out" / "map.h5") as file:
            area = file["trime_mpi"].attrs["shape_area"]
        cut = [feature("LineString", line, {"kind": "coast"}) for line in (east, west)]
        for ranks in (1, 3):
            self.good(cut, size_at="coast 5000", max_size=20000, ranks=ranks)
            with h5py.File(self.work / "out" / "map.h5") as file:
                self.assertAlmostEqual(file["trime_mpi"].attrs["shape_area"] / area, 1, delta=1e-6)
        self.confirmed()
        self.refused("lines end at longitudes 180 and -180; set 'projection = auto'", cut, "shape.projection=",
                     size_at="coast 0.1", max_size=1)

    def test_polygons_cut_at_180_degrees_are_judged(self):
        east = [[179, -17], [180, -17], [180, -16.5], [180, -16], [179, -16], [179, -17]]
        west = [[-180, -17], [-179, -17], [-179, -16], [-180, -16], [-180, -17]]
        features = [feature("MultiPolygon", [[east], [west]], {"kind": "coast"})]
        self.good(features, size_at="coast 2000", max_size=5000)
        self.confirmed()

    def test_what_a_union_swallows_is_named(self):
        overlapping = bay() + [square(8.42, 54.18, 0.02, "Over")]
        self.refused("set 'overlap = union'", overlapping)
        done = self.good(overlapping, "shape.water.overlap=union")
        self.assertRegex(done.stderr + done.stdout,
                         r"\(feature 3, 'Big'\): this polygon lies inside of others and disappears.*and so do 3 more")
        states = [square(0, 50, 1, "a"), square(1, 50, 1, "b"), square(0.5, 50.5, 1, "c"), square(0, 51, 0.3, "d")]
        done = self.good(states, "shape.water.overlap=union", size_at="coast 5000", max_size=20000)
        self.assertNotIn("disappears", done.stderr + done.stdout)
        self.confirmed()
        self.check_finds(["uncovered_places", "uncovered_curves"], states + [square(-0.4, 51.1, 1, "e")])
        self.check_finds(["outside", "on_curve"], states[:2] + states[3:])
        bow = [feature("Polygon", [[[0, 50], [1, 50], [0, 51], [1.3, 51.2], [0, 50]]], {"kind": "bow"}),
               feature("Polygon", [[[3, 50], [4, 50], [3, 51], [4.3, 51.2], [3, 50]]], {"kind": "bow"})]
        self.refused("found 2 faults", bow + states, "shape.water.overlap=union", "shape.water.attribute=",
                     "sizing.size_at=")


if __name__ == "__main__":
    unittest.main()
