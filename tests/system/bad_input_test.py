#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Bad input: the right exit code, one located message, and no file left behind; on 3 ranks for a case of each kind.

One rank reads and parses for all (config), all build the shape from the same text, and one rank writes: so a case of
each exit code, and each that is found later than the parsing, runs on 3 ranks as well."""
import os
import re
import unittest

from trime_run import Workspace, run

GOOD = """[domain]
x_min = 0
[shape]
region = part
[shape.part]
type = rectangle
x_min = 0.1
x_max = 0.9
y_min = 0.1
y_max = 0.9
[meshing]
method = distmesh
points = 500
"""
CIRCLE = "[shape.part]\ntype = circle\ncenter = {}\nradius = {}\n"
CONTOUR = "[shape.part]\ntype = contour\nfile = ring.xy\n"
RECTANGLE = GOOD[GOOD.index("[shape.part]"):GOOD.index("[meshing]")]
SQUARE = "0.2 0.2\n0.8 0.2\n0.8 0.8\n0.2 0.8\n"
USAGE, GEOMETRY, FILE = 2, 3, 4
ON_THREE_TOO = (1, 3)  # ranks


def line_of(text, fragment):
    """Line number, from 1, of the first line that holds the fragment."""
    return next(number for number, line in enumerate(text.splitlines(), 1) if fragment in line)


class BadInput(unittest.TestCase):
    """`expect` entries are regular expressions; each must match exactly one line of stderr."""

    def refused(self, config, code, expect, extra=(), files=None, name="case.ini", ranks_tried=(1,)):
        for ranks in ranks_tried:
            with self.subTest(ranks=ranks), Workspace() as work:
                if config is not None:
                    (work / name).write_text(config, encoding="utf-8")
                for path, text in (files or {}).items():
                    (work / path).write_text(text, encoding="utf-8")
                before = sorted(work.rglob("*"))
                place = [] if any("output.directory" in word for word in extra) else [f"output.directory={work}/result"]
                for mode in ([], ["--validate"]):  # both find the same
                    done = run(work / name, *place, *extra, *mode, ranks=ranks, cwd=work, timeout=60)
                    self.check(done, code, expect)
                left = [path for path in sorted(work.rglob("*")) if path not in before and path.is_file()]
                self.assertEqual(left, [], "files left behind")

    def check(self, done, code, expect):
        told = done.stdout + done.stderr
        self.assertEqual(done.returncode, code, told)
        for pattern in expect:
            lines = [line for line in done.stderr.splitlines() if re.search(pattern, line)]
            self.assertEqual(len(lines), 1, f"/{pattern}/ once in:\n{told}")
        self.assertNotRegex(told, r"MPI_ABORT|MPI_Abort|Segmentation|terminate called|Assertion|core dumped")

    def test_the_good_config_is_good(self):
        """Guards all tests below: what they change is the only thing wrong."""
        with Workspace() as work:
            (work / "case.ini").write_text(GOOD, encoding="utf-8")
            done = run(work / "case.ini", f"output.directory={work}/result", ranks=3)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    # The file itself

    def test_no_config_file(self):
        self.refused(None, FILE, [r"missing\.ini"], name="missing.ini", ranks_tried=ON_THREE_TOO)

    def test_unreadable_config_file(self):
        with Workspace() as work:
            for ranks in (1, 3):
                done = run(work, ranks=ranks, cwd=work)  # a directory: not even root can read it
                self.check(done, FILE, [re.escape(str(work))])
            if os.geteuid() != 0:
                (work / "locked.ini").write_text(GOOD, encoding="utf-8")
                (work / "locked.ini").chmod(0)
                self.check(run(work / "locked.ini", cwd=work), FILE, [r"locked\.ini.*[Pp]ermission"])

    def test_no_argument_at_all(self):
        done = run()
        self.assertEqual(done.returncode, USAGE, done.stdout + done.stderr)
        self.assertRegex(done.stderr, r"(?i)config")

    def test_a_contour_or_a_mesh_in_place_of_a_config(self):
        self.refused("0 0\n1 0\n1 1\n", USAGE, [r"coast\.xy: expected a config, found a contour.*file = "],
                     name="coast.xy", ranks_tried=ON_THREE_TOO)
        self.refused("", USAGE, [r"a\.h5: expected a config, found a mesh file.*trime_mpi info .*a\.h5"], name="a.h5")

    # Keys and values

    def test_unknown_section_key_and_value_all_at_once(self):
        text = GOOD.replace("method = distmesh", "method = distmash") + "sed = 3\n[siizing]\ntype = uniform\n"
        self.refused(text, USAGE, [
            rf"case\.ini:{line_of(text, 'distmash')}:.*distmash.*distmesh",
            rf"case\.ini:{line_of(text, 'sed =')}:.*'sed'.*\[meshing\].*'seed'",
            rf"case\.ini:{line_of(text, 'siizing')}:.*siizing.*sizing"], ranks_tried=ON_THREE_TOO)

    def test_checkpoints_that_nobody_can_keep(self):
        for key, extra in (("keep", "checkpoint.keep=0"), ("interval", "checkpoint.interval=-60"),
                           ("time-limit", "--time-limit=soon")):
            with self.subTest(key=key):
                self.refused(GOOD, USAGE, [rf"command line: .*{key}|{key}.*HH:MM:SS"], extra=[extra])

    def test_duplicate_key(self):
        text = GOOD + "points = 600\n"
        self.refused(text, USAGE, [rf"case\.ini:{len(text.splitlines())}:.*points"])

    def test_value_of_the_wrong_type(self):
        text = GOOD.replace("x_max = 0.9", "x_max = wide")
        self.refused(text, USAGE, [rf"case\.ini:{line_of(text, 'wide')}:.*x_max.*wide|wide.*x_max"])
        self.refused(GOOD.replace("x_max = 0.9", "x_max = nan"), USAGE, [r"case\.ini:8:.*x_max"])

    def test_bad_override(self):
        self.refused(GOOD, USAGE, [r"command line: .*pionts.*points"], extra=["meshing.pionts=3"])

    def test_both_or_neither_of_points_and_edge_length(self):
        self.refused(GOOD + "edge_length = 0.01\n", USAGE, [r"case\.ini.*points.*edge_length|edge_length.*points"])
        self.refused(GOOD.replace("points = 500\n", ""), USAGE, [r"case\.ini.*points.*edge_length"])

    def test_absurd_numbers_of_points(self):
        for value in ("0", "-5", "1e30", "99999999999999999999", "9000000000000000000", "1.5", ""):
            with self.subTest(points=value):
                self.refused(GOOD.replace("points = 500", f"points = {value}"), USAGE, [r"case\.ini:13:.*points"])
        for value in ("0", "-1", "1e-300", "inf"):
            with self.subTest(edge_length=value):
                text = GOOD.replace("points = 500", f"edge_length = {value}")
                self.refused(text, USAGE, [r"case\.ini.*edge_length"])

    def test_more_points_than_these_ranks_can_own(self):
        text = GOOD.replace("points = 500", "points = 1e10")
        self.refused(text, USAGE, [r"1e\+10 points are too many for 1 rank: .* start 6 or more"])
        self.refused(text, USAGE, [r"1e\+10 points are too many for 3 ranks: .* start 6 or more"], ranks_tried=(3,))

    def test_container_without_inside(self):
        self.refused(GOOD.replace("x_min = 0\n", "x_min = 2\n"), USAGE, [r"case\.ini.*x_m(in|ax)"])

    def test_container_beyond_double_precision(self):
        for value, expect in (("1e-31", r"x_max - x_min.*1e-30"), ("1e-300", r"x_max - x_min.*1e-30"),
                              ("1e31", r"x_max.*1e\+30"), ("1e308", r"x_max.*1e\+30")):
            with self.subTest(x_max=value):
                self.refused(GOOD.replace("x_min = 0\n", f"x_min = 0\nx_max = {value}\n"), USAGE,
                             [rf"case\.ini:3:.*{expect}"])

    def test_unknown_part_in_region(self):
        text = GOOD.replace("region = part", "region = difference(part, hool)")
        self.refused(text, USAGE, [rf"case\.ini:{line_of(text, 'hool')}:.*region.*hool|hool.*region"])
        for formula in ("difference(part", "union()", "difference(part)", "part part", "domaine"):
            with self.subTest(region=formula):
                self.refused(GOOD.replace("region = part", f"region = {formula}"), USAGE, [r"case\.ini:4:"])

    def test_bad_size_formulas(self):
        start = GOOD + "[sizing]\ntype = expression\n"
        line = len(start.splitlines()) + 1
        for formula in ("1+3*x+", "1+z", "(1+x", "x = 2", "1, 2"):
            with self.subTest(formula=formula):
                self.refused(start + f"expression = {formula}\n", USAGE,
                             [rf"case\.ini:{line}: 'expression' in \[sizing\]: "])
        for formula in ("x-0.5", "1/(x-x)", "sqrt(-1-x)", "0"):
            with self.subTest(formula=formula):
                self.refused(start + f"expression = {formula}\n", USAGE,
                             [rf"case\.ini:{line}: 'expression' in \[sizing\]: .*positive"],
                             ranks_tried=ON_THREE_TOO if formula == "x-0.5" else (1,))
        self.refused(start, USAGE, [rf"case\.ini:{line - 1}: .*needs 'expression'"])
        self.refused(start + "expression = 1+x\n", USAGE, [rf"case\.ini:{line}: .*both sides of the periodic"],
                     extra=["domain.periodic_x=true"], ranks_tried=ON_THREE_TOO)
        self.refused(GOOD, USAGE, [r"gradation.*from 0 to 2"],
                     extra=["sizing.type=automatic", "sizing.gradation=10"])
        self.refused(GOOD, USAGE, [r"command line: .*min_size <= max_size"],
                     extra=["sizing.min_size=0.2", "sizing.max_size=0.1"])

    # Shapes

    def test_shape_outside_of_the_container(self):
        for name, centre in (("outside", "5 5"), ("partly", "0.9 0.5")):
            with self.subTest(shape=name):
                text = GOOD.replace(RECTANGLE, CIRCLE.format(centre, 0.3))
                self.refused(text, GEOMETRY, [r"(?i)container|domain"],
                             ranks_tried=ON_THREE_TOO if name == "partly" else (1,))

    def test_empty_shape(self):
        text = GOOD.replace("region = part", "region = difference(part, part)")
        self.refused(text, GEOMETRY, [r"(?i)empty|nothing"], ranks_tried=ON_THREE_TOO)
        text = GOOD.replace("region = part", "region = intersection(part, far)") + \
            "[shape.far]\ntype = circle\ncenter = 0.05 0.05\nradius = 0.01\n"
        self.refused(text, GEOMETRY, [r"(?i)empty|nothing"])

    def test_degenerate_parts(self):
        self.refused(GOOD.replace(RECTANGLE, CIRCLE.format("0.5 0.5", 0)), USAGE, [r"case\.ini:\d+:.*radius"])
        self.refused(GOOD.replace("x_max = 0.9", "x_max = 0.1"), USAGE, [r"case\.ini.*x_m(in|ax)"])

    def test_bad_contours(self):
        text = GOOD.replace(RECTANGLE, CONTOUR)
        cases = {
            "crosses itself": ("0.2 0.2\n0.8 0.8\n0.8 0.2\n0.2 0.8\n", GEOMETRY, [r"ring\.xy.*0\.5"]),
            "nan": ("0.2 0.2\n0.8 nan\n0.8 0.8\n", GEOMETRY, [r"ring\.xy:2:"]),
            "two vertices": ("0.2 0.2\n0.8 0.2\n", GEOMETRY, [r"ring\.xy:1:.*3"]),
            "no number": ("0.2 0.2\n0.8 b\n0.8 0.8\n", GEOMETRY, [r"ring\.xy:2:"]),
            "three columns": ("0.2 0.2 0\n0.8 0.2 0\n0.8 0.8 0\n", GEOMETRY, [r"ring\.xy:1:"]),
            "all on one point": ("0.2 0.2\n" * 4, GEOMETRY, [r"ring\.xy"]),
            "all on one line": ("0.2 0.2\n0.5 0.5\n0.8 0.8\n", GEOMETRY, [r"ring\.xy"]),
            "empty file": ("", GEOMETRY, [r"ring\.xy"]),
            "two rings that cross": (SQUARE + "\n" + SQUARE.replace("0.8", "0.9").replace("0.2", "0.4"), GEOMETRY,
                                     [r"ring\.xy"]),
        }
        for name, (ring, code, expect) in cases.items():
            with self.subTest(contour=name):
                self.refused(text, code, expect, files={"ring.xy": ring},
                             ranks_tried=ON_THREE_TOO if name == "crosses itself" else (1,))

    def test_missing_contour_file(self):
        self.refused(GOOD.replace(RECTANGLE, CONTOUR), FILE, [r"ring\.xy.*relative to the config file"],
                     ranks_tried=ON_THREE_TOO)

    # Output

    def test_output_exists(self):
        with Workspace() as work:
            (work / "case.ini").write_text(GOOD, encoding="utf-8")
            (work / "case.h5").write_text("precious", encoding="utf-8")
            for ranks in (1, 3):
                done = run(work / "case.ini", f"output.directory={work}", ranks=ranks)
                self.check(done, FILE, [r"case\.h5.*overwrite"])
                self.check(run(work / "case.ini", f"output.directory={work}", "--validate", ranks=ranks), FILE,
                           [r"case\.h5.*overwrite"])
            self.assertEqual((work / "case.h5").read_text(encoding="utf-8"), "precious")
            self.assertEqual(sorted(path.name for path in work.iterdir()), ["case.h5", "case.ini"])
            done = run(work / "case.ini", f"output.directory={work}", "output.overwrite=true")
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_output_directory_cannot_be_written(self):
        self.refused(GOOD, FILE, [r"/dev/null/result"], extra=["output.directory=/dev/null/result"],
                     ranks_tried=ON_THREE_TOO)
        if os.geteuid() != 0:
            self.refused(GOOD, FILE, [r"/proc/result|[Pp]ermission"], extra=["output.directory=/proc/result"])


if __name__ == "__main__":
    unittest.main()
