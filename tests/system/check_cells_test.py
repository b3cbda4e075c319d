#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests that trime_check proves the Voronoi cells of a mesh file, and finds damage in them."""
import re
import unittest

import h5py
import numpy as np

from check_test import GEOMETRY, TOPOLOGY, change, check, check_damaged, replace, seal
from region_meshes import rectangle, region
from trime_run import WorkspaceCase, run

HALVES = (rectangle("box", (0, 0), (1, 1)) + rectangle("left", (0, 0), (0.5, 1)) + region("soft", "left") +
          "[shape]\ngeometry = box\nrest = hard\n[meshing]\npoints = 600\n")
TORUS = ("[domain]\nx_min = 0\nx_max = 1\ny_min = 0\ny_max = 1\nperiodic_x = true\nperiodic_y = true\n"
         "[shape]\ngeometry = domain\n[meshing]\npoints = 300\n")
CHECKS = ["cell_arrays", "cell_numbers", "cell_centres", "cell_polygons", "cell_duality", "cell_positive", "cell_areas",
          "cell_centroids", "cell_cover", "cell_vertices", "cell_rim", "cell_euler", "cell_faces", "cell_lengths",
          "cell_negative", "cell_outside"]
CELL = "Cells/"


def scale(name, index, factor):
    return lambda file: change(file, CELL + name, index, file[CELL + name][index] * factor)


def swap_corners(file):
    """Two neighbouring corners of a polygon change places."""
    corners, first = file[CELL + "corners"], file[CELL + "corner_first"][200]
    corners[first:first + 2] = corners[first:first + 2][::-1]


def lose_polygon(file):
    """The last one, with its corners."""
    first = file[CELL + "corner_first"][:]
    replace(file, CELL + "corners", file[CELL + "corners"][:first[-2]])
    replace(file, CELL + "corner_first", first[:-1])
    for name in ("sites", "regions", "areas", "centroids"):
        replace(file, CELL + name, file[CELL + name][:-1])


def lose_face(file):
    for name in ("faces", "face_distances", "face_lengths", "face_regions"):
        replace(file, CELL + name, file[CELL + name][1:])


def divided(file):
    """A face in two regions."""
    return int(np.flatnonzero(file[CELL + "face_regions"][:, 1])[3])


def shear(file):
    """Shears the whole mesh with its cells: circumcentres move elsewhere, and some of them lie outside."""
    xy = file[GEOMETRY][:]
    xy[:, 0] += np.round(0.75 * xy[:, 1] * 2.0**40) / 2.0**40
    file[GEOMETRY][:] = xy
    seal(file)


# What is done to the cells of HALVES, and the checks that must find it.
DAMAGES = {
    "a circumcentre moved": (lambda f: change(f, CELL + "vertices", (50, 0), f[CELL + "vertices"][50, 0] + 1e-5),
                             ["cell_centres", "cell_areas"]),
    "a middle moved": (lambda f: change(f, CELL + "vertices", (len(f[TOPOLOGY]) + 3, 1), 0.123), ["cell_polygons"]),
    "a vertex that is not a number": (lambda f: change(f, CELL + "vertices", (9, 0), np.nan), ["cell_numbers"]),
    "a corner of another cell": (lambda f: change(f, CELL + "corners", 77, 3), ["cell_polygons"]),
    "a corner out of range": (lambda f: change(f, CELL + "corners", 77, 10**7), ["cell_numbers"]),
    "corners swapped": (swap_corners, ["cell_polygons"]),
    "a polygon cut short": (lambda f: change(f, CELL + "corner_first", 100, f[CELL + "corner_first"][100] - 1),
                            ["cell_polygons"]),
    "a polygon lost": (lose_polygon, ["cell_numbers"]),
    "a cell of another site": (lambda f: change(f, CELL + "sites", 100, 3), ["cell_numbers"]),
    "a part of another region": (lambda f: change(f, CELL + "regions", 100, 3 - f[CELL + "regions"][100]),
                                 ["cell_polygons", "cell_cover"]),
    "an area changed": (scale("areas", 30, 1 + 1e-7), ["cell_areas", "cell_cover"]),
    "an area changed a little": (scale("areas", 30, 1 + 4e-9), ["cell_areas", "cell_cover"]),
    "a centroid moved": (lambda f: change(f, CELL + "centroids", (30, 1), f[CELL + "centroids"][30, 1] + 1e-4),
                         ["cell_centroids"]),
    "a length changed": (lambda f: scale("face_lengths", (500, 0), 1 + 1e-6)(f), ["cell_lengths"]),
    "a negative length": (lambda f: change(f, CELL + "face_lengths", (500, 0), -1e-6), ["cell_negative"]),
    "lengths of two regions swapped": (lambda f: change(f, CELL + "face_regions", divided(f),
                                                        f[CELL + "face_regions"][divided(f)][::-1]), ["cell_lengths"]),
    "a distance changed": (scale("face_distances", 40, 1 + 1e-6), ["cell_lengths"]),
    "a face between others": (lambda f: change(f, CELL + "faces", (40, 1), f[CELL + "faces"][40, 1] + 1),
                              ["cell_faces"]),
    "a face lost": (lose_face, ["cell_faces"]),
    "the mesh sheared": (shear, ["cell_centres", "cell_outside", "cell_lengths"]),
    "an array lost": (lambda f: f.__delitem__(CELL + "areas"), ["cell_arrays"]),
    "an array of another type": (lambda f: replace(f, CELL + "areas", np.float32(f[CELL + "areas"][:])),
                                 ["cell_arrays"]),
}


class CheckCells(WorkspaceCase):
    def mesh(self, text, name, formats="vtkhdf xdmf voronoi", ranks=1):
        path = self.directory / f"{name}.ini"
        path.write_text(text)
        done = run(path, f"output.directory={self.directory}", f"output.name={name}", f"output.formats={formats}",
                   ranks=ranks)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return self.directory / f"{name}.h5"

    def test_proves_cells_and_finds_every_damage(self):
        whole = self.mesh(HALVES, "halves", ranks=2)
        code, text = check(whole)
        self.assertEqual(code, 0, text)
        self.assertEqual(re.findall(r"^ok +(cell_\w+)", text, re.M), CHECKS)
        for name, (damage, names) in DAMAGES.items():
            with self.subTest(damage=name):
                code, text = check_damaged(whole, self.directory / "damaged.h5", damage)
                self.assertEqual(code, 5, text)
                wrong = re.findall(r"^WRONG +(\w+)", text, re.M)
                for expected in names:
                    self.assertIn(expected, wrong, text)

    def test_a_torus(self):
        torus = self.mesh(TORUS, "torus")
        code, text = check(torus)
        self.assertEqual(code, 0, text)
        self.assertIn("cell_euler           expected 0, found 0", text)
        with h5py.File(torus) as file:
            self.assertAlmostEqual(file[CELL + "areas"][:].sum(), 1, delta=1e-12)
            self.assertEqual(len(file[CELL + "faces"]), 3 * len(file[GEOMETRY]))

    def test_a_refined_mesh_has_cells_too(self):
        """The cells of four times as many triangles; those of a file without cells have none."""
        for formats in ("vtkhdf xdmf voronoi", "vtkhdf xdmf"):
            coarse = self.mesh(HALVES, formats.rsplit(" ", maxsplit=1)[-1], formats=formats)
            fine = coarse.with_name("fine.h5")
            done = run("refine", coarse, fine, "--overwrite", ranks=2)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            code, text = check(fine)
            self.assertEqual(code, 0, text)
            self.assertEqual(re.findall(r"^ok +(cell_\w+)", text, re.M), CHECKS if "voronoi" in formats else [])
            with h5py.File(fine) as file:
                self.assertEqual("Cells" in file, "voronoi" in formats)

    def test_without_cells_there_is_no_group(self):
        path = self.mesh(HALVES, "plain", formats="vtkhdf xdmf")
        with h5py.File(path) as file:
            self.assertNotIn("Cells", file)
        code, text = check(path)
        self.assertEqual(code, 0, text)
        self.assertNotIn("cell_areas", text)


if __name__ == "__main__":
    unittest.main()
