#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests scripts/scaling.py: its arithmetic on invented runs, its messages on bad input, and a small sweep."""
import csv
import json
import os
import unittest
import unittest.mock

from made_runs import made_run
from scaling import compare, measure, record, summary, sweep, tables
from scaling.backends import process, simulated, slurm
from scaling.errors import RunError, UsageError
from scaling.machine import slurm_cores
from scripts_test import call
from trime_run import PROGRAM, ROOT, Workspace

SCRIPT = ROOT / "scripts" / "scaling.py"
SMALL = """
[harness]
repeats = 2
[small]
kind = strong
config = configs/square.ini
points = 1e3
cases = 1x1 2x1
methods = cvd
stops = fixed rule
sweeps = 2
"""


def plan_of(text, **arguments):
    """The plan of an ini that is given as a text."""
    with Workspace() as work:
        (work / "s.ini").write_text(text, encoding="utf-8")
        return sweep.read_plan(work / "s.ini", **({"backend": "local", "nodes": [2]} | arguments))


class Sweeps(unittest.TestCase):
    def test_cases_of_an_ini(self):
        plan = plan_of(SMALL)
        self.assertEqual((plan.repeats, plan.warm_ups, len(plan.cases)), (2, 1, 4))
        self.assertEqual([(case.stop, case.layout) for case in plan.cases],
                         [("fixed", "1 x 1"), ("fixed", "2 x 1"), ("rule", "1 x 1"), ("rule", "2 x 1")])
        self.assertEqual(plan.cases[0].options, ("meshing.method=cvd", "meshing.max_sweeps=2"))
        self.assertEqual(plan.cases[2].config, "configs/square.ini")

    def test_weak_cases_have_points_for_each_core(self):
        plan = plan_of(SMALL.replace("strong", "weak").replace("1x1 2x1", "1x1 2x3"))
        self.assertEqual([case.points_asked for case in plan.cases], [1000, 6000, 1000, 6000])
        self.assertEqual({case.points_per_core for case in plan.cases}, {1000})

    def test_variants_and_overrides(self):
        text = SMALL + "variants =\n  once: meshing.initial_fraction=1\n  later: meshing.initial_fraction=0.2\n"
        plan = plan_of(text, overrides=("meshing.seed=3",), changes={"points": "50", "methods": None})
        self.assertEqual({case.variant for case in plan.cases}, {"once", "later"})
        self.assertTrue(all("meshing.seed=3" in case.options and case.points_asked == 50 for case in plan.cases))

    def test_cases_beside_run_here(self):
        plan = plan_of(SMALL + "beside = 1x1\n", backend="simulated")
        self.assertEqual([case.backend for case in plan.cases], ["simulated", "simulated", "local"] * 2)
        self.assertEqual(len(plan_of(SMALL + "beside = 1x1\n").cases), 4, "nothing beside runs that are here already")

    def test_words_for_cases(self):
        self.assertEqual(sweep.layouts("powers", [2]), [(1, 1), (2, 1), (1, 2)])
        self.assertEqual(sweep.layouts("powers", [8])[-4:], [(1, 4), (8, 1), (2, 4), (1, 8)])
        self.assertNotIn((1, 8), sweep.layouts("powers", [4, 4]), "threads stay within a node")
        self.assertEqual(sweep.layouts("ranks", [6]), [(1, 1), (2, 1), (4, 1), (6, 1)])
        self.assertEqual(sweep.layouts("threads", [3, 3]), [(1, 1), (1, 2), (1, 3)])

    def test_shipped_sweeps_can_be_read(self):
        inis = sorted(sweep.SWEEPS.glob("*.ini"))
        self.assertGreater(len(inis), 4)
        for ini in inis:
            with self.subTest(ini=ini.name):
                self.assertTrue(sweep.read_plan(ini, "local", [2]).cases)

    def test_what_is_wrong_in_an_ini(self):
        for change, expected in ((("kind = strong", "kind = odd"), "expected some of strong, weak; found 'odd'"),
                                 (("points = 1e3", "point = 1e3"), "unknown key 'point' in .small.; .* 'points'"),
                                 (("points = 1e3", ""), "has no 'points'"),
                                 (("1x1 2x1", "1x0"), "expected cases like 1x1 2x4.*'1x0'"),
                                 (("1e3", "many"), "found 'many'"), (("1e3", "nan"), "found 'nan'"),
                                 (("repeats = 2", "repeats = 0"), "from 1 on, found '0'"),
                                 (("configs/square.ini", "no.ini"), "there is no config no.ini"),
                                 (("cvd", "cvt"), "distmesh, cvd, hybrid; found 'cvt'"),
                                 (("[small]", "small"), "s.ini")):
            with self.subTest(change=change), self.assertRaisesRegex(UsageError, expected):
                plan_of(SMALL.replace(*change))
        with self.assertRaisesRegex(UsageError, "an empty sweep"):
            plan_of(SMALL, only="large")
        with self.assertRaisesRegex(UsageError, "needs the cores"):
            plan_of(SMALL.replace("1x1 2x1", "powers"), nodes=[])

    def test_cores_as_slurm_writes_them(self):
        self.assertEqual(slurm_cores("16(x2),8"), [16, 16, 8])
        self.assertEqual(slurm_cores(""), [])


class Rows(unittest.TestCase):
    def test_strong_efficiency_and_serial_fraction(self):
        rows, messages = summary.rows_of([made_run(1, 1, 8.0), made_run(4, 1, 2.5), made_run(2, 2, 2.0)])
        self.assertEqual(messages, [])
        self.assertEqual([row["efficiency"] for row in rows], [1.0, 0.8, 1.0])
        self.assertEqual([row["base"] for row in rows], ["1 x 1"] * 3)
        self.assertIsNone(rows[0]["serial_fraction"])
        self.assertAlmostEqual(rows[1]["serial_fraction"], (1 / 3.2 - 0.25) / 0.75)
        self.assertAlmostEqual(rows[2]["serial_fraction"], 0)

    def test_amdahl_gives_its_serial_fraction_back(self):
        for cores in (2, 64, 1000):
            self.assertAlmostEqual(summary.serial_fraction(1 / (0.1 + 0.9 / cores), cores), 0.1)

    def test_weak_efficiency(self):
        rows, _ = summary.rows_of([made_run(1, 1, 2.0, kind="weak", points_per_core=1000),
                                   made_run(4, 1, 2.5, points=4000, kind="weak", points_per_core=1000)])
        self.assertEqual([row["efficiency"] for row in rows], [1.0, 0.8])
        self.assertIsNone(rows[1]["serial_fraction"], "Karp and Flatt speak of strong scaling")

    def test_a_base_of_several_cores(self):
        rows, _ = summary.rows_of([made_run(4, 1, 2.0), made_run(8, 1, 1.25)])
        self.assertEqual([(row["base"], row["efficiency"]) for row in rows], [("4 x 1", 1.0), ("4 x 1", 0.8)])

    def test_oversubscribed_rows_have_no_efficiency(self):
        rows, _ = summary.rows_of([made_run(), made_run(64, 1, 3.0, oversubscribed=True)])
        self.assertIsNone(rows[1]["efficiency"])
        self.assertIn("oversubscribed", tables.report(rows, {}, {}))

    def test_medians_and_spread(self):
        row = summary.summarise([made_run(seconds=s) for s in (1.0, 5.0, 2.0, 3.0, 2.5)])
        self.assertEqual((row["seconds"], row["min_s"], row["max_s"]), (2.5, 1.0, 5.0))
        self.assertAlmostEqual(row["spread"], (3.0 - 2.0) / 2.5)
        self.assertAlmostEqual(row["phases"]["sweeps"]["avg"], 0.8 * 2.5)
        self.assertIsNone(summary.spread_of([1.0, 2.0]))

    def test_unequal_hashes(self):
        rows, messages = summary.rows_of([made_run(), made_run(2, mesh_hash="b"), made_run(points=5)])
        self.assertEqual([row["same_mesh"] for row in rows], [False, False, True])
        self.assertEqual(len(messages), 1)
        self.assertRegex(messages[0], "1 x 1: a.*2 x 1: b")
        self.assertIn("MISMATCH", tables.report(rows, {}, {}, messages))
        _, messages = summary.rows_of([made_run(), made_run(mesh_hash="b")])
        self.assertEqual(len(messages), 1, "two runs of one case")

    def test_the_same_mesh_in_two_sweeps_and_backends(self):
        _, messages = summary.rows_of([made_run(), made_run(sweep="t", backend="simulated", mesh_hash="b")])
        self.assertEqual(len(messages), 1)

    def test_published_times_stand_beside(self):
        rows, _ = summary.rows_of([made_run(points=10000, method="hybrid", reference="square")])
        text = tables.report(rows, {}, tables.reference_times(ROOT / "scripts" / "scaling" / "reference.csv"))
        self.assertIn("| TriMe++: seconds |", text)
        self.assertIn("| 1.0-1.2 |", text)
        rows, _ = summary.rows_of([made_run(points=10000, method="hybrid", reference="square", variant="in stages")])
        self.assertNotIn("TriMe++", tables.report(rows, {}, tables.reference_times(
            ROOT / "scripts" / "scaling" / "reference.csv")), "that is of all points at once")

    def test_csv_holds_phases_and_counters(self):
        counters = {"run": {"points": {"sum": 4, "min": 1, "mean": 2.0, "max": 3}}}
        rows, _ = summary.rows_of([made_run(counters=counters)])
        self.assertIn("| 2 (3) |", tables.report(rows, {}, {}))
        with Workspace() as work:
            tables.write_csv(work / "r.csv", rows)
            with (work / "r.csv").open(encoding="utf-8") as stream:
                row, = csv.DictReader(stream)
        self.assertEqual((row["phase_sweeps"], row["points_max"], row["quality_alpha_mean"]), ("0.8", "3", "1.01"))

    def test_records_that_cannot_be_read(self):
        with Workspace() as work:
            for text in ("", "{}", "[]", '{"attributes": {"points": 3}, "groups": {}}'):
                (work / "r.json").write_text(text, encoding="utf-8")
                with self.subTest(text=text), self.assertRaisesRegex(RunError, "expected the record of a run"):
                    record.read_record(work / "r.json")
            for text in ("no json", '{"line": "other"}', "3", ""):
                (work / "r.jsonl").write_text(text, encoding="utf-8")
                with self.subTest(text=text), self.assertRaises(RunError):
                    record.read_runs([work / "r.jsonl"])

    def test_a_record(self):
        names = ("points", "triangles", "iterations", "bytes_per_point", "peak_memory_bytes", "most_points_of_a_rank")
        attributes = dict.fromkeys(names, 7) | {"mesh_hash_hex": "0a", "stop_reason": "stalled", "seconds_total": 3.0}
        timers = {"name": ["shape", "sweeps", "output"], "avg": [0.5, 2.0, 0.25], "bytes": [0, 8, 0]}
        counters = {"phase": ["run"], "name": ["ghosts"], "unit": ["sites"], "sum": [4], "min": [1], "mean": [2.0],
                    "max": [3]}
        groups = {"timers": {"attributes": {}, "columns": timers},
                  "counters": {"attributes": {"limit": "waits"}, "columns": counters}}
        with Workspace() as work:
            (work / "r.json").write_text(json.dumps({"attributes": attributes, "groups": groups}), encoding="utf-8")
            run = record.read_record(work / "r.json")
        self.assertEqual([run[key] for key in ("total_s", "seconds", "set_up_s", "mesh_s", "output_s")],
                         [3.0, 2.75, 0.5, 2.25, 0.25])
        self.assertEqual(run["phases"]["sweeps"], {"avg": 2.0, "bytes": 8})
        self.assertEqual(run["counters"], {"run": {"ghosts": {"sum": 4, "min": 1, "mean": 2.0, "max": 3}}})
        self.assertEqual((run["limit"], run["mesh_hash"], run["build"]["compiler"]), ("waits", "0a", "unknown"))

    def test_runs_of_another_version(self):
        run = made_run()
        del run["iterations"]
        with self.assertRaisesRegex(RunError, "has no 'iterations'; was it written by another version"):
            summary.rows_of([run])

    def test_sweeps_over_coarse_meshes_count_with_their_points(self):
        self.assertEqual(record.point_sweeps([{"sweep": 1, "points": 10}, {"sweep": 3, "points": 10},
                                              {"sweep": 4, "points": 100}]), 130)


class Compared(unittest.TestCase):
    def rows(self, *seconds, **changes):
        return summary.rows_of([made_run(seconds=s, **changes) for s in seconds])[0]

    def test_what_is_slower_than_its_spread_is_a_regression(self):
        for new, word, slower in (((1.2, 1.2, 1.2), "SLOWER", 1), ((0.8, 0.8, 0.8), "faster", 0),
                                  ((1.04, 1.04, 1.04), "same", 0), ((0.9, 1.2, 1.5), "same", 0)):
            with self.subTest(new=new):
                lines, count = compare.compare(self.rows(1.0, 1.0, 1.0), self.rows(*new))
                self.assertEqual(count, slower)
                self.assertIn(f"| {word} |", "\n".join(lines))

    def test_rows_of_one_side_are_counted(self):
        lines, count = compare.compare(self.rows(1.0, 1.0, 1.0), self.rows(9.0, 9.0, 9.0, ranks=2))
        self.assertEqual(count, 0)
        self.assertIn("0 rows have a row of before; 1 are new, 1 are gone", "\n".join(lines))


class FakeBackend:
    """Runs nothing; one case fails in its second run."""
    name = "local"

    def __init__(self):
        self.calls = []

    def oversubscribed(self, case):
        return False

    def run(self, case, path, limit):
        self.calls.append(case.layout)
        if case.ranks == 2 and self.calls.count(case.layout) == 3:
            raise RunError("exit code 1 from it\nthe log of it")
        return made_run(case.ranks, case.threads)


class Measuring(unittest.TestCase):
    def test_a_case_that_fails_in_the_middle(self):
        plan = plan_of(SMALL.replace("fixed rule", "rule").replace("repeats = 2", "repeats = 3"))
        backend = FakeBackend()
        with Workspace() as work:
            failures = measure.measure(plan, {"local": backend}, {"host": "h"}, work)
            runs, machine = record.read_runs([work / "runs.jsonl"])
        self.assertEqual(backend.calls, ["1 x 1", "2 x 1"] * 3 + ["1 x 1"], "in turns, but for the failed case")
        self.assertEqual([run["ranks"] for run in runs], [1, 2, 1, 1], "without the warm-ups")
        self.assertEqual(machine, {"host": "h"})
        self.assertEqual(len(failures), 1)
        self.assertIn("2 x 1: exit code 1", failures[0])

    def test_a_command_without_an_end(self):
        with Workspace() as work:
            script = "trap 'echo ended >ended; exit 1' TERM; sleep 60 & wait"
            with self.assertRaisesRegex(RunError, "no end after 0.5 s"):
                process.run_command(["bash", "-c", f"cd {work}; {script}"], work / "record.json", {}, 0.5)
            self.assertTrue((work / "ended").exists())

    def test_jobs_of_slurm(self):
        plan = plan_of(SMALL, backend="slurm")
        with Workspace() as work:
            text = slurm.job_script(list(enumerate(plan.cases))[::2], plan, "/bin/trime_mpi", work / "a b")
            (work / "job").write_text(text, encoding="utf-8")
            self.assertEqual(call("bash", "-n", work / "job").returncode, 0)
        self.assertIn("#SBATCH --ntasks=1\n", text)
        self.assertIn("turn < 3", text)
        self.assertIn("one 2 \"$turn\"", text)

    def test_records_of_jobs_are_collected(self):
        plan = plan_of(SMALL, backend="slurm")
        with Workspace() as work:
            place = work / "jobs"
            place.mkdir()
            slurm.write_plan(place, plan, {"1x1": "7"})
            (place / "0-1.exit").write_text("1 0.0 2.5", encoding="utf-8")
            (place / "0-1.log").write_text("broken", encoding="utf-8")
            messages = slurm.collect(work)
            self.assertEqual(len(messages), 4)
            self.assertRegex(messages[0], "exit code 1, log .*0-1.log\nbroken")
            self.assertIn("0 of 2 runs are done", messages[1])
            with self.assertRaisesRegex(RunError, "expected submitted jobs"):
                slurm.collect(work / "elsewhere")


class Command(unittest.TestCase):
    """The script itself."""

    def scaling(self, *arguments, work, **changes):
        done = call(SCRIPT, *arguments, MPLCONFIGDIR=str(work), **changes)
        self.assertNotIn("Traceback", done.stderr)
        return done

    def test_a_small_sweep_with_an_edge_length_in_its_config(self):
        with Workspace() as work:
            text = (ROOT / "configs" / "square.ini").read_text(encoding="utf-8")
            (work / "length.ini").write_text(text.replace("points = 5000", "edge_length = 0.02"), encoding="utf-8")
            (work / "s.ini").write_text(SMALL.replace("1x1 2x1", "1x1 2x1 1x64"), encoding="utf-8")
            done = self.scaling(work / "s.ini", "--config", work / "length.ini", "--stops", "rule", "--repeats", "1",
                                "--program", PROGRAM, "--output", work / "out", work=work)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            out = work / "out"
            with (out / "scaling.csv").open(encoding="utf-8") as stream:
                rows = list(csv.DictReader(stream))
            self.assertEqual([(row["ranks"], row["threads"]) for row in rows], [("1", "1"), ("2", "1"), ("1", "64")])
            self.assertEqual(len({row["mesh_hash"] for row in rows}), 1)
            if os.cpu_count() < 64:
                self.assertEqual(rows[2]["efficiency"], "", "more threads than cores: no efficiency")
            runs, machine = record.read_runs([out / "runs.jsonl"])
            self.assertEqual(len(runs), 3, "the warm-up is dropped")
            self.assertIn("processor", machine)
            for run in runs:
                parts = sum(phase["avg"] for phase in run["phases"].values())
                self.assertLessEqual(abs(parts - run["total_s"]), 0.1 * run["total_s"] + 0.02)
            self.assertIn("[6/6]", done.stderr)
            self.assertFalse((out / "work").exists())
            pictures = sorted(path.suffix for path in out.glob("small-1000-rule-time.*"))
            self.assertEqual(pictures, [".png", ".svg"] if os.cpu_count() > 1 else [])
            done = self.scaling("--read", out / "runs.jsonl", "--compare", out / "runs.jsonl", "--output", work / "b",
                                work=work)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("3 rows have a row of before; 0 are new, 0 are gone", done.stdout)

    def test_a_failed_run_has_exit_code_4(self):
        with Workspace() as work:
            (work / "s.ini").write_text(SMALL, encoding="utf-8")
            done = self.scaling(work / "s.ini", "--cases", "1x1", "--program", PROGRAM, "--output", work / "out",
                                "meshing.seed=x", work=work)
            self.assertEqual(done.returncode, 4)
            self.assertIn("exit code 2 from mpirun", done.stderr)
            self.assertFalse((work / "out" / "work").exists(), "left behind by a failure")

    def test_unequal_hashes_and_regressions_have_exit_codes(self):
        with Workspace() as work:
            def write(name, *runs):
                lines = [json.dumps({"line": "run"} | run) for run in runs]
                (work / name).write_text("\n".join(lines), encoding="utf-8")
                return work / name
            unequal = write("u.jsonl", made_run(), made_run(2, mesh_hash="b"))
            done = self.scaling("--read", unequal, "--output", work / "u", work=work)
            self.assertEqual(done.returncode, 4)
            self.assertIn("unequal meshes", done.stderr)
            self.assertTrue((work / "u" / "scaling.md").exists(), "the rows are kept")
            old, new = (write(name, *[made_run(seconds=s)] * 3) for name, s in (("o.jsonl", 1.0), ("n.jsonl", 2.0)))
            done = self.scaling("--read", new, "--compare", old, "--output", work / "c", work=work)
            self.assertEqual(done.returncode, 5)
            self.assertIn("1 got slower", done.stdout)

    def test_bad_use(self):
        with Workspace() as work:
            (work / "empty.ini").write_text("[harness]\n", encoding="utf-8")
            for arguments, code, expected in (
                    (["--backend", "cloud"], 2, "expected a backend out of local, slurm, simulated; found 'cloud'"),
                    (["--program", "/nowhere"], 2, "expected the program at /nowhere"),
                    (["--cases", "2"], 2, "found '2'"),
                    (["--points", "many"], 2, "found 'many'"),
                    ([work / "empty.ini"], 2, "an empty sweep"),
                    ([work / "no.ini"], 2, "no.ini"),
                    (["a.ini", "b.ini"], 2, "expected one ini"),
                    (["--read", work / "no.jsonl"], 4, "no.jsonl"),
                    (["--collect", work], 4, "expected submitted jobs")):
                with self.subTest(arguments=arguments):
                    done = self.scaling("--output", work / "out", *arguments, work=work)
                    self.assertEqual(done.returncode, code, done.stderr)
                    self.assertIn(expected, done.stderr)

    def test_no_slurm_and_no_simulator(self):
        with unittest.mock.patch("shutil.which", return_value=None), \
                self.assertRaisesRegex(UsageError, "no SLURM here"):
            slurm.submit(plan_of(SMALL, backend="slurm"), "/bin/true", ROOT, [])
        with unittest.mock.patch.object(simulated, "SCRIPT", ROOT / "none.sh"), \
                self.assertRaisesRegex(UsageError, "no simulator"):
            simulated.Simulated(None)


if __name__ == "__main__":
    unittest.main()
