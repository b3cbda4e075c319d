#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Says which sources can be compiled as one: unity_groups.py MOST SOURCE...

Prints a line "GROUP<tab>SOURCE" for each source. Two sources share a group only if no name that one of them keeps to
itself, in a namespace without name, is a word of the other: neither compiles differently than alone. Sources of one
folder come first, since they include the same headers. A group has MOST sources at most."""
import os
import re
import sys

word = re.compile(r"[A-Za-z_]\w*")
# What begins a declaration at the left margin: a type, an alias, a function, a constant, another one behind a comma.
declared = [re.compile(pattern, re.M) for pattern in (
    r"^(?:template <[^\n]*>\s+)?(?:class|struct|enum class|enum)\s+(\w+)",
    r"^(?:using|namespace)\s+(\w+)\s*=",
    r"^[A-Za-z_][^\n(={;]*?\b(\w+)\(",
    r"^[A-Za-z_][^\n(={;]*?\b(\w+)(?:\[[^\n\]]*\])*\s*[={;]",
    r"^(?:constexpr|const)\b[^\n]*?,\s(\w+)\s*=",
)]


def names_and_words(path):
    """The names that the source keeps to itself, and all its words."""
    with open(path, encoding="utf-8") as file:
        text = file.read()
    text = re.sub(r"^\} // namespace$", "} @", text, flags=re.M)
    text = re.sub(r"//[^\n]*|\"(?:[^\"\\\n]|\\.)*\"", "", text)
    text = re.sub(r"^using [\w:]+;$", "", text, flags=re.M)  # these are the same for all
    names = set()
    for part in re.findall(r"^namespace \{\n(.*?)^\} @$", text, re.S | re.M):
        for pattern in declared:
            names.update(pattern.findall(part))
    return names, set(word.findall(text))


class Group:
    """Sources that are compiled as one."""

    def __init__(self, source):
        self.sources = [source]
        self.names, self.words = names_and_words(source)

    def fits(self, other, most):
        """True if the two can be one."""
        return (len(self.sources) + len(other.sources) <= most
                and not self.names & other.words and not other.names & self.words)

    def join(self, other):
        """Takes over the sources of the other."""
        self.sources += other.sources
        self.names |= other.names
        self.words |= other.words


def joined(groups, most, may_share):
    """The groups, each joined with the first before it that it fits and may share with."""
    result = []
    for group in groups:
        partner = next((other for other in result if may_share(other, group) and other.fits(group, most)), None)
        if partner:
            partner.join(group)
        else:
            result.append(group)
    return result


def groups_of(sources, most):
    """Groups of the sources: first those of a folder, then the small ones that are left."""
    def folder(group):
        return os.path.dirname(group.sources[0])
    groups = joined([Group(source) for source in sorted(sources)], most, lambda a, b: folder(a) == folder(b))
    groups.sort(key=lambda group: -len(group.sources))
    return joined(groups, most, lambda a, b: 2 * len(b.sources) <= most)


if __name__ == "__main__":
    for number, group in enumerate(groups_of(sys.argv[2:], int(sys.argv[1]))):
        for member in group.sources:
            print(f"group_{number}\t{member}")
