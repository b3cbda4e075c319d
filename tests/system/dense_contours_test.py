#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests contours with many more vertices than the mesh. One rank simplifies them for all ranks, and every number of
ranks gives the same certified mesh.
"""
import re
import unittest

import h5py

from dense_coast import dense_coast, text_of_coast
from trime_run import Workspace, run

VERTICES = 2**15  # StartRules::many_pieces is half of that
CONFIG = ("[shape]\ngeometry = land\n[shape.land]\ntype = contour\nfile = land.xy\nnormalize = true\n"
          "[sizing]\ntype = automatic\n[meshing]\npoints = 3000\n")


def filling(x, y, area):
    """Share of the box around the points: the same at any scale."""
    return area / ((max(x) - min(x)) * (max(y) - min(y)))


def filling_of_ring(ring):
    twice = sum((a.conjugate() * b).imag for a, b in zip(ring, ring[1:] + ring[:1]))
    return filling([p.real for p in ring], [p.imag for p in ring], twice / 2)


def filling_of_mesh(file):
    points, (a, b, c) = file["Mesh/mesh/geometry"][:], file["Mesh/mesh/topology"][:].T
    u, v = points[b] - points[a], points[c] - points[a]
    return filling(*points.T, (u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]).sum() / 2)


class DenseContours(unittest.TestCase):
    def mesh(self, work, ranks):
        done = run(work / "land.ini", f"output.directory={work}", f"output.name=on_{ranks}", "--verbose",
                   ranks=ranks)
        self.assertEqual(done.returncode, 0, f"{ranks} ranks:\n{done.stdout}{done.stderr}")
        thinned = re.search(r"(\d+) pieces of ragged curves thinned", done.stdout)
        self.assertTrue(thinned, done.stdout)
        self.assertGreater(int(thinned[1]), 0.5 * VERTICES)
        return h5py.File(work / f"on_{ranks}.h5", "r")

    def test_one_rank_simplifies_for_all(self):
        for seed, ruggedness in ((1, 0.12), (2, 0.02)):  # the second one is nearly smooth
            with self.subTest(seed=seed), Workspace() as work:
                ring = dense_coast(seed, ruggedness, VERTICES)
                (work / "land.xy").write_text(text_of_coast(ring), "ascii")
                (work / "land.ini").write_text(CONFIG, "ascii")
                hashes = set()
                for ranks in (1, 2, 3, 7):
                    with self.mesh(work, ranks) as file:
                        hashes.add(str(file["trime_mpi"].attrs["mesh_hash"]))
                        self.assertAlmostEqual(filling_of_mesh(file), filling_of_ring(ring), delta=0.005)
                self.assertEqual(len(hashes), 1)


if __name__ == "__main__":
    unittest.main()
