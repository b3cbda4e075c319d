#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that functions are short: at most 40 lines and 5 parameters. It needs Universal Ctags.

Usage: check_functions.py [ROOT]     ROOT: the top of the tree (default: the one that this script lies in)
Prints each function of include and src that is longer, or takes more, as file:line, and exits with 1 if there is any.
"""
import json
import pathlib
import subprocess
import sys

MOST_LINES = 40
MOST_PARAMETERS = 5
# Functions that had more parameters when this check was written. The list only shrinks.
WIDER = {
    "BoundaryRefiner", "DensitySampler", "FixedAxis", "HilbertStart", "Implementation", "Mesher", "RunContext",
    "SiteTally", "add", "add_children", "certify", "holds", "in_circle", "judge",
    "list_triangles", "lowest", "measure_tile", "nearest", "next_places", "pass_over",
    "read", "report_losses", "run_mesher", "stands_for_bent_curve", "store_moves", "sweep_group",
    "take", "treat_place", "treat_step", "visit", "visit_children", "write", "write_checkpoint",
}


def parameters(signature):
    """How many parameters a signature such as "(int a, std::map<int, int> b) const" has."""
    depth, commas, words = 0, 0, False
    for mark in signature:
        if mark in "(<{[":
            depth += 1
        elif mark in ")>}]":
            depth -= 1
            if depth == 0:
                break
        elif mark == "," and depth == 1:
            commas += 1
        words = words or mark not in "( "
    return commas + 1 if words else 0


def functions(root):
    """The definitions of functions in include and src, as ctags finds them."""
    done = subprocess.run(["ctags", "-R", "--languages=C++", "--kinds-C++=f", "--fields=+neS", "--output-format=json",
                           "-f", "-", "include", "src"], cwd=root, capture_output=True, text=True, check=True)
    for line in done.stdout.splitlines():
        tag = json.loads(line)
        if not tag["name"].startswith("__anon"):  # a lambda is a part of its function
            yield tag


def complaints(root):
    """A line for each function that is too long or takes too much."""
    for tag in functions(root):
        place = f"{tag['path']}:{tag['line']}: {tag['name']}"
        lines = tag.get("end", tag["line"]) - tag["line"] + 1
        if lines > MOST_LINES:
            yield f"{place} has {lines} lines; at most {MOST_LINES} are allowed"
        count = parameters(tag.get("signature", "()"))
        if count > MOST_PARAMETERS and tag["name"] not in WIDER:
            yield f"{place} takes {count} parameters; at most {MOST_PARAMETERS} are allowed"


def main():
    root = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parents[1]
    found = list(complaints(root))
    for line in found:
        print(line)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
