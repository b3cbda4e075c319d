#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""A run that the sweep cap stops: exit code 5, a warning, a mark in the file; its certificate still holds."""
import unittest

import h5py

from trime_run import ROOT, Workspace, run


class Incomplete(unittest.TestCase):
    def test_sweep_cap(self):
        with Workspace() as directory:
            done = run(ROOT / "configs" / "spade.ini", "meshing.max_sweeps=2", "meshing.points=1000",
                       f"output.directory={directory}")
            self.assertEqual(done.returncode, 5, done.stdout + done.stderr)
            self.assertRegex(done.stdout + done.stderr, r"NOT complete \(the sweep cap.*marked so in the file")
            with h5py.File(directory / "spade.h5", "r") as file:
                self.assertEqual(file["trime_mpi"].attrs["complete"], 0)
                self.assertEqual(file["trime_mpi"].attrs["stop_reason"], b"sweep cap")
                self.assertTrue(file["trime_mpi/checks/passed"][:].all())


if __name__ == "__main__":
    unittest.main()
