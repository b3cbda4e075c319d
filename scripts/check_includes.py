#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that each file of include and src includes what it uses of the project. It needs Universal Ctags.

Usage: check_includes.py [ROOT]     ROOT: the top of the tree (default: the one that this script lies in)
A build in groups (TRIME_UNITY) compiles a source after its neighbours and so does not notice a header that the source
lacks. This check needs seconds, where a compiler needs minutes. It knows a name only by its word: a type, or a
function that is called, must be declared in the file or in what the file includes, at any depth. A name that several
headers declare may come from each of them. Prints each name that is missing as file: name, and exits with 1 if it
finds any.
"""
import collections
import json
import pathlib
import re
import subprocess
import sys

INCLUDE = re.compile(r'^#include (?:"([^"]+)"|<(trime/[^>]+)>)', re.M)
IGNORED = re.compile(r'//[^\n]*|"(?:[^"\\\n]|\\.)*"|^#include.*$', re.M)
TYPE = re.compile(r"(?<!benchmark::)\b([A-Z]\w+)\b")
CALL = re.compile(r"(?<![.>\w:])(?!std::|fmt::)(?:[a-z]\w*::)*([a-z_]\w+)(?:<[\w:, ]*>)?\(")
FORWARD = re.compile(r"^\s*(?:class|struct|friend \w+|enum class) (\w+)[;:]", re.M)
PARAMETER = re.compile(r"[<,]\s*(?:class|typename)(?:\.\.\.)? (\w+)")


class Tree:
    """The sources and headers of a tree, what they include and what they declare."""

    def __init__(self, root):
        self.root = root
        files = [path for top in ("include", "src") for path in sorted((root / top).rglob("*.[ch]pp"))]
        self.texts, self.includes = {}, {}
        for path in files:
            text = path.read_text(encoding="utf-8")
            self.includes[path] = [self._found(path, a or b) for a, b in INCLUDE.findall(text)]
            self.texts[path] = IGNORED.sub("", text)
        self.declared = {path: set() for path in files}
        self.own = {path: set(FORWARD.findall(text) + PARAMETER.findall(text)) for path, text in self.texts.items()}
        self.homes = collections.defaultdict(set)  # the headers that declare a name in a namespace
        self._read_tags()

    def _found(self, path, name):
        tops = (path.parent, self.root / "src", self.root / "include")
        return next(((top / name).resolve() for top in tops if (top / name).exists()), None)

    def _read_tags(self):
        done = subprocess.run(["ctags", "-R", "--languages=C++", "--kinds-C++=+plz", "--fields=+s",
                               "--output-format=json", "-f", "-", "include", "src"],
                              cwd=self.root, capture_output=True, text=True, check=True)
        for line in done.stdout.splitlines():
            tag = json.loads(line)
            path = (self.root / tag["path"]).resolve()
            if path not in self.declared:
                continue
            self.declared[path].add(tag["name"])
            if path.suffix == ".hpp" and tag.get("scopeKind") in (None, "namespace"):
                self.homes[tag["name"]].add(path)

    def visible(self, path):
        """All that the file and what it includes, at any depth, define, and what the file itself announces."""
        seen, todo = {path}, [path]
        while todo:
            for other in self.includes.get(todo.pop(), ()):
                if other and other not in seen:
                    seen.add(other)
                    todo.append(other)
        return self.own[path].union(*(self.declared.get(other, set()) for other in seen))


def complaints(root):
    """A line for each name that a file uses and that nothing which it includes declares."""
    tree = Tree(root.resolve())
    for path, text in tree.texts.items():
        used = set(TYPE.findall(text)) | set(CALL.findall(text))
        for name in sorted((used & tree.homes.keys()) - tree.visible(path)):
            homes = ", ".join(sorted(str(home.relative_to(tree.root)) for home in tree.homes[name]))
            yield f"{path.relative_to(tree.root)}: {name} is declared in {homes}, which the file does not include"


def main():
    """Prints the complaints."""
    root = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parent.parent
    found = list(complaints(root))
    print("\n".join(found) or "each file includes what it uses")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
