#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests scripts/cmake/unity_groups.py: sources that use each other's file-local names are not compiled as one."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "cmake" / "unity_groups.py"


def groups(sources, most=12):
    """Sets of the names of sources, given as {name: text}, as the script groups them."""
    with tempfile.TemporaryDirectory() as root:
        paths = []
        for name, text in sources.items():
            path = pathlib.Path(root, name)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
            paths.append(str(path))
        done = subprocess.run([sys.executable, SCRIPT, str(most), *paths], capture_output=True, text=True, check=True)
        found = {}
        for line in done.stdout.splitlines():
            group, path = line.split("\t")
            found.setdefault(group, set()).add(str(pathlib.Path(path).relative_to(root)))
        return list(found.values())


def local(text):
    """A source that keeps these declarations to itself."""
    return f"namespace trime {{\nnamespace {{\n\n{text}\n\n}} // namespace\n}} // namespace trime\n"


class Groups(unittest.TestCase):
    def test_sources_without_common_names_are_one(self):
        found = groups({"a.cpp": local("int f() {\n  return 1;\n}"), "b.cpp": "int g();\n"})
        self.assertEqual(found, [{"a.cpp", "b.cpp"}])

    def test_a_local_name_that_another_source_uses_separates_them(self):
        other = "int user() {\n  return name;\n}\n"
        for declaration in ("int name(int a) {\n  return a;\n}", "struct name {\n};", "constexpr int name = 1;",
                            "constexpr int other = 2, name = 1;", "using name = int;",
                            "const std::array<int, 2> name{1, 2};",
                            "template <class T>\nstd::vector<T> name(\n    T a) {\n}"):
            with self.subTest(declaration):
                self.assertEqual(len(groups({"a.cpp": local(declaration), "b.cpp": other})), 2)

    def test_comments_and_texts_do_not_separate(self):
        self.assertEqual(len(groups({"a.cpp": local("int name() {\n  return 1;\n}"),
                                     "b.cpp": "// name\nconst char* text = \"name\";\n"})), 1)

    def test_a_group_has_no_more_than_asked(self):
        found = groups({f"{k}.cpp": f"int f{k}();\n" for k in range(5)}, 2)
        self.assertEqual(sum(map(len, found)), 5)
        self.assertLessEqual(max(map(len, found)), 2)


if __name__ == "__main__":
    unittest.main()
