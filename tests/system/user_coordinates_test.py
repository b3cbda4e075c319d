#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""A normalised contour in metres: file and report tell the way back to its coordinates, messages its lines and places."""
import math
import re
import unittest

import h5py
import numpy

from trime_run import Workspace, run

EAST, NORTH, SIDE = 4.5e6, 5.4e6, 2e5
SQUARE = [(EAST, NORTH), (EAST + SIDE, NORTH), (EAST + SIDE, NORTH + SIDE), (EAST, NORTH + SIDE)]
CONFIG = ("[shape]\nregion = sea\n[shape.sea]\ntype = contour\nfile = coast.xy\nnormalize = true\n"
          "[meshing]\npoints = 1000\n")


class UserCoordinates(unittest.TestCase):
    def mesh(self, directory, ring, *overrides):
        text = "# Gauss-Krueger\r" + "".join(f"{x!r} {y!r}\r".replace("e", "D") for x, y in ring)
        (directory / "coast.xy").write_bytes(text.encode("ascii"))
        (directory / "job.ini").write_text(CONFIG, "ascii")
        return run(directory / "job.ini", *overrides, f"output.directory={directory}", ranks=2)

    def test_the_way_back(self):
        with Workspace() as directory:
            done = self.mesh(directory, SQUARE)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            with h5py.File(directory / "job.h5", "r") as file:
                group = file["trime_mpi"]
                scale, *shift = (group.attrs[f"normalize_{name}"] for name in ("scale", "shift_x", "shift_y"))
                table = group["normalization"]
                self.assertEqual([table["part_name"][0], table["scale"][0], table["shift_x"][0], table["shift_y"][0]],
                                 [b"sea", scale, *shift])
                points = (file["Mesh/mesh/geometry"][:] - shift) / scale
            numpy.testing.assert_allclose(points.min(axis=0), (EAST, NORTH), atol=1e-6)
            numpy.testing.assert_allclose(points.max(axis=0), (EAST + SIDE, NORTH + SIDE), atol=1e-6)
            told = re.search(r"Normalized: part 'sea', .*\(x - (\S+)\)/s and \(y - (\S+)\)/s .* s = (\S+)", done.stdout)
            self.assertEqual([float(word) for word in told.groups()], [*shift, scale])
            place = re.search(r"worst triangle at \((\S+), (\S+)\) \[.*coast\.xy:[2-5]: \((\S+), (\S+)\)\]", done.stdout)
            x, y, user_x, user_y = (float(word) for word in place.groups())
            self.assertLess(math.hypot((x - shift[0]) / scale - user_x, (y - shift[1]) / scale - user_y), 0.01 * SIDE)

    def test_an_error_in_the_container_names_the_file(self):
        angle = math.radians(1e-4)
        tip = [(EAST, NORTH), (EAST + SIDE, NORTH), (EAST + SIDE * math.cos(angle), NORTH + SIDE * math.sin(angle))]
        with Workspace() as directory:
            done = self.mesh(directory, tip, "meshing.keep_features=true")
            self.assertEqual(done.returncode, 3, done.stdout + done.stderr)
            self.assertRegex(done.stderr, r"too narrow near \(0\.1\S*, 0\.\S+\) \[.*coast\.xy:2: \(4500000\S*, 5400000\S*\)\]")


if __name__ == "__main__":
    unittest.main()
