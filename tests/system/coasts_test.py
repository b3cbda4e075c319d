#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests meshes of real coasts of full resolution, of the land and of the water around it. What is above the resolution
is connected and separate as it was, and the first line of the warning says what else has changed.
"""
import re
import unittest

import numpy
from matplotlib.path import Path
from scipy import ndimage

import world_coasts
from topology_test import RESOLUTION, Mesh
from trime_run import Workspace, run

SHARES = (0.3, 3)  # points over vertices
CELLS = 4          # of the picture in which bodies are found, along h
LARGEST = 1200     # cells along a side: below, h is too small to look for bodies


class Picture:
    """The number of the island, from 1, at each node of a grid; 0 in the water."""

    def __init__(self, rings, box, step):
        (west, south), (east, north) = box
        self.box, self.step = box, step
        self.x, self.y = numpy.arange(west + step / 2, east, step), numpy.arange(south + step / 2, north, step)
        self.island = numpy.zeros((len(self.y), len(self.x)), int)
        for number, ring in enumerate(rings, 1):
            columns, rows = (numpy.flatnonzero((axis >= low) & (axis <= high)) for axis, low, high in
                             zip((self.x, self.y), ring.min(axis=0), ring.max(axis=0)))
            if len(columns) and len(rows):
                nodes = numpy.stack(numpy.meshgrid(self.x[columns], self.y[rows]), axis=-1).reshape(-1, 2)
                inside = Path(ring).contains_points(nodes).reshape(len(rows), len(columns))
                window = self.island[rows[0]:rows[-1] + 1, columns[0]:columns[-1] + 1]
                window[inside] = number

    def bodies(self, of_water, radius):
        """Places that are farther than the radius from the other side: (x, y, number of the island; 0 for water). There
        is one for each connected set of such nodes."""
        side = numpy.pad(self.island == 0 if of_water else self.island > 0, 1)
        distance = self.step * ndimage.distance_transform_edt(side)[1:-1, 1:-1]
        labels, count = ndimage.label(distance > radius)
        places = ndimage.maximum_position(distance, labels, range(1, count + 1))
        return [(self.x[k], self.y[i], self.island[i, k]) for i, k in places]


@unittest.skipUnless(world_coasts.DATABASE.exists(),
                     "needs the coasts of the Debian package gmt-gshhg-full, which is not installed")
class Coasts(unittest.TestCase):
    def prepare(self, work, rings, box, of_water):
        (work / "land.xy").write_text("\n".join("".join(f"{x:.9f} {y:.9f}\n" for x, y in ring) for ring in rings),
                                      "ascii")
        (west, south), (east, north) = box
        (work / "it.ini").write_text(
            f"[shape]\ngeometry = {'difference(sea, land)' if of_water else 'land'}\n"
            f"[shape.land]\ntype = contour\nfile = land.xy\n"
            f"[shape.sea]\ntype = rectangle\nx_min = {west}\nx_max = {east}\ny_min = {south}\ny_max = {north}\n",
            "ascii")
        return work / "it.ini"

    def judge(self, mesh, says, rings, box, of_water):
        """Bodies above the resolution, and what the warning says of all others."""
        made = (len(numpy.unique(mesh.component)), mesh.holes)
        given = (mesh.attributes["given_components"], mesh.attributes["given_holes"])
        self.assertEqual(made, (mesh.attributes["components"], mesh.attributes["holes"]))
        for name, then, now in (("component", given[0], made[0]), ("hole", given[1], made[1])):
            self.assertEqual(now != then, re.search(rf"{then} {name}s? became {now}\b", says) is not None, says)
        h = mesh.attributes["coarseness"] * mesh.asked.max()
        (west, south), (east, north) = box
        if CELLS * max(east - west, north - south) / h > LARGEST:
            return
        picture = Picture(rings, box, h / CELLS)
        component_of = {}
        for x, y, island in picture.bodies(of_water, RESOLUTION * h):
            triangle = mesh.at(x, y)
            self.assertIsNotNone(triangle, f"a body at {x}, {y}\n{says}")
            now = mesh.component[triangle]
            self.assertEqual(component_of.setdefault(island, now), now, f"{x}, {y}: it fell apart\n{says}")
        self.assertEqual(len(set(component_of.values())), len(component_of), f"what was separate is joined\n{says}")
        for x, y, _ in picture.bodies(not of_water, RESOLUTION * h):
            self.assertIsNone(mesh.at(x, y), f"{x}, {y} lies on the other side\n{says}")

    def test_land_and_water_of_regions(self):
        database = world_coasts.Database()
        for name, (west, south, east, north) in world_coasts.REGIONS.items():
            rings = world_coasts.in_the_plane(database.islands(west, south, east, north), south, north)
            all_points = numpy.concatenate(rings)
            box = (all_points.min(axis=0) - 0.1, all_points.max(axis=0) + 0.1)
            for of_water in (False, True):
                with Workspace() as work:
                    config = self.prepare(work, rings, box, of_water)
                    for share in SHARES:
                        points = round(share * len(all_points))
                        with self.subTest(region=name, water=of_water, points=points):
                            done = run(config, f"meshing.points={points}", f"output.directory={work}",
                                       "output.overwrite=true", "--quiet", threads=2)
                            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                            says = "".join(line for line in done.stdout.splitlines() if " became " in line)
                            self.judge(Mesh(work / "it.h5"), says, rings, box, of_water)


if __name__ == "__main__":
    unittest.main()
