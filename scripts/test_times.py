#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Prints how long the tests of each label take, and the longest tests.

  scripts/test_times.py [BUILD]                          # BUILD: a build folder whose tests have run (build/ci)
  scripts/test_times.py [BUILD] --write tests/README.md  # puts the tables between the marks of that page

The seconds are wall-clock times of the last runs, which ctest keeps in
Testing/Temporary/CTestCostData.txt. Run all tests on an idle machine first. Tests of several labels count in each of
them.
"""
import argparse
import json
import pathlib
import subprocess
import sys

MARKS = ("<!-- times: made by scripts/test_times.py --write tests/README.md -->", "<!-- end of times -->")
LONGEST = 8  # tests in the second table


def seconds_of_tests(build):
    """Name to seconds of all tests that have run in a build folder."""
    text = (build / "Testing" / "Temporary" / "CTestCostData.txt").read_text(encoding="utf-8").split("---")[0]
    rows = [line.split() for line in text.splitlines()]
    return {name: float(seconds) for name, _, seconds in rows if float(seconds) > 0}


def labels_of_tests(build):
    """Name to labels of all tests of a build folder."""
    done = subprocess.run(["ctest", "--test-dir", str(build), "--show-only=json-v1"], capture_output=True, text=True,
                          check=True)
    labels = {}
    for test in json.loads(done.stdout)["tests"]:
        found = [entry["value"] for entry in test.get("properties", []) if entry["name"] == "LABELS"]
        labels[test["name"]] = found[0] if found else []
    return labels


def tables(seconds, labels):
    """Lines of two tables in Markdown."""
    lines = ["| label | tests | seconds in all | longest test |", "|---|---|---|---|"]
    for label in sorted({label for name in seconds for label in labels.get(name, [])}):
        names = [name for name in seconds if label in labels.get(name, [])]
        longest = max(names, key=seconds.get)
        lines.append(f"| `{label}` | {len(names)} | {sum(map(seconds.get, names)):.0f} | "
                     f"`{longest}`, {seconds[longest]:.0f} s |")
    lines += ["", "| longest tests | seconds |", "|---|---|"]
    for name in sorted(seconds, key=seconds.get, reverse=True)[:LONGEST]:
        lines.append(f"| `{name}` | {seconds[name]:.0f} |")
    return lines


def write(page, lines):
    """Puts the lines between the marks of the page."""
    text = page.read_text(encoding="utf-8")
    if any(text.count(mark) != 1 for mark in MARKS):
        sys.exit(f"{page}: expected the marks {MARKS[0]} and {MARKS[1]} once each")
    before, rest = text.split(MARKS[0])
    after = rest.split(MARKS[1])[1]
    page.write_text("\n".join([before + MARKS[0], *lines, MARKS[1] + after]), encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", nargs="?", type=pathlib.Path, default=pathlib.Path("build/ci"))
    parser.add_argument("--write", type=pathlib.Path, metavar="PAGE")
    arguments = parser.parse_args()
    try:
        lines = tables(seconds_of_tests(arguments.build), labels_of_tests(arguments.build))
    except OSError as error:
        sys.exit(f"{error}; run the tests first: ctest --test-dir {arguments.build}")
    if arguments.write:
        write(arguments.write, lines)
    else:
        print("\n".join(lines))


if __name__ == "__main__":
    main()
