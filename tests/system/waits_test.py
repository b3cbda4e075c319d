#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests that threads which wait for work sleep soon, unless the user says otherwise."""
import pathlib
import re
import subprocess
import unittest

from trime_run import ROOT, Workspace, command, environment


def spin_counts(arguments=("--version",), ranks=1, **variables):
    """Returns how often the waiting loops of GCC's OpenMP turn, in the programs of a run in the order they start."""
    given = {name: value for name, value in environment(2).items() if name != "OMP_WAIT_POLICY"}
    done = subprocess.run(command(arguments, ranks), env=given | variables | {"OMP_DISPLAY_ENV": "verbose"},
                          capture_output=True, text=True, timeout=120, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return [int(count) for count in re.findall(r"GOMP_SPINCOUNT = '(\d+)'", done.stderr)]


class Waits(unittest.TestCase):
    def test_threads_sleep_soon(self):
        default, short = spin_counts()
        self.assertEqual(short, 2000)
        self.assertGreater(default, 2000)

    def test_the_process_keeps_its_name(self):
        with Workspace() as work:
            given = {name: value for name, value in environment(1).items() if name != "OMP_WAIT_POLICY"}
            with subprocess.Popen(command([ROOT / "configs" / "square.ini", "meshing.points=200000",
                                           f"output.directory={work}"], 1), env=given, stdout=subprocess.PIPE,
                                  stderr=subprocess.STDOUT) as process:
                process.stdout.read(1)  # it has started again before it writes
                name = pathlib.Path(f"/proc/{process.pid}/comm").read_text(encoding="utf-8")
                process.communicate(timeout=120)
        self.assertEqual(name, "trime_mpi\n")

    def test_what_the_user_sets_holds(self):
        self.assertEqual(spin_counts(GOMP_SPINCOUNT="123"), [123])
        self.assertEqual(spin_counts(OMP_WAIT_POLICY="passive"), [0])

    def test_a_run_on_ranks(self):
        with Workspace() as work:
            counts = spin_counts([ROOT / "configs" / "square.ini", "meshing.points=300", f"output.directory={work}"], 2)
        self.assertEqual(sorted(counts)[:2], [2000, 2000])


if __name__ == "__main__":
    unittest.main()
