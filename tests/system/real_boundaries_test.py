#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Meshes and judges some realistic boundaries, those that `real_shapes.py` calls `tuning`.

`judge.py` judges by file and contour alone. The bars are the present values with some leeway; none may be raised.
"""
import unittest

import h5py

import real_shapes
from judge import config_text, run_and_judge
from ring_tools import text_of
from trime_run import Workspace, run

# (kind, seed, vertices, points, sizing): the largest alpha away from sharp corners of the input (`kept`)
BARS = {
    ("contours", 1, 1000, 1000, "uniform"): 1.6,
    ("contours", 2, 4000, 400, "uniform"): 2.5,
    ("islands", 7, 3000, 300, "0.1"): 1.7,
    ("ocean", 4, 3000, 3000, "0.3"): 1.7,
    ("spits", 6, 2000, 2000, "uniform"): 1.7,
    ("near_touch", 10, 2000, 2000, "uniform"): 1.6,
    ("walls", 11, 2000, 2000, "uniform"): 1.5,
    ("comb", 17, 1000, 1000, "uniform"): 1.8,
    ("needles", 20, 1000, 1000, "uniform"): 1.5,
    ("crack", 1, 8, 2000, "uniform"): 1.5,
    ("tip", 1, 9, 2000, "uniform"): 1.5,
}
SAME_ON_RANKS = [("contours", 1, 1000, 1000, "uniform"), ("crack", 1, 8, 2000, "uniform")]
DEVIATION = 0.5  # of the size for which it was simplified: what a generalised curve may be off


class RealBoundaries(unittest.TestCase):
    def test_meshes_are_certified_near_the_curve_and_without_bad_triangles(self):
        tuning = {(kind, seed, vertices) for kind, seed, vertices in real_shapes.TUNING}
        for shape, bar in BARS.items():
            with self.subTest(shape=" ".join(map(str, shape))), Workspace() as work:
                self.assertIn(shape[:3], tuning, "shapes of the other set are for reports only")
                row = run_and_judge(*shape, keep=work)
                self.assertEqual(row["exit"], 0, row.get("message"))
                self.assertEqual(row["failed"], [])
                self.assertLessEqual(row["kept"], bar, f"at {row['at']}")
                self.assertLessEqual(row["deviation"], DEVIATION, f"at {row['deviation_at']}")

    def test_one_mesh_on_any_ranks(self):
        for kind, seed, vertices, points, sizing in SAME_ON_RANKS:
            with self.subTest(kind=kind), Workspace() as work:
                (work / "it.xy").write_text(text_of(real_shapes.shape(kind, seed, vertices)), encoding="ascii")
                (work / "it.ini").write_text(config_text(points, sizing), encoding="ascii")
                hashes = set()
                for ranks in (1, 2, 3, 7):
                    done = run(work / "it.ini", f"output.directory={work}", "output.overwrite=true", "--quiet",
                               ranks=ranks, threads=1)
                    self.assertEqual(done.returncode, 0, done.stderr)
                    with h5py.File(work / "it.h5", "r") as file:
                        hashes.add(str(file["trime_mpi"].attrs["mesh_hash"]))
                self.assertEqual(len(hashes), 1)


if __name__ == "__main__":
    unittest.main()
