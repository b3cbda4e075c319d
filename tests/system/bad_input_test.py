#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests bad input on 1 and 3 ranks: the exit code is right, one message names the place, and no file stays behind.

Each row of the table is a config, and what is wrong with it. A start of the program mostly waits, so several rows run
at the same time.
"""
import concurrent.futures
import dataclasses
import inspect
import os
import re
import unittest

from trime_run import Workspace, run

GOOD = """[domain]
x_min = 0
[shape]
geometry = part
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
AT_ONCE = 6  # rows
FEWEST_ROWS = 100


def line_of(text, fragment):
    """Line number, from 1, of the first line that holds the fragment."""
    return next(number for number, line in enumerate(text.splitlines(), 1) if fragment in line)


@dataclasses.dataclass
class Row:
    """`expect` entries are regular expressions; each must match exactly one line of stderr."""
    config: str | None
    code: int
    expect: list
    extra: tuple = ()
    files: dict = dataclasses.field(default_factory=dict)
    name: str = "case.ini"
    ranks_tried: tuple = (1, 3)
    modes: tuple = ([], ["--validate"])  # find the same; all on the first number of ranks

    def problem(self):
        """What is not as it should be, or nothing."""
        with Workspace() as work:
            if self.config is not None:
                (work / self.name).write_text(self.config, encoding="utf-8")
            for path, text in self.files.items():
                (work / path).write_text(text, encoding="utf-8")
            before = sorted(work.rglob("*"))
            is_placed = any("output.directory" in word for word in self.extra)
            place = [] if is_placed else [f"output.directory={work}/result"]
            for ranks in self.ranks_tried:
                for mode in self.modes if ranks == self.ranks_tried[0] else self.modes[:1]:
                    done = run(work / self.name, *place, *self.extra, *mode, ranks=ranks, cwd=work, timeout=300)
                    if problem := problem_of(done, self.code, self.expect):
                        return f"{ranks} ranks {mode}: {problem}"
            left = [path for path in sorted(work.rglob("*")) if path not in before
                    and (path.is_file() or any(word.startswith("--restart") for word in self.extra))]
        return f"files left behind: {left}" if left else None


def problem_of(done, code, expect):
    """What is wrong about a run, or nothing."""
    told = done.stdout + done.stderr
    if done.returncode != code:
        return f"expected exit code {code}, found {done.returncode}:\n{told}"
    for pattern in expect:
        if len([line for line in done.stderr.splitlines() if re.search(pattern, line)]) != 1:
            return f"expected /{pattern}/ once in:\n{told}"
    if re.search(r"MPI_ABORT|MPI_Abort|Segmentation|terminate called|Assertion|core dumped", told):
        return f"expected an end in order:\n{told}"
    return None


def rows_of(makers):
    return [row for _, make in inspect.getmembers(makers, inspect.ismethod) for row in make()]


def tried(rows):
    """Each row with its problem, if it has one."""
    with concurrent.futures.ThreadPoolExecutor(AT_ONCE) as pool:
        yield from zip(rows, pool.map(Row.problem, rows))


# Values that a key of the good config cannot have.
BAD_VALUES = """
meshing.method=fast  meshing.seed=-1  meshing.seed=1e300  meshing.max_sweeps=1e9  meshing.corner_angle=200
meshing.corner_angle=0  meshing.feature_tolerance=0.5  meshing.simplify_within=2  meshing.initial_fraction=0
meshing.connect=join  meshing.components=biggest  meshing.max_loss=1.1  meshing.max_loss=-0.1
meshing.initial_fraction=1.1  meshing.narrow=open  meshing.keep_features=please  meshing.refine_narrow=0.5
meshing.worst_alpha=0.5  meshing.stop_tolerance=0  meshing.cleanup=never
domain.periodic_x=maybe  domain.cells_x=0  domain.cells_y=2.5  domain.x_max=left
parallel.mesh_threads=5000  parallel.setup_threads=-2  output.interval=-3  output.overwrite=perhaps
output.coordinates=metres
log.level=loud  log.interval=-1  sizing.type=smooth  sizing.min_size=0  sizing.max_size=-1  shape.part.type=blob
""".split()
# Other words of the command line, and what the message holds.
BAD_WORDS = [
    ("meshing.fixed_points_normalize_with=part", r"fixed_points_normalize_with"), ("output.formats=vtkhdf stl", r"stl"),
    ("output.name=a/b", r"name.*a/b"), ("shape.part.colour=red", r"'colour'"),
    ("shape.part.radius=1", r"radius.*circle"), ("shape.part.x_min=0.95", r"x_min < x_max"),
    ("shape.union.type=circle", r"'union' cannot name a part"), ("shape.9.type=circle", r"'9' cannot name a part"),
    ("shape.projection=auto", r"projection.*contours"), ("nonsense", r"section\.key=value"),
    ("meshing=3", r"section\.key=value"), ("=4", r"section\.key=value"), ("--frobnicate", r"(?i)frobnicate"),
]


class Rows:
    """Each method yields rows of its kind."""

    def no_config_file(self):
        yield Row(None, FILE, [r"missing\.ini"], name="missing.ini")

    def a_contour_or_a_mesh_in_place_of_a_config(self):
        yield Row("0 0\n1 0\n1 1\n", USAGE, [r"coast\.xy: expected a config, found a contour.*file = "],
                  name="coast.xy")
        yield Row("", USAGE, [r"a\.h5: expected a config, found a mesh file.*trime_mpi info .*a\.h5"], name="a.h5")

    def bad_values(self):
        for word in BAD_VALUES:
            section, key, value = re.fullmatch(r"(.*)\.(\w+)=(.*)", word).groups()
            yield Row(GOOD, USAGE, [rf"command line: '{key} = {value}' in \[{section}\]: expected "], extra=(word,))

    def bad_words(self):
        for word, expect in BAD_WORDS:
            yield Row(GOOD, USAGE, [expect], extra=(word,))

    def missing_files(self):
        yield Row(GOOD, FILE, [r"points\.xy.*relative to the config file"], extra=("meshing.fixed_points=points.xy",))
        yield Row(GOOD, FILE, [r"/dev/null/report"], extra=("--report=/dev/null/report",), modes=([],))
        for path in ("gone.h5", "."):
            yield Row(GOOD, FILE, [rf"{path}: .*--restart auto.*case\.checkpoint-K\.h5"], extra=(f"--restart={path}",),
                      modes=([],))

    def bad_fixed_points(self):
        for text, expect in (("0.5 0.5\n2 2\n", r"points\.xy:2:.*outside"), ("0.5\n", r"points\.xy:1:"),
                             ("", r"points\.xy.*none"), ("0.05 0.5\n", r"points\.xy:1:.*outside the shape")):
            yield Row(GOOD, GEOMETRY, [expect], files={"points.xy": text}, extra=("meshing.fixed_points=points.xy",))

    def components_that_cannot_be_chosen(self):
        yield Row(GOOD, GEOMETRY, [r"meshing\.components = at: .*\(5, 5\).*outside of the shape"],
                  extra=("meshing.components=at 5 5",))
        for text in ("at 0.5", "at 0.5 high", "at 0.5 0.5 0.5", "at nan 0", "largest 3"):
            yield Row(GOOD, USAGE, [r"'components = .*' in \[meshing\]: expected all, largest or 'at X Y'"],
                      extra=(f"meshing.components={text}",))

    def unknown_section_key_and_value_all_at_once(self):
        text = GOOD.replace("method = distmesh", "method = distmash") + "sed = 3\n[siizing]\ntype = uniform\n"
        yield Row(text, USAGE, [
            rf"case\.ini:{line_of(text, 'distmash')}:.*distmash.*distmesh",
            rf"case\.ini:{line_of(text, 'sed =')}:.*'sed'.*\[meshing\].*'seed'",
            rf"case\.ini:{line_of(text, 'siizing')}:.*siizing.*sizing"])

    def checkpoints_that_nobody_can_keep(self):
        for key, extra in (("keep", "checkpoint.keep=0"), ("interval", "checkpoint.interval=-60"),
                           ("time-limit", "--time-limit=soon")):
            yield Row(GOOD, USAGE, [rf"command line: .*{key}|{key}.*HH:MM:SS"], extra=[extra])

    def texts_of_a_megabyte(self):
        """Each line of the message is short."""
        long = "x" * 10**6
        short = r"^(?=.{1,1200}$)trime_mpi: error: .*case\.ini.*"
        yield Row(GOOD + long + " = 1\n", USAGE, [short + r"unknown key 'x+\.\.\.' in \[meshing\]"])
        for text in (GOOD.replace("points = 500", "points = " + long), GOOD + f"[{long}]\n", GOOD + f"[shape.{long}\n",
                     GOOD + f"[shape.{long}]\n", GOOD.replace("geometry = part", "geometry = " + long),
                     GOOD.replace("geometry = part", "geometry = " + "union(part, " * 60000 + "part" + ")" * 60000),
                     GOOD + f"fixed_points = p.xy\nfixed_points_normalize_with = {long}\n", GOOD + f"{long} =\n",
                     GOOD + f"[sizing]\ntype = expression\nexpression = {'1+' * 3000}\n"):
            yield Row(text, USAGE, [short])

    def duplicate_key(self):
        text = GOOD + "points = 600\n"
        yield Row(text, USAGE, [rf"case\.ini:{len(text.splitlines())}:.*points"])

    def value_of_the_wrong_type(self):
        text = GOOD.replace("x_max = 0.9", "x_max = wide")
        yield Row(text, USAGE, [rf"case\.ini:{line_of(text, 'wide')}:.*x_max.*wide|wide.*x_max"])
        yield Row(GOOD.replace("x_max = 0.9", "x_max = nan"), USAGE, [r"case\.ini:8:.*x_max"])

    def bad_override(self):
        yield Row(GOOD, USAGE, [r"command line: .*pionts.*points"], extra=["meshing.pionts=3"])

    def both_or_neither_of_points_and_edge_length(self):
        yield Row(GOOD + "edge_length = 0.01\n", USAGE, [r"case\.ini.*points.*edge_length|edge_length.*points"])
        yield Row(GOOD.replace("points = 500\n", ""), USAGE, [r"case\.ini.*points.*edge_length"])

    def absurd_numbers_of_points(self):
        for value in ("0", "-5", "1e30", "99999999999999999999", "9000000000000000000", "1.5", ""):
            yield Row(GOOD.replace("points = 500", f"points = {value}"), USAGE, [r"case\.ini:13:.*points"])
        for value in ("0", "-1", "1e-300", "inf"):
            text = GOOD.replace("points = 500", f"edge_length = {value}")
            yield Row(text, USAGE, [r"case\.ini.*edge_length"])

    def more_points_than_these_ranks_can_own(self):
        text = GOOD.replace("points = 500", "points = 1e10")
        yield Row(text, USAGE, [r"1e\+10 points are too many for 1 rank: .* start at least 6 ranks"], ranks_tried=(1,))
        yield Row(text, USAGE, [r"1e\+10 points are too many for 3 ranks: .* start at least 6 ranks"], ranks_tried=(3,))

    def container_without_inside(self):
        yield Row(GOOD.replace("x_min = 0\n", "x_min = 2\n"), USAGE, [r"case\.ini.*x_m(in|ax)"])

    def container_beyond_double_precision(self):
        for value, expect in (("1e-31", r"x_max - x_min.*1e-30"), ("1e-300", r"x_max - x_min.*1e-30"),
                              ("1e31", r"x_max.*1e\+30"), ("1e308", r"x_max.*1e\+30")):
            yield Row(GOOD.replace("x_min = 0\n", f"x_min = 0\nx_max = {value}\n"), USAGE,
                      [rf"case\.ini:3:.*{expect}"])

    def container_with_a_side_below_the_resolution(self):
        for value in ("1e30", "1e-29"):
            yield Row(GOOD.replace("x_min = 0\n", f"x_min = 0\nx_max = {value}\n"), USAGE,
                      [r"case\.ini:3: \[domain\] has the sides .* set x_min, x_max, y_min and y_max around the shape"])

    def sizes_that_no_number_of_points_reaches(self):
        yield Row(GOOD, USAGE, [r"max_size = 1e-300: expected more points than numbers can express"],
                  extra=["sizing.max_size=1e-300"], modes=([],))

    def unknown_part_in_region(self):
        text = GOOD.replace("geometry = part", "geometry = difference(part, hool)")
        yield Row(text, USAGE, [rf"case\.ini:{line_of(text, 'hool')}:.*geometry.*hool|hool.*geometry"])
        for formula in ("difference(part", "union()", "difference(part)", "part part", "domaine"):
            yield Row(GOOD.replace("geometry = part", f"geometry = {formula}"), USAGE, [r"case\.ini:4:"])

    def bad_size_formulas(self):
        start = GOOD + "[sizing]\ntype = expression\n"
        line = len(start.splitlines()) + 1
        for formula in ("1+3*x+", "1+z", "(1+x", "x = 2", "1, 2"):
            yield Row(start + f"expression = {formula}\n", USAGE,
                      [rf"case\.ini:{line}: 'expression' in \[sizing\]: "])
        for formula in ("x-0.5", "1/(x-x)", "sqrt(-1-x)", "0"):
            yield Row(start + f"expression = {formula}\n", USAGE,
                      [rf"case\.ini:{line}: 'expression' in \[sizing\]: .*positive"])
        yield Row(start, USAGE, [rf"case\.ini:{line - 1}: .*needs 'expression'"])
        yield Row(start + "expression = 1+x\n", USAGE, [rf"case\.ini:{line}: .*both sides of the periodic"],
                  extra=["domain.periodic_x=true"])
        yield Row(GOOD, USAGE, [r"gradation.*from 0 to 2"],
                  extra=["sizing.type=automatic", "sizing.gradation=10"])
        yield Row(GOOD, USAGE, [r"command line: .*min_size <= max_size"],
                  extra=["sizing.min_size=0.2", "sizing.max_size=0.1"])

    def shape_outside_of_the_container(self):
        for centre in ("5 5", "0.9 0.5"):  # outside, partly
            text = GOOD.replace(RECTANGLE, CIRCLE.format(centre, 0.3))
            yield Row(text, GEOMETRY, [r"(?i)container|domain"])

    def empty_shape(self):
        text = GOOD.replace("geometry = part", "geometry = difference(part, part)")
        yield Row(text, GEOMETRY, [r"(?i)empty|nothing"])
        text = GOOD.replace("geometry = part", "geometry = intersection(part, far)") + \
            "[shape.far]\ntype = circle\ncenter = 0.05 0.05\nradius = 0.01\n"
        yield Row(text, GEOMETRY, [r"(?i)empty|nothing"])

    def degenerate_parts(self):
        yield Row(GOOD.replace(RECTANGLE, CIRCLE.format("0.5 0.5", 0)), USAGE, [r"case\.ini:\d+:.*radius"])
        yield Row(GOOD.replace("x_max = 0.9", "x_max = 0.1"), USAGE, [r"case\.ini.*x_m(in|ax)"])

    def bad_contours(self):
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
        for ring, code, expect in cases.values():
            yield Row(text, code, expect, files={"ring.xy": ring})

    def missing_contour_file(self):
        yield Row(GOOD.replace(RECTANGLE, CONTOUR), FILE,
                  [r"ring\.xy.*'file' in \[shape\.[a-z]+\] \(relative to the config file"])

    def output_directory_cannot_be_written(self):
        yield Row(GOOD, FILE, [r"/dev/null/result"], extra=["output.directory=/dev/null/result"])
        if os.geteuid() != 0:
            yield Row(GOOD, FILE, [r"/proc/result|[Pp]ermission"], extra=["output.directory=/proc/result"])


class BadInput(unittest.TestCase):
    def check(self, done, code, expect):
        self.assertIsNone(problem_of(done, code, expect))

    def test_table(self):
        rows = rows_of(Rows())
        print(f"{len(rows)} bad inputs", flush=True)
        self.assertGreaterEqual(len(rows), FEWEST_ROWS)
        for row, problem in tried(rows):
            with self.subTest(row=row):
                self.assertIsNone(problem, problem)

    def test_the_good_config_is_good(self):
        """Guards all tests below: what they change is the only thing wrong."""
        with Workspace() as work:
            (work / "case.ini").write_text(GOOD, encoding="utf-8")
            done = run(work / "case.ini", f"output.directory={work}/result", ranks=3)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

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

    def test_more_threads_than_a_machine_has(self):
        """They took 1.4 GB, or ended the run where the system starts no more of them."""
        with Workspace() as work:
            (work / "case.ini").write_text(GOOD, encoding="utf-8")
            done = run(work / "case.ini", f"output.directory={work}/result", "parallel.mesh_threads=4096", timeout=300)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            self.assertRegex(done.stdout + done.stderr,
                             r"warning: 4096 threads were requested, but a rank uses only \d+:")

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


if __name__ == "__main__":
    unittest.main()
