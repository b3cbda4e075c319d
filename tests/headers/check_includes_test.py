#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests scripts/check_includes.py: names whose header is not included are found, others are not."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "check_includes.py"
HEADERS = {
    "include/trime/core/error.hpp": "namespace trime {\nclass Error {};\nclass Hidden;\n}\n",
    "src/core/checks.hpp": '#include "trime/core/error.hpp"\nnamespace trime {\nint check(int a);\n}\n',
    "src/mesh/hidden.hpp": "namespace trime {\nclass Hidden {};\n}\n",
}


def run(source):
    """Exit code and output of the script on a tree with some headers and one source."""
    with tempfile.TemporaryDirectory() as root:
        for name, text in {**HEADERS, "src/mesh/a.cpp": source}.items():
            path = pathlib.Path(root, name)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        done = subprocess.run([sys.executable, SCRIPT, root], capture_output=True, text=True, check=False)
        return done.returncode, done.stdout


class Includes(unittest.TestCase):
    def test_a_header_that_another_one_includes_is_enough(self):
        code, output = run('#include "core/checks.hpp"\nint f() { return check(1); }\nError g();\n')
        self.assertEqual((code, output), (0, "each file includes what it uses\n"))

    def test_a_type_whose_header_is_missing_is_found(self):
        code, output = run("trime::Error f();\n")
        self.assertEqual(code, 1)
        self.assertIn("src/mesh/a.cpp: Error is declared in include/trime/core/error.hpp", output)

    def test_a_function_whose_header_is_missing_is_found(self):
        code, output = run('#include "trime/core/error.hpp"\nint f() { return trime::check(1); }\n')
        self.assertEqual(code, 1)
        self.assertIn("src/mesh/a.cpp: check is declared in src/core/checks.hpp", output)

    def test_an_announced_class_of_another_file_is_not_enough(self):
        code, output = run('#include "trime/core/error.hpp"\nHidden f() { return Hidden(); }\n')
        self.assertEqual(code, 1)
        self.assertIn("src/mesh/a.cpp: Hidden is declared in src/mesh/hidden.hpp", output)

    def test_own_names_members_and_comments_need_no_header(self):
        text = "class Error;\nstruct A { int check(int b); };\n// Hidden\nint f(A a, Error* e) { return a.check(1); }\n"
        code, output = run(text + 'const char* c = "Hidden";\n')
        self.assertEqual((code, output), (0, "each file includes what it uses\n"))


if __name__ == "__main__":
    unittest.main()
