#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests that trime_check finds damage in the regions of a mesh, and regions that are not those of the config."""
import json
import pathlib
import re
import shutil
import tempfile
import unittest

import h5py
import numpy as np

from check_test import GEOMETRY, TOPOLOGY, change, check, check_damaged, replace
from trime_run import run

CONFIG = """[shape]
geometry = domain
rest = top
[shape.west]
type = rectangle
x_min = 0
y_min = 0
x_max = 0.5
y_max = 1
[shape.south]
type = rectangle
x_min = 0
y_min = 0
x_max = 1
y_max = 0.5
[shape.disc]
type = circle
center = 0.75 0.75
radius = 0.15
[curve.wall]
file = wall.xy
[region.left]
geometry = west
[region.low]
geometry = south
[region.round]
geometry = disc
[meshing]
points = 1200
"""
REGION, FACES, PAIRS, TAGS = "VTKHDF/CellData/region", "Mesh/interfaces/", "trime_mpi/interfaces/", "trime_mpi/tags/"


def sides_of(file):
    """Region and number of the triangle on the left of each edge."""
    return {(t[k], t[(k + 1) % 3]): (int(region), n)
            for n, (region, t) in enumerate(zip(file[REGION][:], file[TOPOLOGY][:].tolist())) for k in range(3)}


def list_interfaces(file):
    """Lists the interfaces of the regions that the triangles have, so that other checks must find what is wrong."""
    sides = sides_of(file)
    pairs = list(zip(file[PAIRS + "left"][:], file[PAIRS + "right"][:]))
    curves = {tuple(sorted(edge)): number for edge, number in zip(file["Mesh/curves/topology"][:].tolist(),
                                                                  file["Mesh/curves/values"][:])}
    edges = sorted(edge for edge in sides if sides[edge][0] < sides.get(edge[::-1], (0,))[0])
    regions = [(sides[edge][0], sides[edge[::-1]][0]) for edge in edges]
    values = np.array([pairs.index(pair) for pair in regions], np.int32)
    replace(file, FACES + "topology", np.array(edges, np.int64))
    replace(file, FACES + "regions", np.array(regions, np.int32))
    replace(file, FACES + "values", values)
    replace(file, FACES + "labels", file[PAIRS + "label"][:][values].astype(np.int32))
    replace(file, FACES + "curves", np.array([curves.get(tuple(sorted(edge)), -1) for edge in edges], np.int32))
    others = file[FACES + "curves"][:] == -1
    lists = [(file["Mesh/facets/topology"][:], file["Mesh/facets/labels"][:]),
             (file["Mesh/curves/topology"][:], file["Mesh/curves/labels"][:]),
             (file[FACES + "topology"][:][others], file[FACES + "labels"][:][others])]
    replace(file, "Mesh/lines/topology", np.vstack([edges for edges, _ in lists]))
    replace(file, "Mesh/lines/labels", np.concatenate([labels for _, labels in lists]))


def inner_triangle(file):
    """A triangle of region 2 that is far from other regions."""
    centroids = file[GEOMETRY][:][file[TOPOLOGY][:]].mean(axis=1)
    return int(np.argmin(np.hypot(*(centroids - [0.25, 0.3]).T)))


def border_triangle(file):
    """A triangle of region 2 at an edge of region 3."""
    sides = sides_of(file)
    return next(n for edge, (region, n) in sorted(sides.items()) if region == 2 and sides.get(edge[::-1], (0,))[0] == 3)


def other_region(find, listed):
    def damage(file):
        change(file, REGION, find(file), 3)
        if listed:
            list_interfaces(file)
    return damage


def swap_regions(listed):
    def damage(file):
        numbers = np.array([0, 1, 3, 2, 4], np.int32)
        file[REGION][:] = numbers[file[REGION][:]]
        if listed:
            list_interfaces(file)
    return damage


def rows(chosen):
    """Keeps the chosen rows of all arrays of interfaces."""
    def damage(file):
        for name in list(file[FACES]):
            replace(file, FACES + name, file[FACES + name][:][chosen(len(file[FACES + "values"]))])
    return damage


def turn(with_regions):
    def damage(file):
        for name in ["topology"] + ["regions"] * with_regions:
            change(file, FACES + name, 7, file[FACES + name][7][::-1])
    return damage


def foreign(file):
    """An edge in the middle of a region in the place of an interface."""
    change(file, FACES + "topology", 7, file[TOPOLOGY][inner_triangle(file), :2])


def other_config(old, new):
    def damage(file):
        text = file["trime_mpi/config_resolved"][()].decode()
        replace(file, "trime_mpi/config_resolved", np.bytes_(re.sub(old, new, text)))
    return damage


def swapped(name):
    return {"[region.left]": "[region.low]", "[region.low]": "[region.left]"}[name[0]]


# What is done to the file, and the checks that must speak.
DAMAGES = {
    "a wrong region inside": (other_region(inner_triangle, False), ["interfaces", "region_area", "region_places"]),
    "a wrong region at a border": (other_region(border_triangle, False), ["interfaces", "interface_foreign"]),
    "a wrong region inside, with its interfaces": (other_region(inner_triangle, True), ["region_places"]),
    "a wrong region at a border, with its interfaces": (other_region(border_triangle, True), ["interface_places"]),
    "a region that does not exist": (lambda f: change(f, REGION, inner_triangle(f), 9), ["region", "interfaces"]),
    "regions swapped": (swap_regions(False), ["interface_sides", "interface_regions", "region_places"]),
    "regions swapped, with their interfaces": (swap_regions(True), ["region_places"]),
    "an interface lost": (rows(lambda n: slice(0, n - 1)), ["interfaces", "region_borders"]),
    "all interfaces lost": (lambda f: f.__delitem__("Mesh/interfaces"), ["interfaces", "region_borders"]),
    "an interface twice": (rows(lambda n: [*range(n), 7]), ["interface_once", "region_borders"]),
    "an edge that is no interface": (foreign, ["interfaces", "interface_foreign"]),
    "an interface turned": (turn(False), ["interface_sides", "region_borders"]),
    "an interface turned, with its regions": (turn(True), ["interface_sides", "interface_regions"]),
    "regions of an interface": (lambda f: change(f, FACES + "regions", (7, 1), 1), ["interface_regions"]),
    "pair of an interface": (lambda f: change(f, FACES + "values", 7, 99), ["interface_regions", "interface_labels"]),
    "label of an interface": (lambda f: change(f, FACES + "labels", 7, 1), ["interface_labels"]),
    "curves of interfaces": (lambda f: change(f, FACES + "curves", slice(None), -1), ["interface_curves"]),
    "a point that does not exist": (lambda f: change(f, FACES + "topology", (7, 1), 10**9), ["id_range"]),
    "no labels of interfaces": (lambda f: f.__delitem__(FACES + "labels"), ["arrays"]),
    "labels of another type": (lambda f: replace(f, FACES + "labels", f[FACES + "labels"][:].astype(np.int64)),
                               ["arrays"]),
    "an edge with another label": (lambda f: change(f, "Mesh/lines/labels", -1, 1), ["lines"]),
    "an edge with a label lost": (lambda f: [replace(f, name, f[name][:-1]) for name in
                                             ("Mesh/lines/topology", "Mesh/lines/labels")], ["lines"]),
    "name of a pair": (lambda f: change(f, PAIRS + "pair_name", 0, b"a|b"), ["interface_pairs"]),
    "regions of a pair": (lambda f: change(f, PAIRS + "left", 0, 4), ["interface_pairs", "interface_regions"]),
    "label of a pair": (lambda f: change(f, PAIRS + "label", 0, 1), ["interface_pairs"]),
    "no names of pairs": (lambda f: f.__delitem__(PAIRS + "pair_name"), ["interface_pairs"]),
    "name of a region": (lambda f: change(f, TAGS + "region_name", 2, b"left"), ["region_names", "region_list"]),
    "sections of the config turned round": (other_config(r"\[region\.(left|low)\]", swapped), ["region_list"]),
    "a region of the config elsewhere": (other_config("x_max = 0.5", "x_max = 0.3"),
                                         ["region_places", "interface_places"]),
    "a rest that must not be": (other_config("cover = rest", "cover = all"), ["region_rest"]),
}
IN_TABLE = {"triangles": lambda f: change(f, "trime_mpi/regions/triangles", 1, 5),
            "area": lambda f: change(f, "trime_mpi/regions/area", 1, 0.4999),
            "region_name": lambda f: change(f, "trime_mpi/regions/region_name", 1, b"none")}


class CheckRegions(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.work = pathlib.Path(tempfile.mkdtemp(prefix="trime-system-"))
        cls.addClassCleanup(shutil.rmtree, cls.work, ignore_errors=True)
        (cls.work / "wall.xy").write_text("0.5 0.2\n0.5 0.8\n", "ascii")
        (cls.work / "mesh.ini").write_text(CONFIG, "ascii")
        done = run(cls.work / "mesh.ini", f"output.directory={cls.work}")
        if done.returncode != 0:
            raise AssertionError(done.stdout + done.stderr)
        cls.whole = cls.work / "mesh.h5"

    def test_passes_the_mesh(self):
        code, text = check(self.whole)
        self.assertEqual(code, 0, text)
        self.assertRegex(text, r"(?m)^ok +region_places .* [1-9]\d* were tested")
        self.assertRegex(text, r"(?m)^ok +interface_places")
        self.assertRegex(text, r"(?m)^info +regions +1 top: .* triangles 0$")
        self.assertRegex(text, r"(?m)^info +regions +2 left: .* area 0.5, .* triangles 1$")
        self.assertRegex(text, r"(?m)^info +junctions .* 4 points with 3 of them$")
        with h5py.File(self.whole) as file:
            self.assertGreater(np.count_nonzero(file[FACES + "curves"][:] >= 0), 0)

    def test_a_list_made_here_is_sound(self):
        code, text = check_damaged(self.whole, self.work / "listed.h5", list_interfaces)
        self.assertEqual(code, 0, text)

    def test_sizes_and_polygons_of_a_map(self):
        """A region with small triangles, and regions by an attribute, whose places are not compared."""
        def square(x, unit):
            ring = [[x, 0.2], [x + 0.3, 0.2], [x + 0.3, 0.8], [x, 0.8], [x, 0.2]]
            return {"type": "Feature", "properties": {"unit": unit}, "geometry": {"type": "Polygon",
                                                                                  "coordinates": [ring]}}
        (self.work / "units.geojson").write_text(json.dumps(
            {"type": "FeatureCollection", "features": [square(0.1, "chalk"), square(0.4, "marl")]}), "ascii")
        for name, keys in (("fine", "geometry = part\nsize = 0.4"), ("map", "file = units.geojson\nattribute = unit")):
            config = self.work / f"{name}.ini"
            config.write_text("[shape]\ngeometry = domain\n[shape.part]\ntype = rectangle\nx_min = 0\ny_min = 0\n"
                              f"x_max = 0.3\ny_max = 1\n[region.{name}]\n{keys}\n[meshing]\npoints = 1500\n", "ascii")
            done = run(config, f"output.directory={self.work}")
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            code, text = check(self.work / f"{name}.h5")
            self.assertEqual(code, 0, text)
            self.assertRegex(text, r"(?m)^ok +region_list +expected domain, " +
                             ("map.chalk, map.marl" if name == "map" else "fine"))
            self.assertRegex(text, rf"(?m)^{'--' if name == 'map' else 'ok'} +region_places")

    def test_finds_every_damage(self):
        damages = dict(DAMAGES)
        with h5py.File(self.whole) as file:
            if "regions" in file["trime_mpi"]:
                damages.update({f"{name} in the table": (damage, ["region_table"])
                                for name, damage in IN_TABLE.items()})
        for name, (damage, names) in damages.items():
            with self.subTest(damage=name):
                code, text = check_damaged(self.whole, self.work / "damaged.h5", damage)
                self.assertEqual(code, 5, text)
                for expected in names:
                    self.assertIn(expected, re.findall(r"(?m)^WRONG +(\S+)", text), text)


if __name__ == "__main__":
    unittest.main()
