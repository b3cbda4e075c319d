#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws sentences at random from the pages, messages and header comments of a revision, to be read by a person:

  tests/headers/sample_sentences.py --revision HEAD~20 --seed 7 --count 40

A third each comes from pages, messages (string literals of at least four words in src/**/*.cpp) and comments of headers
(*.hpp). The same revision and seed give the same sentences.
"""
import argparse
import io
import pathlib
import random
import re
import subprocess
import tarfile

import prose

ROOT = pathlib.Path(__file__).resolve().parents[2]


def files(revision):
    """Yields (name, text) of the pages and C++ sources of a revision, by name."""
    done = subprocess.run(["git", "-C", ROOT, "archive", revision], capture_output=True, check=True)
    with tarfile.open(fileobj=io.BytesIO(done.stdout)) as archive:
        for member in sorted(archive.getmembers(), key=lambda member: member.name):
            if member.isfile() and member.name.endswith((".md", ".hpp", ".cpp")) and member.name != "src/rules.md":
                yield member.name, archive.extractfile(member).read().decode("utf-8")


def kind_of(name, passage):
    """The pool of a passage, or None if it is not drawn."""
    if name.endswith(".md"):
        return None if passage.kind == "cell" else "page"
    if passage.kind == "message":
        return "message" if name.startswith("src/") and name.endswith(".cpp") else None
    return "header" if name.endswith(".hpp") else None


def with_spoken_tags(text):
    """The text of a header with words in place of tags, which a reader sees and prose.passages removes."""
    text = re.sub(r"(// ?)@param (\w+(?:, \w+)*) ", r"\1@note parameter \2: ", text)
    for tag, word in (("throws", "throws"), ("return", "returns"), ("pre", "requires that"), ("post", "afterwards")):
        text = re.sub(rf"(// ?)@{tag} ", rf"\1@note {word} ", text)
    return text


def pools(revision):
    """Lists of `file:line: sentence` of the revision, by kind."""
    found = {"page": [], "message": [], "header": []}
    for name, text in files(revision):
        for passage in prose.passages(name, with_spoken_tags(text) if name.endswith(".hpp") else text):
            kind = kind_of(name, passage)
            for sentence in prose.sentences(passage.text) if kind else ():
                if prose.count_words(sentence) > 3:
                    found[kind].append(f"{name}:{passage.line}: {sentence}")
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--revision", default="HEAD")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=40)
    options = parser.parse_args()
    draw = random.Random(options.seed)
    for index, (kind, lines) in enumerate(pools(options.revision).items()):
        wanted = (options.count + 2 - index) // 3
        print(f"# {kind}: {wanted} of {len(lines)}")
        print("\n".join(sorted(draw.sample(lines, wanted))))


if __name__ == "__main__":
    main()
