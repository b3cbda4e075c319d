#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Can a stranger read our prose once? No sentence of the pages or of the public headers has more than 30 words.

Pages are README.md and the pages of each folder, without tables, code blocks and lists of sources. Run by hand,
this prints the long sentences of the files that are named: prose_test.py FILE...
"""
import functools
import pathlib
import re
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGES = sorted([ROOT / "README.md", *ROOT.glob("*/*.md")])
HEADERS = sorted((ROOT / "include" / "trime").rglob("*.hpp"))
MOST_WORDS = 30

SENTENCE_END = re.compile(r"(?<=[.!?])[\"')\]*]*\s+(?=[\"'(\[*`]*[A-Z0-9`])")
ABBREVIATION = re.compile(r"\b(e\.g|i\.e|et al|cf|vs|[A-Z])\.$")
NEW_PARAGRAPH = re.compile(r"^(@(param|throws|return|pre|note|brief|post)\b|[-*] |\d+\. )")
UNREAD_SECTIONS = ("Sources", "Changes")


def sentences(paragraph):
    """The sentences of one paragraph."""
    parts, rest = [], ""
    for part in SENTENCE_END.split(" ".join(paragraph.split())):
        rest = f"{rest} {part}".strip()
        if not ABBREVIATION.search(rest):
            parts.append(rest)
            rest = ""
    return parts + ([rest] if rest else [])


def count_words(sentence):
    """Words of a sentence. A piece of code is one word, a bare number or sign none, the target of a link none."""
    plain = re.sub(r"`[^`]*`", "code", sentence)
    plain = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", plain)
    return sum(1 for word in plain.split() if re.search(r"[A-Za-z]", word))


def paragraphs_of_page(text):
    """Yields (line, paragraph) of a Markdown page: no tables, no code, no section of sources."""
    collected, first, in_code, unread = [], 0, False, False
    for number, line in enumerate(text.splitlines() + [""], 1):
        stripped = line.strip()
        if stripped.startswith("```"):
            in_code = not in_code
            stripped = ""
        heading = re.match(r"#+ +(.*)", stripped)
        if heading and not in_code:
            unread = heading.group(1) in UNREAD_SECTIONS
        breaks = in_code or unread or not stripped or heading or stripped.startswith(("|", "<!--", "!["))
        if (breaks or NEW_PARAGRAPH.match(stripped)) and collected:
            yield first, " ".join(collected)
            collected = []
        if not breaks:
            first = first if collected else number
            collected.append(NEW_PARAGRAPH.sub("", stripped))


def paragraphs_of_header(text):
    """Yields (line, paragraph) of the comments of a C++ header; a comment behind code is one of its own."""
    collected, first, behind_code = [], 0, False  # the last: a comment that began behind code
    for number, line in enumerate(text.splitlines() + [""], 1):
        match = re.match(r"^(\s*)//[/!]?<? ?(.*)$", line)
        comment = match.group(2).strip() if match else None
        is_new = comment in (None, "") or NEW_PARAGRAPH.match(comment) or (behind_code and len(match.group(1)) < 20)
        if is_new and collected:
            yield first, " ".join(collected)
            collected, behind_code = [], False
        if comment and comment.startswith("SPDX-"):
            continue
        if comment:
            first = first if collected else number
            # "@param size" names what the sentence is about: one word
            collected.append(re.sub(r"^@(brief|note|return|throws|pre|post|param)\s*", "", comment))
        elif behind := re.search(r";?\s//[/!]?<? (.*)$", line):
            collected, first, behind_code = [behind.group(1).strip()], number, True


def long_sentences(path):
    """Lines `file:line: words: sentence`."""
    text = path.read_text(encoding="utf-8")
    paragraphs = paragraphs_of_page(text) if path.suffix == ".md" else paragraphs_of_header(text)
    where = path.relative_to(ROOT) if path.is_relative_to(ROOT) else path
    return [f"{where}:{line}: {count_words(sentence)} words: {sentence}" for line, paragraph in paragraphs
            for sentence in sentences(paragraph) if count_words(sentence) > MOST_WORDS]


@functools.cache
def file_names():
    """The names, without folders, of all files of the project."""
    folders = ("configs", "include", "jobs", "scripts", "src", "tests")
    return {path.name for folder in folders for path in (ROOT / folder).rglob("*.*")} | {"config.ini"}


def missing_files(page):
    """Files that a page names in `code` and that are not there; module/file.hpp lies in src or include/trime."""
    text = re.sub(r"```.*?```", "", page.read_text(encoding="utf-8"), flags=re.DOTALL)
    missing = []
    for name in re.findall(r"`((?:[\w.]+/)+[\w.]+\.(?:hpp|cpp|py|sh|ini|sbatch|xy))`", text):
        places = [ROOT / name, page.parent / name, ROOT / "src" / name, ROOT / "include" / "trime" / name]
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


class Prose(unittest.TestCase):
    def test_the_counter_itself(self):
        self.assertEqual(count_words("A `b c d` [link here](far/away.md), 3 - 4 cm."), 5)
        self.assertEqual(sentences("One is, e.g. Two. Three (see 4.5). `Five` is six. seven"),
                         ["One is, e.g. Two.", "Three (see 4.5).", "`Five` is six. seven"])
        page = "# Title\nOne\ntwo.\n\n| a |\n```sh\ncode\n```\n* item\n* item two\n## Sources\n* book\n"
        self.assertEqual(list(paragraphs_of_page(page)), [(2, "One two."), (9, "item"), (10, "item two")])
        header = ("// SPDX-License-Identifier: X\n/// @brief One\n/// two.\n/// @param x three\nint x; ///< four\n"
                  "                          ///< more\n  /// five\n")
        self.assertEqual(list(paragraphs_of_header(header)),
                         [(2, "One two."), (4, "x three"), (5, "four more"), (7, "five")])

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
        found = [line for path in named for line in long_sentences(path)]
        print("\n".join(found))
        sys.exit(1 if found else 0)
    unittest.main()
