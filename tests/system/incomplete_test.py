#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests a run that stops at its largest number of sweeps: exit code 5, a warning, and a mark in the file. The
certificate still holds.
"""
import unittest

import h5py

from trime_run import ROOT, Workspace, run


class Incomplete(unittest.TestCase):
    def test_sweep_cap(self):
        with Workspace() as directory:
            done = run(ROOT / "configs" / "spade.ini", "meshing.max_sweeps=2", "meshing.points=1000",
                       f"output.directory={directory}")
            self.assertEqual(done.returncode, 5, done.stdout + done.stderr)
            self.assertRegex(done.stdout + done.stderr, r"NOT complete \(the sweep cap.*marked as incomplete")
            with h5py.File(directory / "spade.h5", "r") as file:
                self.assertEqual(file["trime_mpi"].attrs["complete"], 0)
                self.assertEqual(file["trime_mpi"].attrs["stop_reason"], b"sweep cap")
                self.assertTrue(file["trime_mpi/checks/passed"][:].all())

    def test_bad_triangles_away_from_sharp_corners(self):
        """A wall far thinner than the triangles, all of whose angles are right."""
        with Workspace() as directory:
            square = "0.1 0.1\n0.9 0.1\n0.9 0.9\n0.1 0.9\n"
            (directory / "c.xy").write_text(square + "\n0.3 0.1001\n0.7 0.1001\n0.7 0.5\n0.3 0.5\n", "ascii")
            (directory / "c.ini").write_text("[shape]\ngeometry = c\n[shape.c]\ntype = contour\nfile = c.xy\n"
                                             "[meshing]\npoints = 2000\ncleanup = false\n", "ascii")
            done = run(directory / "c.ini", "meshing.worst_alpha=1.0001", f"output.directory={directory}", "--verbose")
            self.assertIn(done.returncode, (0, 5), done.stdout + done.stderr)
            with h5py.File(directory / "c.h5", "r") as file:
                checks = file["trime_mpi/checks"]
                found = dict(zip(checks["name"][:], zip(checks["found"][:], checks["passed"][:])))[b"worst_alpha"]
                worst = file["trime_mpi/worst_triangles"]
                count = file["trime_mpi/quality"].attrs["bad_triangles"]
                obtuse = file["trime_mpi/quality"].attrs["obtuse_triangles"]
                self.assertEqual(min(count, 10), sum(worst["alpha"][:] > 2))
                self.assertLessEqual(min(max(count, obtuse), 10), len(worst["alpha"]))
                self.assertLessEqual(len(worst["alpha"]), min(count + obtuse, 10))
                self.assertTrue(((worst["alpha"][:] > 2) | (worst["obtuse"][:] == 1)).all())
                self.assertEqual(list(worst["obtuse"][:] == 1), list(worst["largest_degrees"][:] > 90))
                self.assertEqual(list(worst["alpha"][:]), sorted(worst["alpha"][:], reverse=True))
                away = [a for a, degrees in zip(worst["alpha"][:], worst["corner_degrees"][:])
                        if degrees == 0 and a > 2]
                self.assertEqual(found[0], away[0] if away else 1)
                self.assertEqual(file["trime_mpi"].attrs["complete"], 1 - bool(away))
            if away:
                self.assertEqual(done.returncode, 5)
                self.assertRegex(done.stdout + done.stderr, r"failed checks: worst_alpha")
                self.assertRegex(done.stdout, rf"Triangles with alpha above 2: {count}; obtuse triangles: {obtuse},")


if __name__ == "__main__":
    unittest.main()
