#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests that every relative link of every *.md file leads to a file, and to a heading if it names one. README.md must
be short.
"""
import pathlib
import re
import subprocess
import tempfile
import unittest
import urllib.parse

ROOT = pathlib.Path(__file__).resolve().parents[2]
README_BYTES = 10240
INLINE = re.compile(r"!?\[(?:[^\[\]]|\[[^\]]*\])*\]\(\s*<?([^)\s>]+)>?(?:\s+\"[^\"]*\")?\s*\)")
REFERENCE = re.compile(r"^ {0,3}\[[^\]]+\]:\s*<?([^\s>]+)>?", re.MULTILINE)
FOREIGN = re.compile(r"[a-z][a-z0-9+.-]*:", re.IGNORECASE)  # a scheme


def prose(text):
    """The text without code, which holds no links and no headings."""
    text = re.sub(r"^( *)(```+|~~~+).*?^ *\2[`~]* *$", "", text, flags=re.MULTILINE | re.DOTALL)
    return text


def links(text):
    """Targets of all links but those to other sites."""
    text = re.sub(r"(`+)(?!`).+?(?<!`)\1(?!`)", "", prose(text))
    return [target for pattern in (INLINE, REFERENCE) for target in pattern.findall(text) if not FOREIGN.match(target)]


def anchors(text):
    """The names of all headings, as GitHub makes them, and of explicit anchors."""
    found, seen = set(re.findall(r"<a\s+(?:id|name)=\"([^\"]+)\"", text)), {}
    for heading in re.findall(r"^ {0,3}#{1,6}\s+(.*?)\s*#*\s*$", prose(text), re.MULTILINE):
        heading = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", heading)
        name = re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")
        found.add(f"{name}-{seen[name]}" if name in seen else name)
        seen[name] = seen.get(name, 0) + 1
    return found


def documents(root):
    """All *.md files that belong to the project: those that git knows or would add; without git, all."""
    done = subprocess.run(["git", "-C", root, "ls-files", "-coz", "--exclude-standard", "*.md"], capture_output=True,
                          text=True, check=False)
    if done.returncode == 0:
        return sorted(root / name for name in done.stdout.split("\0") if name and (root / name).exists())
    return sorted(path for path in root.rglob("*.md") if "build" not in path.relative_to(root).parts)


def broken(root):
    """One line for each link that leads nowhere."""
    told = []
    for path in documents(root):
        for target in links(path.read_text(encoding="utf-8")):
            name, _, anchor = urllib.parse.unquote(target).partition("#")
            file = path if not name else root / name.lstrip("/") if name.startswith("/") else path.parent / name
            where = f"{path.relative_to(root)}: {target}"
            if not file.exists():
                told.append(f"{where}: there is no such file")
            elif anchor and file.suffix == ".md" and anchor not in anchors(file.read_text(encoding="utf-8")):
                told.append(f"{where}: there is no such heading")
    return told


class Links(unittest.TestCase):
    def test_every_link_leads_somewhere(self):
        self.assertIn(ROOT / "README.md", documents(ROOT))
        self.assertEqual(broken(ROOT), [])

    def test_readme_is_short(self):
        size = (ROOT / "README.md").stat().st_size
        self.assertLessEqual(size, README_BYTES, "README.md is for the first minutes; details belong beside the code")

    def test_broken_links_are_found(self):
        """A guard of the first test."""
        with tempfile.TemporaryDirectory() as directory:
            root = pathlib.Path(directory)
            (root / "a.md").write_text(
                "# One *two*, `three`\n# One two three\n[x](b.md) [x](b.md#here) [x](#one-two-three)\n![p](p.png) "
                "[x](b.md#there) [x](#one-two-three-1) [x](https://c.d/e) `[x](f.md)`\n```\n# no heading\n"
                "[x](g.md)\n```\n[x](#no-heading)\n[y]: h.md\n", encoding="utf-8")
            (root / "b.md").write_text("## Here\n", encoding="utf-8")
            self.assertEqual(broken(root), [f"a.md: {target}" for target in (
                "p.png: there is no such file", "b.md#there: there is no such heading",
                "#no-heading: there is no such heading", "h.md: there is no such file")])


if __name__ == "__main__":
    unittest.main()
