#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests trime_check on shapes: it passes good meshes of unusual shapes, and finds meshes that belong to another
config."""
import json
import math
import pathlib
import re
import subprocess
import tempfile
import unittest

import h5py

from check_test import check
from dirty_inputs import HOLE, POLY, SQUARE, geojson
from trime_run import run


def rectangle(x_min, x_max, y_min, y_max, name="a"):
    return f"[shape.{name}]\ntype = rectangle\nx_min = {x_min}\nx_max = {x_max}\ny_min = {y_min}\ny_max = {y_max}\n"


def circle(x, y, radius, name="b"):
    return f"[shape.{name}]\ntype = circle\ncenter = {x} {y}\nradius = {radius}\n"


def contour(file, name="a"):
    return f"[shape.{name}]\ntype = contour\nfile = {file}\n"


HOLED = {"it.poly": POLY, "it.geojson": geojson(SQUARE + SQUARE[:1], HOLE + HOLE[:1])}


class Shapes(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.work = pathlib.Path(folder.name)

    def config(self, name, parts, region="a", domain="", meshing="points = 700\n", files=()):
        for file, text in dict(files).items():
            (self.work / file).write_text(text, "ascii")
        path = self.work / f"{name}.ini"
        domain = f"[domain]\n{domain}" if domain else ""
        path.write_text(f"{domain}[shape]\ngeometry = {region}\n{parts}[meshing]\n{meshing}", "ascii")
        return path

    def mesh(self, config, codes=(0,)):
        done = run(config, f"output.directory={self.work}", "output.overwrite=true")
        self.assertIn(done.returncode, codes, done.stdout + done.stderr)
        return self.work / f"{config.stem}.h5"

    def passes(self, *arguments):
        code, text = check(*arguments)
        self.assertEqual(code, 0, text)
        return text

    def finds(self, names, *arguments):
        code, text = check(*arguments)
        self.assertEqual(code, 5, text)
        wrong = re.findall(r"(?m)^WRONG +(\S+)", text)
        for name in names:
            self.assertIn(name, wrong, text)

    def test_periodic_bands(self):
        """Sides where an image of the same part continues are not boundary, and their ends are not corners."""
        x, y = "periodic_x = true\n", "periodic_y = true\n"
        band = {"band.xy": "0 0.2\n0.5 0.3\n1 0.2\n1 0.8\n0 0.8\n"}
        for name, domain, parts, corners in (
                ("band", x, rectangle(0, 1, 0.2, 0.8), 0), ("upright", y, rectangle(0.2, 0.8, 0, 1), 0),
                ("wide", x, rectangle(-0.2, 0.9, 0.2, 0.8), 0), ("torus", x + y, rectangle(0.5, 1.5, 0.2, 0.8), 0),
                ("contour", x, contour("band.xy"), 0), ("whole", x + y, rectangle(0, 1, 0, 1), 0),
                ("ends", x, rectangle(-0.3, 0.2, 0.2, 0.8), 4), ("above", x, rectangle(1.5, 2, 0.2, 0.7), 4),
                ("corner", x + y, rectangle(1.7, 2, 1.6, 2), 4)):
            with self.subTest(shape=name):
                config = self.config(name, parts, domain=domain, files=band)
                path = self.mesh(config)
                for arguments in ([path], [path, config]):
                    self.assertRegex(self.passes(*arguments),
                                     rf"(?m)^ok +corners +expected {corners}, found {corners}:")

    def test_crowded_fixed_points(self):
        """Triangles between them cannot have the size, and the report says so."""
        for name, points, crowded in (("boundary", "0.1001 0.5\n", True), ("near", "0.5 0.5\n0.501 0.5\n", True),
                                      ("nearer", "0.5 0.5\n0.50000001 0.5\n", True),
                                      ("far", "0.3 0.5\n0.6 0.5\n", False)):
            with self.subTest(points=name):
                config = self.config(name, rectangle(0.1, 0.9, 0.1, 0.9), files={f"{name}_fixed.xy": points},
                                     meshing=f"points = 500\nfixed_points = {name}_fixed.xy\nworst_alpha = 1e9\n")
                text = self.passes(self.mesh(config), config)
                self.assertEqual("are not counted" in re.search(r"(?m)^ok +size .*", text)[0], crowded, text)

    def test_sizes_that_edges_cannot_have(self):
        """A circle far below the size that is asked for, and a size that jumps between the points."""
        config = self.config("small", circle(0.315, 0.454, 0.0343, "a") + "[sizing]\ntype = automatic\n",
                             domain="periodic_y = true\n", meshing="edge_length = 0.39\nmethod = cvd\n")
        text = self.passes(self.mesh(config, (0, 5)))
        self.assertRegex(text, r"(?m)^ok +size .* because .* the size is lowered to 0.05 of the size asked for")
        config = self.config("jumps", rectangle(0.1, 0.9, 0.1, 0.9) +
                             "[sizing]\ntype = expression\nexpression = abs(sin(50*x))+1e-7\ngradation = none\n",
                             meshing="points = 60\n")
        text = self.passes(self.mesh(config, (0, 5)))
        self.assertRegex(text, r"(?m)^-- +size_mean +not checked: the size is an expression")

    def test_sites_pushed_out_of_the_container(self):
        """Where rings touch at its side the boundary is simplified, and may stray by the share of h that the config
        allows."""
        rings = {"touch.xy": "0 0\n1 0\n1 1\n0 1\n\n0.5 0\n0.7 0.3\n0.3 0.3\n"}
        config = self.config("touch", contour("touch.xy"), files=rings, meshing="points = 900\n")
        self.passes(self.mesh(config), config)

    def test_parts_that_the_mesh_does_not_have(self):
        """A plain rectangle is not one with a hole, an island, more or less of it; both directions are looked at."""
        plain = self.mesh(self.config("plain", rectangle(0.1, 0.9, 0.1, 0.9)))
        for region, place, names in (("difference(a, b)", (0.5, 0.5, 0.2), ["outside", "uncovered_curves"]),
                                     ("union(a, b)", (0.95, 0.95, 0.03), ["uncovered_curves"]),
                                     ("union(a, b)", (0.9, 0.5, 0.09), ["uncovered_curves", "uncovered_places"]),
                                     ("intersection(a, b)", (0.5, 0.5, 0.2), ["outside", "uncovered_curves"]),
                                     ("b", (0.5, 0.5, 0.4), ["outside", "facet_parts"])):
            with self.subTest(region=region, place=place):
                self.finds(names, plain, self.config("other", rectangle(0.1, 0.9, 0.1, 0.9) + circle(*place), region))

    def test_rings_that_the_mesh_does_not_have(self):
        """A round third ring of a contour has no corner that would be missed; a hole in a simplified shape is found,
        too."""
        square, lake = "0.1 0.1\n0.9 0.1\n0.9 0.9\n0.1 0.9\n", "0.3 0.3\n0.6 0.3\n0.6 0.6\n0.3 0.6\n"
        disc = "".join(f"{0.75 + 0.1 * math.cos(k / 10)!r} {0.75 + 0.1 * math.sin(k / 10)!r}\n" for k in range(62))
        coast = "".join(f"{0.5 + r * math.cos(k / 300)!r} {0.5 + r * math.sin(k / 300)!r}\n"
                        for k in range(1885) for r in [0.4 + 0.01 * math.sin(k * k)])
        files = {"two.xy": f"{square}\n{lake}", "three.xy": f"{square}\n{lake}\n{disc}", "coast.xy": coast,
                 "pond.xy": f"{coast}\n{lake}",
                 "island.xy": f"{coast}\n" + lake.replace("0.3", "0.0").replace("0.6", "0.1")}
        mesh = self.mesh(self.config("two", contour("two.xy"), files=files))
        self.finds(["outside", "uncovered_curves"], mesh, self.config("three", contour("three.xy")))
        mesh = self.mesh(self.config("coast", contour("coast.xy")))
        with h5py.File(mesh) as file:
            self.assertNotIn(b"kept", file["trime_mpi/rings/state"][:])
        self.passes(mesh)
        self.finds(["outside"], mesh, self.config("pond", contour("pond.xy")))
        self.finds(["uncovered_places"], mesh, self.config("island", contour("island.xy")))

    def test_polygons_of_geojson_and_segments_of_poly(self):
        """A square with a hole passes; without the hole, or with another one, it does not."""
        square, hole = HOLED["it.poly"], "5 0.4 0.4\n6 0.6 0.4\n7 0.6 0.6\n8 0.4 0.6\n"
        files = HOLED | {"other.poly": square.replace(hole, hole.replace("0.6", "0.55")),
                         "other.geojson": geojson(SQUARE + SQUARE[:1])}
        for ending in ("poly", "geojson"):
            with self.subTest(ending=ending):
                config = self.config(f"it_{ending}", contour(f"it.{ending}"), files=files)
                path = self.mesh(config)
                text = self.passes(path, config)
                for name in ("outside", "uncovered_curves", "uncovered_places", "facet_parts", "corners"):
                    self.assertRegex(text, rf"(?m)^ok +{name} ")
                self.finds(["uncovered_places"] + (["uncovered_curves"] if ending == "poly" else []), path,
                           self.config("other", contour(f"other.{ending}")))

    def test_maps_in_degrees(self):
        """Polygons, lines and shapefiles in longitude and latitude; long edges are curves in the plane."""
        bay = [[4, 60], [6, 60], [6, 61], [4, 61], [4, 60]]
        isle, other = ([[x + 5, y + 60.5] for x, y in ring] for ring in (
            ([0, 0], [0.2, 0.1], [0, 0.2], [0, 0]), ([0, 0], [0.2, 0.1], [0.05, 0.2], [0, 0])))
        maps = {"polygon": {"type": "Polygon", "coordinates": [bay, isle]},
                "lines": {"type": "MultiLineString", "coordinates": [bay[:3], bay[2:], isle]},
                "other": {"type": "Polygon", "coordinates": [bay, other]}}
        for name, geometry in maps.items():
            (self.work / f"{name}.geojson").write_text(json.dumps(geometry))
        subprocess.run(["ogr2ogr", "-t_srs", "EPSG:32631", self.work / "utm.shp", self.work / "polygon.geojson"],
                       check=True, timeout=60)
        subprocess.run(["ogr2ogr", self.work / "degrees.shp", self.work / "lines.geojson"], check=True, timeout=60)
        (self.work / "fixed.xy").write_text("4.5 60.5\n")
        meshing = "points = 700\nkeep_features = true\nfixed_points = fixed.xy\n"
        configs = {}
        for file in ("polygon.geojson", "lines.geojson", "degrees.shp", "utm.shp", "other.geojson"):
            name, ending = file.split(".")
            configs[file] = self.config(f"{name}_{ending}", contour(file), "a\nprojection = auto",
                                        meshing=meshing[:meshing.index("fixed")] if name == "utm" else meshing)
            path = self.mesh(configs[file])
            text = self.passes(path)
            for check_name in ("container", "lattice", "fixed_points", "corners", "on_curve", "outside",
                               "uncovered_curves", "uncovered_places"):
                self.assertRegex(text, rf"(?m)^ok +{check_name} ")
        mesh = self.work / "polygon_geojson.h5"
        self.finds(["corners", "on_curve"], mesh, configs["other.geojson"])
        plane = h5py.File(mesh)["trime_mpi"].attrs["crs"].decode()
        named = self.config("named", contour("degrees.shp"), f"a\nprojection = {plane}", meshing=meshing)
        self.passes(mesh, named)
        code, text = check(mesh, self.config("utm_read", contour("utm.shp"), "a\nprojection = auto"))
        self.assertEqual(code, 5, text)  # edges that are straight in UTM are curves in degrees
        self.assertEqual(re.findall(r"(?m)^WRONG +(\S+)", text), ["fixed_inside", "on_curve"])  # no fixed points

    def test_loops_that_were_dropped(self):
        """The report says that curves have no facets there."""
        island = "0.9500 0.95\n0.9504 0.95\n0.9502 0.9503\n"
        files = {"dropped.xy": f"0.1 0.1\n0.9 0.1\n0.9 0.9\n0.1 0.9\n\n{island}"}
        text = self.passes(self.mesh(self.config("dropped", contour("dropped.xy"), files=files)))
        self.assertRegex(text, r"(?m)^-- +uncovered_loops +not checked: .* that were simplified or dropped: 1$")

    def test_a_hole_that_was_filled(self):
        """The torus has no boundary then, and the size of its triangles says how large a hole may be."""
        config = self.config("filled", circle(0.7, 0.6, 0.024), "difference(domain, b)",
                             domain="periodic_x = true\nperiodic_y = true\n", meshing="points = 131\ncleanup = false\n")
        path = self.mesh(config)
        with h5py.File(path) as file:
            self.assertEqual(list(file["trime_mpi/rings/state"][:]), [b"filled"])
        self.passes(path, config)

    def test_shapes_without_curves(self):
        """trime_check does not check formulas, and its report says so. A part that the region does not name does not
        matter."""
        formula = "[shape.f]\ntype = expression\nsdf = sqrt((x-0.5)^2+(y-0.5)^2)-0.3\n"
        text = self.passes(self.mesh(self.config("formula", formula, "f")))
        self.assertRegex(text, r"(?m)^-- +region_cover +not checked: .* part f")
        text = self.passes(self.mesh(self.config("unused", formula + rectangle(0.1, 0.9, 0.1, 0.9))))
        self.assertRegex(text, r"(?m)^ok +uncovered_places")


if __name__ == "__main__":
    unittest.main()
