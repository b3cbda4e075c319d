#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests the coordinates of users.

File and report of a normalised contour in metres contain the way back, and messages name lines and places. Shapes from
text and from GeoJSON keep their coordinates.
"""
import json
import math
import re
import unittest

import h5py
import numpy

from trime_run import Workspace, run

EAST, NORTH, SIDE = 4.5e6, 5.4e6, 2e5
SQUARE = [(EAST, NORTH), (EAST + SIDE, NORTH), (EAST + SIDE, NORTH + SIDE), (EAST, NORTH + SIDE)]
CONFIG = ("[shape]\ngeometry = sea\n[shape.sea]\ntype = contour\nfile = coast.xy\nnormalize = true\n"
          "[meshing]\npoints = 1000\n")


class UserCoordinates(unittest.TestCase):
    def mesh(self, directory, ring, *overrides):
        text = "# Gauss-Krueger\r" + "".join(f"{x!r} {y!r}\r".replace("e", "D") for x, y in ring)
        (directory / "coast.xy").write_bytes(text.encode("ascii"))
        (directory / "job.ini").write_text(CONFIG, "ascii")
        return run(directory / "job.ini", *overrides, f"output.directory={directory}", "--verbose", ranks=2)

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
            place = re.search(r"worst triangle at \((\S+), (\S+)\) \[.*coast\.xy:[2-5]: \((\S+), (\S+)\)\]",
                              done.stdout)
            x, y, user_x, user_y = (float(word) for word in place.groups())
            self.assertLess(math.hypot((x - shift[0]) / scale - user_x, (y - shift[1]) / scale - user_y), 0.01 * SIDE)

    def test_an_error_in_the_container_names_the_file(self):
        angle = math.radians(1e-4)
        tip = [(EAST, NORTH), (EAST + SIDE, NORTH), (EAST + SIDE * math.cos(angle), NORTH + SIDE * math.sin(angle))]
        with Workspace() as directory:
            done = self.mesh(directory, tip, "meshing.keep_features=true")
            self.assertEqual(done.returncode, 3, done.stdout + done.stderr)
            self.assertRegex(done.stderr,
                             r"too narrow near \(0\.1\S*, 0\.\S+\) \[.*coast\.xy:2: \(4500000\S*, 5400000\S*\)\]")

    def test_without_a_container_coordinates_stay(self):
        """A contour in metres and no [domain]: the file has its coordinates; the printed config gives the same mesh."""
        with Workspace() as directory:
            (directory / "coast.xy").write_text("".join(f"{x!r} {y!r}\n" for x, y in SQUARE))
            config = directory / "job.ini"
            config.write_text(CONFIG.replace("normalize = true\n", ""))
            hashes = set()
            for ranks, name in ((1, "one"), (3, "three")):
                done = run(config, f"output.directory={directory}", f"output.name={name}", "--verbose", ranks=ranks)
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                self.assertIn("container: x from 4490000 to 4710000, y from 5390000 to 5610000, "
                              "chosen around the shape", done.stdout)
                with h5py.File(directory / f"{name}.h5", "r") as file:
                    hashes.add(int(file["trime_mpi"].attrs["mesh_hash"]))
                    points = file["Mesh/mesh/geometry"][:]
                for corner in SQUARE:  # to the lattice of the container
                    self.assertLess(numpy.abs(points - corner).max(axis=1).min(), 1e-9 * SIDE)
            config.write_text(run(config, "--print-config").stdout)
            done = run(config, f"output.directory={directory}", "output.name=again")
            with h5py.File(directory / "again.h5", "r") as file:
                hashes.add(int(file["trime_mpi"].attrs["mesh_hash"]))
            self.assertEqual(len(hashes), 1)
            done = run(config, "domain.x_min=0")  # a side that is given is obeyed, and the others are 0 and 1
            self.assertEqual(done.returncode, 3, done.stdout)
            self.assertRegex(done.stderr, "coast.xy.* container")

    def test_a_map_in_geojson(self):
        """Longitude and latitude of a coast with a lake, as they are: the same mesh on any ranks, mistakes by line."""
        coast = [[8.0, 54.0], [9.5, 54.1], [9.25, 55.0], [8.25, 54.8], [8.0, 54.0]]
        lake = [[8.5, 54.3], [8.6, 54.6], [8.9, 54.4], [8.5, 54.3]]
        text = json.dumps({"type": "Feature", "properties": {"name": "coast"},
                           "geometry": {"type": "Polygon", "coordinates": [coast, lake]}}, indent=1)
        with Workspace() as directory:
            config = directory / "job.ini"
            config.write_text(CONFIG.replace("coast.xy", "coast.geojson").replace("normalize = true\n", ""))
            (directory / "coast.geojson").write_text(text)
            hashes = set()
            for ranks in (1, 3):
                done = run(config, f"output.directory={directory}", f"output.name=on_{ranks}", ranks=ranks)
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                with h5py.File(directory / f"on_{ranks}.h5", "r") as file:
                    hashes.add(int(file["trime_mpi"].attrs["mesh_hash"]))
                    points = file["Mesh/mesh/geometry"][:]
                for vertex in coast + lake:
                    self.assertLess(numpy.abs(points - vertex).max(axis=1).min(), 1e-9)
            self.assertEqual(len(hashes), 1)
            crossed = text.replace("8.25", "9.99")  # the ring crosses itself
            (directory / "coast.geojson").write_text(crossed)
            for ranks in (1, 3):
                done = run(config, "--validate", ranks=ranks)
                self.assertEqual(done.returncode, 3, done.stdout + done.stderr)
                self.assertRegex(done.stderr, r"coast\.geojson:\d+")


if __name__ == "__main__":
    unittest.main()
