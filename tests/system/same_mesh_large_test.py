#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests that one config gives one mesh at realistic sizes: elements of very different sizes, up to 16 ranks, many
tiles.

Usage: same_mesh_large_test.py [FIELD ...]      all fields without a name

By default every method meshes each field except the largest on two numbers of ranks, and all numbers of ranks occur
among the methods. With TRIME_FULL_TABLE=1 every method meshes every field on every number of ranks. Each rank has one
thread.
"""
import os
import re
import sys
import unittest

from trime_run import Workspace, run

DOMAIN = "[shape]\ngeometry = domain\n[sizing]\ntype = expression\nexpression = {}\n"
DISC = "[shape]\ngeometry = disc\n[shape.disc]\ntype = circle\ncenter = 0.5 0.5\nradius = 0.4\n"
FIELDS = {  # sections of the config, number of points
    "steep": (DOMAIN.format("10^(2*x)"), 50_000),
    "steepest": (DOMAIN.format("10^(5*x)"), 100_000),
    "valley": (DOMAIN.format("0.001+abs(x-0.5)"), 100_000),
    "jump": (DOMAIN.format("x<0.5?1:0.03"), 100_000),
    "uniform": (DISC, 100_000),  # rests soon: tiles sleep
    "many": (DISC, 300_000),  # in the middle of a rank some tiles sleep, and others do not
}
METHODS = ("hybrid", "distmesh", "cvd")
ONE_METHOD = {"many": (1, 7, 16)}  # fields that take long: one method, on these numbers of ranks
PAIRS = ((1, 16), (2, 7), (3, 4))  # of numbers of ranks
TIMEOUT = 600  # seconds, against a run that hangs
FULL = os.environ.get("TRIME_FULL_TABLE", "0") == "1"
CHOSEN = sys.argv[1:] or list(FIELDS)
del sys.argv[1:]


def ranks_of(field, method):
    """The numbers of ranks that mesh this field by this method."""
    if field in ONE_METHOD:
        return ONE_METHOD[field]
    if FULL:
        return sorted(ranks for pair in PAIRS for ranks in pair)
    return PAIRS[(list(FIELDS).index(field) + METHODS.index(method)) % len(PAIRS)]


class SameMeshLarge(unittest.TestCase):
    def hash_of(self, config, method, ranks):
        """The hash that a finished run prints."""
        done = run(config, f"meshing.method={method}", f"output.directory={config.parent}", "output.overwrite=true",
                   "meshing.worst_alpha=1e300",  # steeper than triangles can follow
                   ranks=ranks, timeout=TIMEOUT)
        found = re.search(r"mesh hash\s+([0-9a-f]{16})", done.stdout, re.IGNORECASE)
        self.assertTrue(done.returncode == 0 and found, f"{method}, {ranks} ranks:\n{done.stdout}{done.stderr}")
        return found[1]

    def test_every_number_of_ranks_gives_one_mesh(self):
        table, differ = [], []
        for field in CHOSEN:
            text, points = FIELDS[field]
            with Workspace() as work:
                config = work / f"{field}.ini"
                config.write_text(f"{text}[meshing]\npoints = {points}\n", encoding="ascii")
                for method in METHODS[:1] if field in ONE_METHOD else METHODS:
                    hashes = {ranks: self.hash_of(config, method, ranks) for ranks in ranks_of(field, method)}
                    row = f"{field:9}{points:7} {method:9}" + "".join(f"{n:4}: {text}" for n, text in hashes.items())
                    print(row, flush=True)
                    table.append(row)
                    if len(set(hashes.values())) != 1:
                        differ.append(f"{field} {method}")
        self.assertEqual(differ, [], "\n" + "\n".join(table))
        self.assertEqual(len(table), sum(1 if field in ONE_METHOD else len(METHODS) for field in CHOSEN))


if __name__ == "__main__":
    unittest.main()
