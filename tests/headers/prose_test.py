#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Can a stranger read our prose once? prose.py says what a plain sentence is; this test looks at the files of CHECKED.

Run by hand, this prints the faults of the files that are named: prose_test.py FILE...
"""
import functools
import pathlib
import re
import subprocess
import sys
import unittest

import prose
import sample_sentences

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
PAGES = sorted([*ROOT.glob("*.md"), *ROOT.glob("*/*.md"), *ROOT.glob("*/*/*.md")])
HEADERS = sorted((ROOT / "include" / "trime").rglob("*.hpp"))
# Files whose words and sentences must be plain.
CHECKED = (
    "*.md", "configs/*.md", "jobs/*.md", "scripts/README.md", "scripts/packaging/*.md",
    "src/*.md", "tests/*.md",
    "scripts/**/*.py", "tests/**/*.py",
    "include/trime/**/*.hpp", "src/*/*.hpp", "src/*/*.cpp",
)
# Tables made from C++ by a script or by --help-config: their words are corrected there, not on the page.
MADE_TABLES = ("src/rules.md",)


def checked_files():
    return sorted({path for pattern in CHECKED for path in ROOT.glob(pattern)})


def faults_of(path):
    """Lines `file:line: fault`."""
    where = path.relative_to(ROOT) if path.is_relative_to(ROOT) else path
    passages = prose.passages(path.name, path.read_text(encoding="utf-8"))
    fault_lists = (prose.faults, prose.header_faults) if path.suffix == ".hpp" else (prose.faults,)
    return [f"{where}:{passage.line}: {fault}" for passage in passages
            if passage.kind != "cell" or str(where) not in MADE_TABLES
            for faults in fault_lists for fault in faults(passage)]


def long_sentences(path):
    """Lines `file:line: words: sentence`."""
    return [f"{path.relative_to(ROOT)}:{passage.line}: {prose.count_words(sentence)} words: {sentence}"
            for passage in prose.passages(path.name, path.read_text(encoding="utf-8"))
            if passage.kind not in ("cell", "message") for sentence in prose.sentences(passage.text)
            if prose.count_words(sentence) > prose.MOST_WORDS]


@functools.cache
def file_names():
    """The names, without folders, of all files of the project."""
    folders = ("configs", "include", "jobs", "scripts", "src", "tests")
    examples = {"config.ini", "disc.ini", "diffusion.cpp"}
    return {path.name for folder in folders for path in (ROOT / folder).rglob("*.*")} | examples


def missing_files(page):
    """Files that a page names in `code` and that are not there; module/file.hpp lies in src or include/trime."""
    text = re.sub(r"```.*?```", "", page.read_text(encoding="utf-8"), flags=re.DOTALL)
    missing = []
    for name in re.findall(r"`((?:[\w.]+/)+[\w.]+\.(?:hpp|cpp|py|sh|ini|sbatch|xy))`", text):
        places = [ROOT / name, page.parent / name, ROOT / "src" / name, ROOT / "include" / name,
                  ROOT / "include" / "trime" / name]
        if not any(place.exists() for place in places):
            missing.append(f"{page.relative_to(ROOT)}: {name}")
    for name in re.findall(r"`(\w+\.(?:hpp|cpp|py|sh|ini|sbatch))`", text):
        if name not in file_names():
            missing.append(f"{page.relative_to(ROOT)}: {name}")
    return missing


def modules():
    """The modules that scripts/check_layers.py knows."""
    sys.path.insert(0, str(ROOT / "scripts"))
    import check_layers
    return sorted(check_layers.ARROWS)


class Reader(unittest.TestCase):
    """The reader of prose itself."""

    def test_counts_words_and_ends_sentences(self):
        self.assertEqual(prose.count_words("A `b c d` [link here](far/away.md), 3 - 4 cm."), 5)
        self.assertEqual(prose.sentences("One is, e.g. Two. Three (see 4.5). `Five` is six. seven"),
                         ["One is, e.g. Two.", "Three (see 4.5).", "`Five` is six. seven"])

    def test_finds_the_passages_of_a_page(self):
        page = "# Title\nOne\ntwo.\n\n| a | 1 |\n```sh\ncode\n```\n* item\n* item two\n  and more\n## Sources\n* book\n"
        self.assertEqual(prose.passages("a.md", page),
                         [(2, "paragraph", "One two."), (5, "cell", "a"), (9, "item", "item"),
                          (10, "item", "item two and more")])

    def test_finds_the_passages_of_a_header(self):
        header = ("// SPDX-License-Identifier: X\n/// @brief One\n/// two.\n/// @param x three\nint x; ///< four\n"
                  "                          ///< more\n  /// five\n"
                  'throw Error("cannot read "\n            "the file: " + name + " is \\"no\\" file");\n')
        self.assertEqual(prose.passages("a.hpp", header),
                         [(2, "comment", "One two."), (4, "comment", "x three"), (5, "comment", "four more"),
                          (7, "comment", "five"), (8, "message", "cannot read the file: ")])

    def test_finds_the_passages_of_python(self):
        code = ('"""One\ntwo.\n\nUsage: a.py\n  --b   code\n* three\n"""\nclass A:\n    """Four\n    five."""\n'
                '    def b(self):\n        """Six."""\n        return "no docstring"\n')
        self.assertEqual(prose.passages("a.py", code),
                         [(1, "comment", "One two."), (6, "comment", "three"), (9, "comment", "Four five."),
                          (12, "comment", "Six.")])

    def test_knows_verbs(self):
        for sentence, count in (("The same.", 0), ("Of a sum.", 0), ("It is sorted.", 1), ("What is near.", 1),
                                ("What a rank owns is sorted.", 2),
                                ("Those that are new are marked.", 2), ("It has not always been kept.", 1),
                                ("Which rings are holes follows.", 2), ("Carries bars and stopped.", 2)):
            self.assertEqual(prose.count_verbs(sentence), count, sentence)

    def test_finds_faults(self):
        for kind, text, fault in (
                ("paragraph", "Both are told.", "'told'"), ("cell", "Words beside it", "'beside'"),
                ("message", "it is none: `told`", "'is none'"),
                ("paragraph", "The mesh is good. At most 5.", "no verb"),
                ("item", "`a`: the same everywhere. Never more.", "no verb"), ("comment", "Of a sum.", "no verb"),
                ("comment", "Whether it is sorted.", "no verb"), ("comment", "The same, for ranks.", "no verb"),
                ("item", "It is " + "very " * 40 + "long.", "43 words")):
            found = prose.faults(prose.Passage(1, kind, text))
            self.assertEqual(len(found), 1, f"{text}: {found}")
            self.assertTrue(found[0].startswith(fault), found)
        for kind, text in (("item", "the same everywhere"), ("comment", "The number of points."),
                           ("comment", "What a rank owns is sorted."), ("paragraph", "See `told by all`."),
                           ("cell", "The same"), ("message", "of one rank")):
            self.assertEqual(prose.faults(prose.Passage(1, kind, text)), [], text)

    def test_finds_faults_of_headers(self):
        for text, fault in (("of this rank", "begins with 'of'"), ("The same, by part.", "begins with 'The same'"),
                            ("those of the rank", "begins with 'those'"), ("Is p inside? Exact.", "asks: Is p inside?"),
                            ("False if there is none.", "begins with 'False if'")):
            found = prose.header_faults(prose.Passage(1, "comment", text))
            self.assertEqual(len(found), 1, f"{text}: {found}")
            self.assertTrue(found[0].startswith(fault), found)
        for kind, text in (("comment", "points of this rank"), ("comment", "Returns whether p lies inside."),
                           ("message", "of what? Of it")):
            self.assertEqual(prose.header_faults(prose.Passage(1, kind, text)), [], text)


class Sample(unittest.TestCase):
    """sample_sentences.py"""

    @unittest.skipIf(
        subprocess.run(["git", "-C", ROOT, "rev-parse", "HEAD"], capture_output=True, check=False).returncode,
        "no repository")
    def test_a_seed_draws_the_same_sentences(self):
        drawn = [subprocess.run([sys.executable, HERE / "sample_sentences.py", "--seed", seed, "--count", "7"],
                                capture_output=True, text=True, check=True).stdout for seed in "112"]
        self.assertEqual(drawn[0], drawn[1])
        self.assertNotEqual(drawn[0], drawn[2])
        self.assertEqual([line.split(" of ")[0] for line in drawn[0].splitlines() if line.startswith("# ")],
                         ["# page: 3", "# message: 2", "# header: 2"])

    def test_tags_become_words(self):
        header = "/// @param a, b Two.\n  /// @throws Error\n/// @brief @pre x\n"
        self.assertEqual(sample_sentences.with_spoken_tags(header),
                         "/// @note parameter a, b: Two.\n  /// @note throws Error\n/// @brief @pre x\n")


class Prose(unittest.TestCase):
    def test_checked_files_are_plain(self):
        for pattern in CHECKED:
            self.assertTrue(list(ROOT.glob(pattern)), f"{pattern}: there is no such file")
        self.assertEqual([fault for path in checked_files() for fault in faults_of(path)], [])

    def test_no_sentence_of_a_page_is_long(self):
        self.assertGreater(len(PAGES), 4)
        self.assertEqual([line for page in PAGES for line in long_sentences(page)], [])

    def test_no_sentence_of_a_public_header_is_long(self):
        self.assertGreater(len(HEADERS), 20)
        self.assertEqual([line for header in HEADERS for line in long_sentences(header)], [])

    def test_every_module_has_its_line(self):
        text = (ROOT / "src" / "README.md").read_text(encoding="utf-8")
        picture = re.search(r"## The layers.*?```(.*?)```", text, re.DOTALL).group(1)
        rows = [line for line in text.splitlines() if line.startswith("| `")]
        self.assertEqual([module for module in modules() if not any(row.startswith(f"| `{module}` |") for row in rows)],
                         [], "modules without a row in the table of duties in src/README.md")
        self.assertEqual([module for module in modules() if not re.search(rf"\b{module}\b", picture)], [],
                         "modules that are not in the picture of src/README.md")

    def test_files_that_pages_name_are_there(self):
        self.assertEqual([line for page in PAGES for line in missing_files(page)], [])


if __name__ == "__main__":
    named = [pathlib.Path(name).resolve() for name in sys.argv[1:] if not name.startswith("-")]
    if named:
        found = [line for path in named for line in faults_of(path)]
        print("\n".join(found))
        sys.exit(1 if found else 0)
    unittest.main()
