#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests trime_mpi.parallel, which makes meshes in place, on 1, 2 and 3 ranks: the meshes of the program, arrays without
copies, sizes by functions, exceptions on all ranks, and Poisson's equation in dolfinx without a file."""
import json
import math
import os
import re
import subprocess
import sys
import unittest

from trime_run import MPIEXEC, ROOT, WorkspaceCase, environment, run

sys.path.insert(0, str(ROOT / "scripts" / "python"))
import trime_mpi  # noqa: E402  (found by the line above)

PYTHON_PATH = os.pathsep.join([str(ROOT / "scripts" / "python"), os.environ.get("PYTHONPATH", "")])
PLATE = """[shape]
geometry = difference(plate, hole)
[shape.plate]
type = rectangle
x_min = 0
x_max = 2
y_min = 0
y_max = 1
[shape.hole]
type = circle
center = 1 0.5
radius = 0.2
[meshing]
points = 2000
"""
SMALLEST = """split_ears = true
[size.wave]
expression = 1 + 3*x
[size.coast]
expression = 5 - 2*x
[output]
accept = fvcom mpas
"""


def python(*arguments, ranks=1, timeout=120):
    """Runs a Python program on some ranks, and returns what it has printed."""
    start = [] if ranks == 1 else [MPIEXEC, "-np", str(ranks)]
    done = subprocess.run([*start, sys.executable, *map(str, arguments)], capture_output=True, text=True, check=False,
                          timeout=timeout, env=environment(1) | {"PYTHONPATH": PYTHON_PATH})
    if done.returncode:
        raise AssertionError(f"{arguments} on {ranks} ranks: exit code {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


class Parallel(WorkspaceCase):
    def hash_of_program(self, sizing, name="plate"):
        config = self.directory / f"{name}.ini"
        config.write_text(PLATE + sizing)
        done = run(config, "output.overwrite=true", f"output.directory={self.directory}")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return re.search(r"hash\W+([0-9a-f]{16})", done.stdout)[1]

    def check_errors(self, found):
        kind, text, cause, kinds = found["failed"]
        self.assertEqual((kind, cause, kinds), ("GeometryError", "ZeroDivisionError", 1))
        self.assertRegex(text, r"size function failed .*ZeroDivisionError: a fault of the user \(.*ranks.py, line \d+")
        self.assertEqual(found["wrong"][0], "GeometryError")
        self.assertRegex(found["wrong"][1], r"expected (\d+) sizes for an array with the shape \(\1, 2\), found")
        self.assertRegex(found["negative"][1], "expected a positive finite size, found -")
        self.assertEqual(found["formula_error"][0], "ConfigError")
        self.assertEqual(found["no_count"][0], "ConfigError")
        self.assertRegex(found["no_model"][1], "expected names of models among adcirc .*, found 'fvcon'")
        self.assertEqual(found["one_size_fails"][2:], ["ZeroDivisionError", 1])
        self.assertRegex(found["unknown_part"][1], "^open_boundary: no part of the boundary has the name 'hol'.*'hole'")
        self.assertEqual(found["alone"], 3 * [(found["ranks"] - 1) * ["ConfigError"] + ["TypeError"]])
        if found["ranks"] == 1:
            self.assertIsNone(found["other_order"])
            return
        self.assertRegex(found["other_order"][1], "rank 0 has 'size 'a' expression 1 .*, another rank has 'size 'b' ")
        self.assertRegex(found["other_name"][1], "rank 0 has 'size 'a' .*, another rank has 'size 'a a' ")

    def check_names(self, named):
        """All packages and both directions of the curve have the same edges, an interface those without a curve."""
        for counts in named:
            self.assertEqual({name: set(count) for name, count in counts.items()},
                             {name: {count[0]} for name, count in named[0].items()})
        wall, rest = (named[0][name][0] for name in ("wall", "square|west"))
        self.assertAlmostEqual(wall / (wall + rest), 0.7, delta=0.05)

    def test_the_same_mesh_on_all_ranks_as_by_the_program(self):
        expected = {"uniform": self.hash_of_program(""),
                    "automatic": self.hash_of_program("[sizing]\ntype = automatic\n"),
                    "smallest": self.hash_of_program(SMALLEST, "smallest_of_program"),
                    "formula": self.hash_of_program("[sizing]\ntype = expression\nexpression = 1 + 3*x*x + y\n")}
        started, smooth, named = set(), set(), set()
        by_program = trime_mpi.read(self.directory / "smallest_of_program.h5")
        for ranks in (1, 2, 3):
            found = json.loads(python(ROOT / "tests" / "system" / "python_parallel_ranks.py", self.directory,
                                      ranks=ranks).splitlines()[-1])
            self.assertEqual(found["ranks"], ranks)
            self.assertEqual({name: found[name] for name in expected}, expected)
            self.assertEqual([found["callable"], found["read"]], 2 * [expected["formula"]])
            self.assertEqual([name for name, holds in found["arrays"].items() if not holds], [])
            self.assertTrue(found["checks"] and found["meshio"] and found["read_verdicts"])
            self.assertEqual(found["shares"], by_program.size_shares)
            self.assertEqual(found["verdicts"], [[v.solver, v.rule, v.limit, v.worst, v.broken, v.measured, v.refuses]
                                                 for v in by_program.verdicts])
            self.check_names(found["named"])
            named.add(json.dumps(found["named"]))
            smooth.add(found["smooth"])
            self.assertLess(found["calls"], 20000)  # one a point, where each place alone would take many
            self.assertGreater(found["places"], 200000)
            started.update(found["start"])
            self.assertLess(found["start_alpha"], 1.3)
            self.check_errors(found)
            if ranks == 2:
                self.check_poisson(*found["poisson"])
        self.assertEqual([len(hashes) for hashes in (started, smooth, named)], [1, 1, 1], (started, smooth, named))

    def check_poisson(self, coarse, fine):
        order = math.log2(coarse["error"] / fine["error"])  # from 1000 to 4000 points h is halved
        self.assertAlmostEqual(order, 2, delta=0.15)
        for found in (coarse, fine):
            self.assertAlmostEqual(found["copper"], 0.5, places=9)
            self.assertAlmostEqual(found["rim"], 4, places=9)
            self.assertGreater(found["between"], 20)

    def test_import_without_mpi(self):
        text = python("-c", "import sys, trime_mpi.parallel; print('mpi4py.MPI' in sys.modules)")
        self.assertEqual(text.strip(), "False")

    def test_the_example_adapts(self):
        for ranks in (1, 2):
            text = python(ROOT / "src" / "examples" / "adaptive.py", ranks=ranks)
            found = [(int(points), float(estimate)) for points, estimate in
                     re.findall(r"(\d+) points: estimate ([\d.]+)", text)]
            self.assertEqual(len(found), 4)
            # Once the mesh is adapted, the order is that of linear elements, despite the corner.
            levels = [estimate * math.sqrt(points) for points, estimate in found[2:]]
            self.assertLess(max(levels) / min(levels), 1.15, found)

    def test_a_disc_moves_through_a_channel(self):
        found = [re.findall(r"step (\d+): (\d+) points, (\d+) sweeps, largest alpha ([\d.]+), .* hash (\w+)",
                            python(ROOT / "src" / "examples" / "moving_disc.py", 3, 3000, ranks=ranks))
                 for ranks in (1, 2)]
        self.assertEqual(found[0], found[1])
        first, *steps = found[0]
        self.assertEqual(len(steps), 3)
        for step, points, sweeps, alpha, _ in steps:
            self.assertLessEqual(3 * int(sweeps), int(first[2]), step)
            self.assertLess(float(alpha), 1.2, step)
            self.assertAlmostEqual(int(points) / int(first[1]), 1, delta=0.02)


if __name__ == "__main__":
    unittest.main()
