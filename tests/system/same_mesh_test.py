#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""One config, one mesh: every number of ranks and threads gives the same file, but for the group /trime_mpi.

Usage: same_mesh_test.py CONFIG
"""
import pathlib
import subprocess
import sys
import unittest

import h5py

from trime_run import Workspace, run

CONFIG = pathlib.Path(sys.argv.pop()).resolve()
CASES = [(ranks, threads) for ranks in (1, 2, 3, 4, 7) for threads in (1, 2)]
POINTS = 3000


class SameMesh(unittest.TestCase):
    def mesh(self, directory, ranks, threads):
        """Runs one case; returns the file and its hash."""
        name = f"r{ranks}t{threads}"
        done = run(CONFIG, f"meshing.points={POINTS}", f"output.directory={directory}", f"output.name={name}",
                   ranks=ranks, threads=threads)
        self.assertEqual(done.returncode, 0, f"{ranks} x {threads}:\n{done.stdout}{done.stderr}")
        path = directory / (name + ".h5")
        with h5py.File(path, "r") as file:
            about = file["trime_mpi"].attrs
            self.assertEqual((int(about["mpi_ranks"]), int(about["omp_threads"])), (ranks, threads))
            return path, str(about["mesh_hash"])

    def test_all_ranks_and_threads_give_one_mesh(self):
        with Workspace() as directory:
            first, expected = self.mesh(directory, *CASES[0])
            for case in CASES[1:]:
                with self.subTest(ranks=case[0], threads=case[1]):
                    path, found = self.mesh(directory, *case)
                    self.assertEqual(found, expected)
                    difference = subprocess.run(["h5diff", "--exclude-path", "/trime_mpi", first, path],
                                                capture_output=True, text=True, check=False)
                    self.assertEqual(difference.returncode, 0, difference.stdout[:2000] + difference.stderr)

    def test_another_number_of_points_gives_another_mesh(self):
        """Guards the test above: a hash that never changes would pass it."""
        with Workspace() as directory:
            hashes = set()
            for points in (POINTS, POINTS + 500):
                done = run(CONFIG, f"meshing.points={points}", f"output.directory={directory}",
                           f"output.name=n{points}")
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                with h5py.File(directory / f"n{points}.h5", "r") as file:
                    hashes.add(str(file["trime_mpi"].attrs["mesh_hash"]))
            self.assertEqual(len(hashes), 2)


if __name__ == "__main__":
    unittest.main()
