#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests that no edge is shorter than `shortest_edge`, on rough coasts and with sizes of all types; and what the program
says where that is impossible.
"""
import math
import os
import random
import subprocess
import unittest

import h5py
import numpy

from trime_run import ROOT, Workspace, run

CHECK = os.environ.get("TRIME_CHECK", str(ROOT / "build" / "ci" / "src" / "check" / "trime_check"))
CONFIG = "[shape]\ngeometry = land\n[shape.land]\ntype = contour\nfile = land.xy\n[meshing]\npoints = 2500\n"


def coast(vertices, seed):
    """A coast with features of all sizes, and an island that nearly touches it."""
    chance = random.Random(seed)
    waves = [(k, chance.uniform(-1, 1) / k ** 1.1, chance.uniform(0, 2 * math.pi)) for k in range(3, vertices // 4)]
    ring = []
    for i in range(vertices):
        angle = 2 * math.pi * i / vertices
        radius = 100 * (1 + 0.25 * sum(a * math.cos(k * angle + phase) for k, a, phase in waves))
        ring.append((radius * math.cos(angle), radius * math.sin(angle)))
    x, y = max(ring)
    island = [(x + 8 + 7.5 * math.cos(k * math.pi / 8), y + 7.5 * math.sin(k * math.pi / 8)) for k in range(16)]
    return "\n".join("".join(f"{x:.9f} {y:.9f}\n" for x, y in one) for one in (ring, island))


class ShortestEdge(unittest.TestCase):
    def mesh(self, work, *overrides, code=0, ranks=1):
        """The lengths of the edges and those of the boundary edges."""
        done = run(work / "it.ini", *overrides, "--quiet", f"output.directory={work}", "output.overwrite=true",
                   ranks=ranks, threads=1)
        self.messages = done.stdout + done.stderr
        self.assertEqual(done.returncode, code, self.messages)
        if code not in (0, 5):
            return None
        with h5py.File(work / "it.h5") as file:
            points, triangles = file["Mesh/mesh/geometry"][:], file["Mesh/mesh/topology"][:]
            self.hash = file["trime_mpi"].attrs["mesh_hash"]
        edges = numpy.sort(numpy.concatenate([triangles[:, [k, (k + 1) % 3]] for k in range(3)]), axis=1)
        edges, count = numpy.unique(edges, axis=0, return_counts=True)
        lengths = numpy.hypot(*(points[edges[:, 1]] - points[edges[:, 0]]).T)
        return lengths, lengths[count == 1]

    def prepare(self, work, seed, vertices=1200):
        (work / "land.xy").write_text(coast(vertices, seed), "ascii")
        (work / "it.ini").write_text(CONFIG, "ascii")

    def test_no_edge_of_a_coast_is_shorter(self):
        for seed, size in ((1, "uniform"), (2, "automatic"), (3, "automatic")):
            with Workspace() as work:
                self.prepare(work, seed)
                median = numpy.median(self.mesh(work, f"sizing.type={size}")[1])
                for share in (0.5, 1, 1.5):
                    with self.subTest(seed=seed, size=size, share=share):
                        lengths, boundary = self.mesh(work, f"sizing.type={size}",
                                                      f"sizing.shortest_edge={share * median}")
                        self.assertGreaterEqual(lengths.min(), share * median)
                        self.assertLess(numpy.median(boundary), max(2.5 * share, 1.5) * median)
                        self.assertIn("shortest_edge", self.messages)
                        checked = subprocess.run([CHECK, work / "it.h5"], capture_output=True, text=True, check=False)
                        self.assertEqual(checked.returncode, 0, checked.stdout)

    def test_the_mesh_is_the_same_on_any_ranks(self):
        hashes = set()
        with Workspace() as work:
            self.prepare(work, 4)
            for ranks in (1, 2, 3):
                self.mesh(work, "sizing.shortest_edge=3", ranks=ranks)
                hashes.add(self.hash)
        self.assertEqual(len(hashes), 1)

    def test_what_is_longer_already_stays(self):
        with Workspace() as work:
            self.prepare(work, 5)
            lengths, _ = self.mesh(work, "sizing.min_size=1")
            before = self.hash
            self.mesh(work, "sizing.min_size=1", f"sizing.shortest_edge={0.01 * lengths.min()}")
            self.assertEqual(self.hash, before)

    def test_fixed_points_that_are_too_close_are_refused(self):
        with Workspace() as work:
            self.prepare(work, 1)
            (work / "wells.xy").write_text("10 10\n40 0\n10.5 10\n", "ascii")
            self.mesh(work, "meshing.fixed_points=wells.xy", "sizing.shortest_edge=0.6", code=3)
            self.assertIn("(10, 10) and (10.5, 10) are 0.5 apart, but shortest_edge = 0.6", self.messages)

    def test_the_reason_for_a_shorter_edge_is_given(self):
        with Workspace() as work:
            self.prepare(work, 1, vertices=200)
            self.mesh(work, "meshing.keep_features=true", "sizing.shortest_edge=3", code=5)
        self.assertIn("keep_features = true in [meshing] keeps everything that is smaller", self.messages)


if __name__ == "__main__":
    unittest.main()
