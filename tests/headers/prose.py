# SPDX-License-Identifier: BSD-3-Clause
"""Reads the prose of the project: sentences of Markdown pages, of comments and messages in C++, and of docstrings in
Python, and their faults.

A sentence is plain if it has no word of prose_words.txt, at most MOST_WORDS words, and a verb. Verbs are known by
prose_verbs.txt: if a good sentence is refused because its verb is missing there, add the verb.
"""
import ast
import functools
import inspect
import pathlib
import re
from typing import NamedTuple

HERE = pathlib.Path(__file__).resolve().parent
MOST_WORDS = 40

SENTENCE_END = re.compile(r"(?<=[.!?])[\"')\]*]*\s+(?=[\"'(\[*`]*[A-Z0-9`])")
ABBREVIATION = re.compile(r"\b(e\.g|i\.e|et al|cf|vs|[A-Z])\.$")
TAG = re.compile(r"^@(brief|note|return|throws|pre|post|param)\s*")
ITEM = re.compile(r"^([-*] |\d+\. )")
UNREAD_SECTIONS = ("Sources", "Changes")
LITERAL = re.compile(r'"((?:[^"\\\n]|\\.)*)"')
AUXILIARIES = set("am is are was were be been being has have had do does did can cannot could may might must shall "
                  "should will would".split())
ADVERBS = set("not also always never no only still".split())
FRAGMENT_OPENERS = re.compile(r"^(Of|The same|As|Those|Like|Likewise|What|Whether|Which|How|Who)\b")
HEADER_OPENERS = re.compile(r"^([Oo]f|[Tt]hose|[Tt]he same|(True|False|Null|Nothing|Empty) (if|where|once|when))\b")
CLAUSE_OPENERS = re.compile(r"\b(whether|what|which|how|who|that|if|where|when)\b", re.IGNORECASE)


class Passage(NamedTuple):
    """A piece of prose. Its kind is paragraph, item, cell (of a table), comment or message."""
    line: int
    kind: str
    text: str


def sentences(paragraph):
    """The sentences of one paragraph."""
    parts, rest = [], ""
    for part in SENTENCE_END.split(" ".join(paragraph.split())):
        rest = f"{rest} {part}".strip()
        if not ABBREVIATION.search(rest):
            parts.append(rest)
            rest = ""
    return parts + ([rest] if rest else [])


def without_code(sentence):
    """The sentence with each piece of code as the word "code", and links without their targets."""
    plain = re.sub(r"(`+)(?!`).+?(?<!`)\1(?!`)", "code", sentence)
    return re.sub(r"!?\[((?:[^\[\]]|\[[^\]]*\])*)\]\([^)]*\)", r"\1", plain)


def count_words(sentence):
    """Words of a sentence. A piece of code is one word, a bare number or sign none, the target of a link none."""
    return sum(1 for word in without_code(sentence).split() if re.search(r"[A-Za-z]", word))


def passages_of_page(text):
    """Yields the passages of a Markdown page without code blocks, headings and sections of sources."""
    collected, first, kind, in_code, unread = [], 0, "paragraph", False, False
    for number, line in enumerate(text.splitlines() + [""], 1):
        stripped = line.strip()
        if stripped.startswith("```"):
            in_code = not in_code
            stripped = ""
        heading = re.match(r"#+ +(.*)", stripped)
        if heading and not in_code:
            unread = heading.group(1) in UNREAD_SECTIONS
        breaks = in_code or unread or not stripped or heading or stripped.startswith(("|", "<!--", "!["))
        item = ITEM.match(stripped)
        if (breaks or item) and collected:
            yield Passage(first, kind, " ".join(collected))
            collected = []
        if stripped.startswith("|") and not in_code and not unread:
            cells = re.split(r"(?<!\\)\|", stripped.strip("|"))
            yield from (Passage(number, "cell", cell.strip()) for cell in cells if re.search("[A-Za-z]", cell))
        if not breaks:
            if not collected:
                first, kind = number, "item" if item else "paragraph"
            collected.append(ITEM.sub("", stripped))


def passages_of_comments(text):
    """Yields the comments of C++; a comment behind code is a separate one."""
    collected, first, behind_code = [], 0, False  # the last: a comment that began behind code
    for number, line in enumerate(text.splitlines() + [""], 1):
        match = re.match(r"^(\s*)//[/!]?<? ?(.*)$", line)
        comment = match.group(2).strip() if match else None
        is_new = (comment in (None, "") or TAG.match(comment) or ITEM.match(comment)
                  or (behind_code and len(match.group(1)) < 20))
        if is_new and collected:
            yield Passage(first, "comment", " ".join(collected))
            collected, behind_code = [], False
        if comment and comment.startswith("SPDX-"):
            continue
        if comment:
            first = first if collected else number
            collected.append(TAG.sub("", comment))  # "@param size" names what the sentence is about: one word
        elif behind := re.search(r"[;,{})]\s*//[/!]?<? (.*)$", line):
            collected, first, behind_code = [behind.group(1).strip()], number, True


def passages_of_messages(text):
    """Yields the string literals of C++ with at least four words; literals that follow each other are one."""
    collected, first = [], 0
    for number, line in enumerate(text.splitlines() + [""], 1):
        code = re.sub(r"^\s*//.*$", "", line)
        rest = code
        for literal in LITERAL.finditer(code):
            if collected and code[:literal.start()].strip() and rest is code:
                yield Passage(first, "message", "".join(collected))
                collected = []
            first = first if collected else number
            collected.append(literal.group(1).replace('\\"', '"').replace("\\n", " "))
            rest = code[literal.end():]
            if re.sub(r"//.*", "", rest).strip() and not re.match(r'\s*"', rest):
                yield Passage(first, "message", "".join(collected))
                collected = []
        if rest is code and collected:
            yield Passage(first, "message", "".join(collected))
            collected = []


def passages_of_docstrings(text):
    """Yields the paragraphs of docstrings in Python as comments, without indented lines (code, tables) and usage."""
    for node in ast.walk(ast.parse(text)):
        if not isinstance(node, (ast.Module, ast.ClassDef, ast.FunctionDef)) or not ast.get_docstring(node):
            continue
        collected, first = [], 0
        for number, line in enumerate([*inspect.cleandoc(node.body[0].value.value).splitlines(), ""]):
            breaks = not line or line.startswith((" ", "Usage:"))
            if (breaks or ITEM.match(line)) and collected:
                yield Passage(first, "comment", " ".join(collected))
                collected = []
            if not breaks:
                first = first if collected else node.body[0].lineno + number
                collected.append(ITEM.sub("", line))


def passages(name, text):
    """All passages of a file by the ending of its name."""
    if name.endswith(".md"):
        return list(passages_of_page(text))
    if name.endswith(".py"):
        return sorted(passages_of_docstrings(text))
    messages = [passage for passage in passages_of_messages(text) if len(passage.text.split()) > 3]
    return sorted([*passages_of_comments(text), *messages])


@functools.cache
def refused_words():
    """Pairs of a pattern and what to write instead."""
    lines = (HERE / "prose_words.txt").read_text(encoding="utf-8").splitlines()
    rows = [line.split(" -> ") for line in lines if line and not line.startswith("#")]
    return [(re.compile(rf"\b(?:{words})(?!\w)", re.IGNORECASE), advice) for words, advice in rows]


def inflected(verb):
    """The verb, its third person and its past."""
    stem = re.sub("y$", "i", verb) if re.search("[^aeiou]y$", verb) else verb
    third = f"{stem}es" if stem != verb or re.search("(s|sh|ch|x|z|o)$", verb) else f"{verb}s"
    past = f"{stem}d" if stem.endswith("e") else f"{stem}ed"
    return {verb, third, past, f"{verb}{verb[-1]}ed"}


@functools.cache
def verbs():
    """All verbs of prose_verbs.txt with their forms. A line with several words names all forms of an irregular verb."""
    known = set()
    for line in (HERE / "prose_verbs.txt").read_text(encoding="utf-8").splitlines():
        words = line.split("#")[0].split()
        known.update(*map(inflected, words[:1]), words)
    return known


def count_verbs(sentence):
    """Verbs of a sentence; an auxiliary and its participle are one."""
    words = [re.sub("n't$|'s$|'ll$", "", word) for word in re.findall("[a-z']+", without_code(sentence).lower())]
    count, since_auxiliary = 0, 99
    for word in words:
        if word in AUXILIARIES:
            count += since_auxiliary > 0
            since_auxiliary = 0
        elif word in verbs():
            count += since_auxiliary > 1 or word.endswith("s")
            since_auxiliary += 1
        elif word not in ADVERBS and not word.endswith("ly"):
            since_auxiliary += 1
    return count


def is_fragment(sentence, kind, is_first):
    """True if the sentence lacks a verb that sentences of this kind need. Cells, messages, and first sentences of items
    and comments may be names of things, but a comment that begins like half a sentence needs another verb."""
    if kind in ("cell", "message") or sentence.endswith("?") or not re.search("[A-Za-z]{2}", sentence):
        return False
    opens_as_fragment = FRAGMENT_OPENERS.match(sentence)
    needed = 1
    if opens_as_fragment:
        needed += len(CLAUSE_OPENERS.findall(without_code(sentence))) > 0
    elif kind == "comment" or (kind == "item" and is_first):
        return False
    return count_verbs(sentence) < needed


def faults(passage):
    """One line for each fault of a passage."""
    found = []
    for pattern, advice in refused_words():
        for match in pattern.finditer(without_code(passage.text)):
            found.append(f"'{match.group()}': {advice}: ...{passage.text[:60]}")
    for index, sentence in enumerate(sentences(passage.text)):
        if passage.kind != "cell" and count_words(sentence) > MOST_WORDS:
            found.append(f"{count_words(sentence)} words: {sentence}")
        if is_fragment(sentence, passage.kind, index == 0):
            found.append(f"no verb: {sentence}")
    return found


def header_faults(passage):
    """One line for each fault that only comments of headers have: a question in place of "Returns whether ...", "True
    if" in place of "Returns true if", and a comment that begins behind its noun, such as `of this rank`."""
    if passage.kind != "comment":
        return []
    opener = HEADER_OPENERS.match(passage.text)
    found = [f"begins with '{opener.group()}': name the thing first: {passage.text[:60]}"] if opener else []
    return found + [f"asks: {sentence}" for sentence in sentences(passage.text) if sentence.endswith("?")]
