#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests that trime_check finds damage outside of the triangles: in labels, tables, attributes, sizes and views."""
import pathlib
import re
import tempfile
import unittest

import h5py
import numpy as np

from check_test import change, check, check_damaged, inner, replace
from trime_run import ROOT, run

FACETS, TAGS, SIZE = "Mesh/facets/", "trime_mpi/tags/", "VTKHDF/PointData/size"


def attribute(name, value, group="trime_mpi"):
    return lambda file: file[group].attrs.modify(name, value)


def lost_attribute(name, group="trime_mpi"):
    return lambda file: file[group].attrs.__delitem__(name)


def turned(name):
    return lambda file: file[name].__setitem__(..., file[name][:][::-1])


def times(name, factor):
    return lambda file: file[name].__setitem__(..., file[name][:] * file[name].dtype.type(factor))


def swap_parts(file):
    """Swaps two parts with their labels, so that only the names of the loops are wrong."""
    for name, both in (("parts", 1), ("labels", 3)):
        file[FACETS + name][:] = both - file[FACETS + name][:]


# What is done to the file of spade_fixed_points.ini, and the check that must speak.
DAMAGES = {
    "labels of others": (lambda f: change(f, FACETS + "labels", slice(0, 20), 7), "labels"),
    "no labels": (lambda f: f.__delitem__(FACETS + "labels"), "arrays"),
    "labels of another type": (lambda f: replace(f, FACETS + "labels", f[FACETS + "labels"][:].astype(np.int64)),
                               "arrays"),
    "markers where there are none": (lambda f: f.create_dataset(FACETS + "markers", data=f[FACETS + "parts"][:]),
                                     "markers"),
    "parts swapped": (swap_parts, "edge_name"),
    "parts of the other end": (turned(FACETS + "parts"), "labels"),
    "names of parts turned round": (turned(TAGS + "part_name"), "edge_name"),
    "names of loops turned round": (turned(TAGS + "edge_name"), "edge_name"),
    "kinds of loops turned round": (turned(TAGS + "edge_kind"), "edge_kind"),
    "no kinds of loops": (lambda f: f.__delitem__(TAGS + "edge_kind"), "edge_kind"),
    "no markers of parts": (lambda f: f.__delitem__(TAGS + "part_marker"), "columns"),
    "no names of regions": (lambda f: f.__delitem__(TAGS + "region_name"), "columns"),
    "first points of ranks": (lambda f: change(f, "trime_mpi/ranks/first_point", 0, 5), "columns"),
    "components": (attribute("components", np.int64(2)), "attributes"),
    "holes": (attribute("holes", np.int64(3)), "attributes"),
    "corners": (attribute("corners", np.int64(77)), "attributes"),
    "smallest size": (attribute("smallest_size", 0.5), "attributes"),
    "largest size": (attribute("largest_size", 0.5), "attributes"),
    "area of the shape": (attribute("shape_area", 77.0), "attributes"),
    "no area of the shape": (lost_attribute("shape_area"), "attributes"),
    "no version of the format": (lost_attribute("format_version"), "format"),
    "another version of the format": (attribute("format_version", np.int64(2)), "format"),
    "no type for VTK": (lost_attribute("Type", "VTKHDF"), "format"),
    "no version for VTK": (lost_attribute("Version", "VTKHDF"), "format"),
    "no dimension of cells": (lost_attribute("cell_dim", "Mesh/mesh/topology"), "format"),
    "no plain mesh": (lambda f: f.__delitem__("Mesh/mesh"), "format"),
    "no plain mesh and no links": (lambda f: [f.__delitem__(name) for name in ("Mesh/mesh", "geometry", "viz")],
                                   "format"),
    "triangles of another region": (lambda f: change(f, "VTKHDF/CellData/region", slice(0, 99), 5), "region"),
    "sizes": (times(SIZE, 5), "size_mean"),
    "asked sizes": (times(FACETS + "asked_size", 1000), "asked_to_size"),
    "a point inside that is fixed": (lambda f: change(f, "VTKHDF/PointData/fixed", inner(f)[0], 1), "fixed_inside"),
    "no point that is fixed": (times("VTKHDF/PointData/fixed", 0), "attributes"),
    "all points fixed": (lambda f: change(f, "VTKHDF/PointData/fixed", slice(None), 1), "fixed_inside"),
}


class Tables(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.work = pathlib.Path(folder.name)

    def mesh(self, config, *arguments):
        done = run(config, f"output.directory={self.work}", *arguments)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        path = self.work / f"{config.stem}.h5"
        code, text = check(path)
        self.assertEqual(code, 0, text)
        self.assertRegex(text, r"(?m)^-- +provenance +not checked")
        return path

    def finds(self, whole, damage, name):
        code, text = check_damaged(whole, self.work / "damaged.h5", damage)
        self.assertEqual(code, 5, text)
        self.assertIn(name, re.findall(r"(?m)^WRONG +(\S+)", text), text)

    def test_finds_every_damage(self):
        whole = self.mesh(ROOT / "configs" / "spade_fixed_points.ini", "meshing.points=1200")
        for damage, (do, name) in DAMAGES.items():
            with self.subTest(damage=damage):
                self.finds(whole, do, name)

    def test_a_uniform_size(self):
        whole = self.mesh(ROOT / "configs" / "square.ini", "meshing.points=1200")
        self.finds(whole, attribute("edge_length", 0.03), "attributes")
        self.finds(whole, times(FACETS + "asked_size", 1.01), "asked_size")

    def test_kinds_in_a_periodic_container(self):
        config = self.work / "strip.ini"
        config.write_text("[domain]\nperiodic_x = true\n[shape]\ngeometry = difference(domain, disc)\n[shape.disc]\n"
                          "type = circle\ncenter = 1 0.5\nradius = 0.2\n[meshing]\npoints = 900\n", "ascii")
        whole = self.mesh(config)
        with h5py.File(whole) as file:
            self.assertEqual(sorted(file[TAGS + "edge_kind"][:]), [b"band", b"band", b"hole"])
        self.finds(whole, lambda f: change(f, TAGS + "edge_kind", slice(None), b"hole"), "edge_kind")

    def test_markers(self):
        """In a .poly file each marker is a separate part."""
        (self.work / "frame.poly").write_text("4 2 0 1\n1 0.1 0.1 0\n2 0.9 0.1 0\n3 0.9 0.9 0\n4 0.1 0.9 0\n"
                                              "4 1\n1 1 2 1\n2 2 3 5\n3 3 4 1\n4 4 1 1\n0\n", "ascii")
        config = self.work / "frame.ini"
        config.write_text("[shape]\ngeometry = frame\n[shape.frame]\ntype = contour\nfile = frame.poly\n"
                          "[meshing]\npoints = 700\n", "ascii")
        whole = self.mesh(config)
        self.finds(whole, lambda f: change(f, FACETS + "markers", 3, 2), "markers")
        self.finds(whole, lambda f: f.__delitem__(FACETS + "markers"), "markers")
        self.finds(whole, turned(TAGS + "part_marker"), "markers")


if __name__ == "__main__":
    unittest.main()
