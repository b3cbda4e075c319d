#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests that one config gives one mesh: every number of ranks and threads writes the same file, except the group
/trime_mpi.

Usage: same_mesh_test.py CONFIG [section.key=value ...]
"""
import pathlib
import subprocess
import sys
import unittest

import h5py

from trime_run import Workspace, run

CONFIG = pathlib.Path(sys.argv[1]).resolve()
OVERRIDES = sys.argv[2:]
del sys.argv[1:]
# (ranks, threads): each number of both, alone and together; a config in another method gets the mixed ones.
CASES = [(1, 1), (2, 2), (4, 1)] if OVERRIDES else [(1, 1), (1, 2), (2, 2), (3, 1), (4, 2)]
POINTS = 1500


class SameMesh(unittest.TestCase):
    def run_config(self, directory, name, *arguments, ranks=1, threads=1):
        """Runs one case; returns its file."""
        done = run(CONFIG, f"meshing.points={POINTS}", *OVERRIDES, f"output.directory={directory}",
                   f"output.name={name}", *arguments, ranks=ranks, threads=threads)
        self.assertEqual(done.returncode, 0, f"{ranks} x {threads}:\n{done.stdout}{done.stderr}")
        return directory / (name + ".h5")

    def hash_of(self, path, **expected):
        """The hash of the mesh; attributes that are named must be as expected."""
        with h5py.File(path, "r") as file:
            about = file["trime_mpi"].attrs
            for name, value in expected.items():
                self.assertEqual(int(about[name]), value, name)
            return str(about["mesh_hash"])

    def assert_same(self, first, path):
        """Equal hashes, and equal bytes of all arrays."""
        self.assertEqual(self.hash_of(path), self.hash_of(first))
        difference = subprocess.run(["h5diff", "--exclude-path", "/trime_mpi", first, path], capture_output=True,
                                    text=True, check=False)
        self.assertEqual(difference.returncode, 0, difference.stdout[:2000] + difference.stderr)

    def test_all_ranks_and_threads_give_one_mesh(self):
        with Workspace() as directory:
            files = {}
            for ranks, threads in CASES:
                with self.subTest(ranks=ranks, threads=threads):
                    path = self.run_config(directory, f"r{ranks}t{threads}", "--threads", threads, ranks=ranks,
                                           threads=threads)
                    files[ranks, threads] = path
                    self.hash_of(path, mpi_ranks=ranks, omp_threads=threads, setup_threads=threads)
                    self.assert_same(files[CASES[0]], path)
            self.assertEqual(list(files), CASES)
            # As the config itself wants it; and a guard of the test: a hash that never changes would pass it.
            self.assert_same(files[CASES[0]], self.run_config(directory, "as_it_stands"))
            other = self.run_config(directory, "other", f"meshing.points={POINTS + 300}")
            self.assertNotEqual(self.hash_of(other), self.hash_of(files[CASES[0]]))


if __name__ == "__main__":
    unittest.main()
