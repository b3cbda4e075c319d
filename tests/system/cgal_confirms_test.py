#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests that CGAL confirms the triangles of the square with 1e4 points, and finds one wrong edge in another mesh."""
import os
import shutil
import subprocess
import unittest

import h5py

from trime_run import ROOT, Workspace, run


def confirm(path):
    """Exit code and text of the comparison with CGAL."""
    done = subprocess.run([os.environ["TRIME_CGAL_CONFIRMS"], path], capture_output=True, text=True, check=False)
    return done.returncode, done.stdout + done.stderr


class CgalConfirms(unittest.TestCase):
    def test_square(self):
        with Workspace() as work:
            done = run(ROOT / "configs" / "square.ini", "meshing.points=10000", f"output.directory={work}",
                       "output.name=m", ranks=2)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            code, text = confirm(work / "m.h5")
            self.assertEqual(code, 0, text)

            shutil.copy(work / "m.h5", work / "wrong.h5")
            with h5py.File(work / "wrong.h5", "r+") as file:
                topology = file["Mesh/mesh/topology"]
                middle = topology.shape[0] // 2
                topology[middle, 0] = (topology[middle, 0] + 7) % 10000
            code, text = confirm(work / "wrong.h5")
            self.assertEqual(code, 1, text)


if __name__ == "__main__":
    unittest.main()
