#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Compares the mesh of every config in every method, on 1 and 3 ranks, with the hash in frozen_meshes.txt.

A change of the code that is not meant to change meshes must leave all hashes as they are. A change that is meant to
writes them again, and its commit message says why:
  TRIME_PROGRAM=build/ci/trime_mpi tests/system/frozen_meshes_test.py --write
"""
import concurrent.futures
import json
import pathlib
import sys
import unittest

import trime_run

TABLE = pathlib.Path(__file__).with_name("frozen_meshes.txt")
METHODS = ("distmesh", "cvd", "hybrid")
HEAD = "# config method mesh_hash: the same on any number of ranks; see frozen_meshes_test.py\n"


def mesh_hash(config, method, ranks, directory):
    """The hash that the report of a run names."""
    report = directory / "report.json"
    done = trime_run.run(trime_run.ROOT / "configs" / f"{config}.ini", f"meshing.method={method}",
                         f"output.directory={directory}", "output.formats=", "--report", report, ranks=ranks)
    if done.returncode != 0:
        raise AssertionError(f"{config} {method} on {ranks} ranks: exit code {done.returncode}\n{done.stderr[-2000:]}")
    return json.loads(report.read_text(encoding="utf-8"))["attributes"]["mesh_hash_hex"]


def found(cases, ranks):
    """The hashes of (config, method) cases, in their order."""
    def one(case):
        with trime_run.Workspace() as directory:
            return mesh_hash(*case, ranks, directory)
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        return list(pool.map(one, cases))


def frozen():
    """{(config, method): hash} of the table."""
    rows = [line.split() for line in TABLE.read_text(encoding="utf-8").splitlines() if not line.startswith("#")]
    return {(config, method): value for config, method, value in rows}


def all_cases():
    configs = sorted(path.stem for path in (trime_run.ROOT / "configs").glob("*.ini"))
    return [(config, method) for config in configs for method in METHODS]


class FrozenMeshes(unittest.TestCase):
    def test_the_table_has_every_config_in_every_method(self):
        self.assertEqual(sorted(frozen()), sorted(all_cases()))

    def test_meshes_have_their_frozen_hashes(self):
        table = frozen()
        for ranks in (1, 3):
            for case, value in zip(table, found(list(table), ranks)):
                with self.subTest(config=case[0], method=case[1], ranks=ranks):
                    self.assertEqual(value, table[case])


if __name__ == "__main__":
    if sys.argv[1:] == ["--write"]:
        cases = all_cases()
        TABLE.write_text(HEAD + "".join(f"{' '.join(case)} {value}\n" for case, value in zip(cases, found(cases, 1))),
                         encoding="utf-8")
    else:
        unittest.main()
