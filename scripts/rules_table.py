#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Prints the numbers of all rules headers (src/*/...rules.hpp) as one Markdown table per module.

A number is a member of a struct whose name ends in `Rules` or `Options`. The comment above it gives its unit and its
reason:

    /// [h] A move shorter than this counts as rest. With 0.01 sweeps stop earlier.
    static constexpr double still = 0.005;

The column "effect" comes from src/rules_effects.csv, which scripts/measure_rules.py writes.

Usage: rules_table.py [--check PAGE | --write PAGE] [--root ROOT]
  --check PAGE   compare the tables with the part of PAGE between the lines of MARKS; exit with 1 if they differ
  --write PAGE   put the tables there

The script exits with 1 for

  * a number without a unit or a reason,
  * a number that has no effect in the file, and neither "Not measured." nor "Measured" with the result in its comment,
  * a number that has an effect in the file, and "Not measured." in its comment,
  * an effect of a number that does not exist.

It warns on the error stream if one name has several values. Two structs may use one word for two things only if their
reasons say which things these are.
"""
import argparse
import csv
import dataclasses
import pathlib
import re
import sys

MARKS = ("<!-- rules: made by scripts/rules_table.py --write src/rules.md -->", "<!-- end of rules -->")
EFFECTS = pathlib.Path("src/rules_effects.csv")
CASES = 6  # of scripts/measure_rules.py
NOT_MEASURED = "Not measured."
BY_HAND = re.compile(r"\bMeasured\b")  # the reason contains the result
STRUCT = re.compile(r"^\s*(?:struct|class)\s+(\w+)[^;]*\{")
NUMBER = re.compile(r"^\s*(?:static|inline)\s+constexpr\s+(?P<type>[\w:<>, ]+?)\s+(?P<name>\w+)\s*(?P<value>[={].*)$")
COMMENT = re.compile(r"^\s*///\s?(.*)$")
UNIT = re.compile(r"^\[([^\]]+)\]\s*(.*)$", re.DOTALL)


@dataclasses.dataclass
class Number:
    """One line of a table. `where` is file:line."""
    module: str
    struct: str
    name: str
    value: str
    unit: str
    reason: str
    where: str

    def full_name(self):
        return f"{self.module}::{self.struct}::{self.name}"


def value_text(text):
    """The value of `= value;` or `{value};`, on one line."""
    text = " ".join(text.split()).rstrip(";").strip()
    return text[1:].strip() if text.startswith("=") else text


def one_statement(lines, first):
    """The statement that begins in line `first`, up to its semicolon, and the index of its last line."""
    text = lines[first].split("//")[0]
    last = first
    while ";" not in text and last + 1 < len(lines):
        last += 1
        text += " " + lines[last].split("//")[0].strip()
    return text, last


def read_numbers(text, module, where):
    """Returns (numbers, complaints) of one header."""
    numbers, complaints, comment, struct = [], [], [], ""
    lines = text.splitlines()
    k = 0
    while k < len(lines):
        line = lines[k]
        if match := COMMENT.match(line):
            comment.append(match.group(1))
        elif match := STRUCT.match(line):
            struct, comment = match.group(1), []
        elif NUMBER.match(line):
            place = f"{where}:{k + 1}"
            statement, k = one_statement(lines, k)
            number = NUMBER.match(statement)
            unit = UNIT.match(" ".join(" ".join(comment).replace("@brief", "").split()))
            name = number.group("name")
            if not unit:
                complaints.append(f"{place}: {name}: no unit: expected a comment '/// [unit] reason' above it")
            elif not re.search(r"\w", unit.group(2)):
                complaints.append(f"{place}: {name}: no reason after the unit [{unit.group(1)}]")
            else:
                numbers.append(Number(module, struct, name, value_text(number.group("value")), unit.group(1).strip(),
                                      unit.group(2).strip(), place))
            comment = []
        elif line.strip():
            comment = []
        k += 1
    return numbers, complaints


def read_tree(root):
    """Returns (numbers, complaints) of all rules headers of a tree, by module and file."""
    numbers, complaints = [], []
    for path in sorted((root / "src").glob("*/**/*rules.hpp")):
        where = path.relative_to(root).as_posix()
        found, wrong = read_numbers(path.read_text(encoding="utf-8"), path.relative_to(root / "src").parts[0], where)
        numbers += found
        complaints += wrong
    return numbers, complaints


def read_effects(root):
    """The lines of the CSV by the full name of their number; none if there is no such file."""
    effects = {}
    if (root / EFFECTS).exists():
        with (root / EFFECTS).open(encoding="utf-8", newline="") as file:
            for row in csv.DictReader(file):
                effects.setdefault(row["number"], []).append(row)
    return effects


def effect_complaints(numbers, effects):
    """Returns one line for each number if it is unclear whether it was measured, and one for each effect without a
    number."""
    lines = []
    for number in numbers:
        is_measured, says_not = number.full_name() in effects, NOT_MEASURED in number.reason
        if not is_measured and not says_not and not BY_HAND.search(number.reason):
            lines.append(f"{number.where}: {number.name}: no line in {EFFECTS}: run scripts/measure_rules.py --only "
                         f"{number.full_name()}, or say '{NOT_MEASURED}' in its comment")
        if is_measured and says_not:
            lines.append(f"{number.where}: {number.name}: its comment says '{NOT_MEASURED}', but {EFFECTS} has an "
                         "effect")
    known = {number.full_name() for number in numbers}
    return lines + [f"{EFFECTS}: {name}: there is no such number" for name in sorted(effects) if name not in known]


def change_text(row):
    """Returns the text of one line of the CSV file."""
    failed = row["failed"].split()
    changed = CASES - len(failed) - int(row["same_meshes"])
    parts = [f"fails: {', '.join(failed)}"] if failed else []
    if changed == 0:
        parts.append("other meshes the same" if failed else "same meshes")
    else:
        parts.append(f"{changed} of {CASES} meshes")
        parts += [f"mean alpha {row['mean_alpha']}"] if float(row["mean_alpha"]) else []
        parts += [f"largest {float(row['largest_alpha']):+.2f}"] if abs(float(row["largest_alpha"])) >= 0.005 else []
        parts += [f"points {100 * float(row['points']):+.2g} %"] if float(row["points"]) else []
    return ", ".join(parts + ([f"time x{float(row['time']):.2g}"] if row["time"] else []))


def effect_text(rows):
    """The effect of a number: `x1.25: 1 of 6 meshes, mean alpha +0.0012; x0.8: same meshes`."""
    texts = {}
    for row in sorted(rows, key=lambda row: -float(row["factor"])):
        texts.setdefault(change_text(row), []).append(f"x{row['factor']}")
    return "; ".join(f"{', '.join(factors)}: {text}" for text, factors in texts.items())


def warnings(numbers):
    """One line for each name that stands in several structs with different values or units."""
    by_name = {}
    for number in numbers:
        by_name.setdefault(number.name, []).append(number)
    lines = []
    for name, group in sorted(by_name.items()):
        if len(group) > 1:
            same = len({(number.value, number.unit) for number in group}) == 1
            places = "; ".join(f"{n.module}: {n.struct}::{name} = {n.value} [{n.unit}] ({n.where})" for n in group)
            lines.append(f"{name}: {'one number twice' if same else 'one name, several numbers'}: {places}")
    return lines


def cell(text):
    """Text that stays in its cell."""
    return text.replace("|", "\\|")


def tables(numbers, effects):
    """The Markdown of all tables."""
    lines, module = [], None
    for number in numbers:
        if number.module != module:
            module = number.module
            lines += [""] if lines else []
            lines += [f"## {module}", "", "| name | value | unit | reason | effect |", "|---|---|---|---|---|"]
        lines.append(f"| `{number.struct}::{number.name}` | {cell(number.value)} | {cell(number.unit)} | "
                     f"{cell(number.reason)} | {effect_text(effects.get(number.full_name(), []))} |")
    return "\n".join(lines)


def split_page(page):
    """The text of a page before, between and after the marks."""
    text = page.read_text(encoding="utf-8")
    first, last = text.find(MARKS[0]), text.find(MARKS[1])
    if first < 0 or last < first:
        sys.exit(f"rules_table.py: {page} has no part between the lines\n  {MARKS[0]}\n  {MARKS[1]}")
    first += len(MARKS[0])
    return text[:first], text[first:last], text[last:]


def first_difference(page, now):
    """The first lines that differ, as text."""
    ours, theirs = now.splitlines(), page.splitlines()
    for k in range(max(len(ours), len(theirs))):
        ours_k, theirs_k = (lines[k] if k < len(lines) else "(nothing)" for lines in (ours, theirs))
        if ours_k != theirs_k:
            return f"  page:    {theirs_k}\n  headers: {ours_k}"
    return "  the blanks around the tables"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    action = parser.add_mutually_exclusive_group()
    action.add_argument("--check", type=pathlib.Path, metavar="PAGE", help="compare the tables with those of PAGE")
    action.add_argument("--write", type=pathlib.Path, metavar="PAGE", help="put the tables into PAGE")
    parser.add_argument("--root", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parent.parent,
                        help="the top of the source tree (default: the tree that holds this script)")
    options = parser.parse_args()
    numbers, complaints = read_tree(options.root)
    effects = read_effects(options.root)
    complaints += effect_complaints(numbers, effects)
    for line in warnings(numbers):
        print(f"warning: {line}", file=sys.stderr)
    for line in complaints:
        print(line, file=sys.stderr)
    text = tables(numbers, effects)
    if options.write or options.check:
        page = options.write or options.check
        before, between, after = split_page(page)
        wanted = f"\n{text}\n" if text else "\n"
        if options.write:
            page.write_text(before + wanted + after, encoding="utf-8")
        elif between != wanted:
            print(f"{page} does not hold the numbers of the headers:\n{first_difference(between, wanted)}\n"
                  f"Run scripts/rules_table.py --write {page}", file=sys.stderr)
            return 1
    elif text:
        print(text)
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
