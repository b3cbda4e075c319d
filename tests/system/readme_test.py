#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The README says what the program says: its table of keys is the one that the program prints."""
import unittest

from trime_run import ROOT, run


class Readme(unittest.TestCase):
    def test_table_of_keys(self):
        done = run("--help-config")
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = [line for line in done.stdout.splitlines() if line.startswith("|")]
        self.assertGreater(len(rows), 40)
        readme = (ROOT / "README.md").read_text(encoding="utf-8").splitlines()
        missing = [row for row in rows if row not in readme]
        self.assertEqual(missing, [], "put the output of 'trime_mpi --help-config' into the README")


if __name__ == "__main__":
    unittest.main()
