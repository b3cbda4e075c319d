#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests scripts/check_functions.py: long functions and long lists of parameters are found, others are not."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "check_functions.py"


def run(text):
    """Exit code and output of the script on a tree with one source."""
    with tempfile.TemporaryDirectory() as root:
        for folder in ("include", "src"):
            pathlib.Path(root, folder).mkdir()
        pathlib.Path(root, "src", "a.cpp").write_text(text, encoding="utf-8")
        done = subprocess.run([sys.executable, SCRIPT, root], capture_output=True, text=True, check=False)
        return done.returncode, done.stdout


def function(lines):
    """A function with this number of lines."""
    return "int f(int a) {\n" + "  a += 1;\n" * (lines - 3) + "  return a;\n}\n"


class Functions(unittest.TestCase):
    def test_a_function_has_40_lines_at_most(self):
        self.assertEqual(run(function(40)), (0, ""))
        code, output = run(function(41))
        self.assertEqual(code, 1)
        self.assertIn("src/a.cpp:1: f has 41 lines", output)

    def test_a_function_takes_5_parameters_at_most(self):
        five = "void f(int a, std::map<int, int> b, int (*c)(int, int), int d, int e = g(1, 2)) {}\n"
        self.assertEqual(run(five), (0, ""))
        code, output = run("void f(int a, int b, int c, int d, int e, int h) {}\n")
        self.assertEqual(code, 1)
        self.assertIn("src/a.cpp:1: f takes 6 parameters", output)


if __name__ == "__main__":
    unittest.main()
