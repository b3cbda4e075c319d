#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests the scripts for users: the picture of a mesh, and the first command where it may not install packages."""
import os
import subprocess
import unittest

from trime_run import ROOT, Workspace, environment, run

SCRIPTS = ROOT / "scripts"


def call(*command, **changes):
    """Runs a script; returns the finished process."""
    return subprocess.run([str(part) for part in command], env=environment(1) | changes, capture_output=True, text=True,
                          check=False, timeout=120)


class Scripts(unittest.TestCase):
    def test_picture_of_a_mesh(self):
        with Workspace() as work:
            done = run(ROOT / "configs" / "circle.ini", "meshing.points=1000", f"output.directory={work}",
                       "output.name=m")
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            done = call(SCRIPTS / "plot_mesh.py", work / "m.h5", MPLCONFIGDIR=str(work))
            self.assertEqual(done.returncode, 0, done.stderr)
            picture = (work / "m.png").read_bytes()
            self.assertTrue(picture.startswith(b"\x89PNG"))
            self.assertGreater(len(picture), 20_000)
            done = call(SCRIPTS / "plot_mesh.py", work / "m.h5", "--size", "--small", "-o", work / "s.png",
                        MPLCONFIGDIR=str(work))
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual((work / "s.png").read_bytes()[25], 3, "a PNG with a palette")

    def test_picture_of_something_else(self):
        with Workspace() as work:
            (work / "m.h5").write_text("no mesh", encoding="utf-8")
            done = call(SCRIPTS / "plot_mesh.py", work / "m.h5", MPLCONFIGDIR=str(work))
            self.assertEqual(done.returncode, 1)
            self.assertIn("not a mesh file", done.stderr)
            self.assertNotIn("Traceback", done.stderr)

    def test_picture_of_nothing(self):
        with Workspace() as work:
            done = call(SCRIPTS / "plot_mesh.py", work / "m.h5", MPLCONFIGDIR=str(work))
            self.assertEqual(done.returncode, 1)
            self.assertIn(f"there is no {work / 'm.h5'}", done.stderr)

    def test_the_page_of_the_configs_holds_the_table_of_keys(self):
        table = run("--help-config").stdout.strip()
        self.assertGreater(len(table.splitlines()), 30)
        page = (ROOT / "configs" / "keys.md").read_text(encoding="utf-8")
        self.assertEqual([row for row in table.splitlines() if row not in page.splitlines()], [],
                         "put the output of trime_mpi --help-config into configs/keys.md")
        self.assertIn(table, page, "the rows of configs/keys.md stand in another order")

    def test_unlike_hashes_of_builds_are_told(self):
        with Workspace() as work:
            programs = []
            for name, value in (("one", "aa"), ("two", "aa"), ("three", "bb")):
                fake = work / name
                report = f'{{"attributes": {{"mesh_hash_hex": "{value}"}}}}'
                fake.write_text(f"#!/bin/sh\nfor last; do :; done\necho '{report}' > \"$last\"\n", encoding="utf-8")
                fake.chmod(0o755)
                programs += ["--program", f"{name}={fake}"]
            done = call(SCRIPTS / "same_bits.py", "--cases", "torus,formula size", *programs[:4])
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(done.stdout.count("| same |"), 2, done.stdout)
            done = call(SCRIPTS / "same_bits.py", "--cases", "torus", *programs)
            self.assertEqual(done.returncode, 1, done.stderr)
            self.assertIn("| three | bb | DIFFERENT |", done.stdout)
            done = call(SCRIPTS / "same_bits.py", "--cases", "torus", *programs[:2], "--program", "gone=/no/program")
            self.assertEqual(done.returncode, 4)
            self.assertIn("gone", done.stderr)
            self.assertEqual(call(SCRIPTS / "same_bits.py", "--builds", "nonsense").returncode, 2)

    def test_first_commands_say_what_they_would_install(self):
        with Workspace() as work:
            fake = work / "dpkg-query"
            fake.write_text("#!/bin/sh\nexit 1\n", encoding="utf-8")  # nothing is installed here
            fake.chmod(0o755)
            path = f"{work}:{os.environ['PATH']}"
            for script, package in (("run.sh", "libhdf5-openmpi-dev"), ("test.sh", "libgtest-dev")):
                with self.subTest(script=script):
                    done = call(SCRIPTS / script, PATH=path, TRIME_NO_INSTALL="1")
                    self.assertNotEqual(done.returncode, 0)
                    self.assertRegex(done.stderr, rf"apt-get install .*\b{package}\b")
                    self.assertEqual(done.stdout, "")

    def test_first_command_refuses_a_senseless_number_of_ranks(self):
        for ranks in ("zz", "0", "-1", "2.5"):
            with self.subTest(ranks=ranks):
                done = call(SCRIPTS / "run.sh", TRIME_RANKS=ranks, TRIME_NO_INSTALL="1")
                self.assertEqual(done.returncode, 2)
                self.assertIn(f"TRIME_RANKS={ranks}", done.stderr)


if __name__ == "__main__":
    unittest.main()
