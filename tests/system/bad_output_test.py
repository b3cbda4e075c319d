#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests outputs in places where a file cannot or must not be.

The program reports such a place before the run, and changes nothing that lies there.
"""
import itertools
import json
import os
import unittest

from bad_input_test import CONTOUR, FILE, GOOD, RECTANGLE, SQUARE, USAGE, Row, problem_of, rows_of, tried
from trime_run import Workspace, run


class Rows:
    def names_that_are_too_long(self):
        """Only the file system reported some of them, after the run."""
        for name in ("x" * 163, "x" * 200, "x" * 250):
            yield Row(GOOD, USAGE, [rf"name = x+.*' in \[output\]: expected at most 162 bytes, found {len(name)}\."],
                      extra=[f"output.name={name}", "output.formats=text"])
        for path in ("d" * 300, "a/" + "d" * 256 + "/b", "d/" * 2000):
            yield Row(GOOD, FILE, [r"cannot make the output directory .*expected .* set output\.directory"],
                      extra=[f"output.directory={path}"])
        for path in ("r" * 300, "r" * 214, "r" * 256 + "/r"):
            yield Row(GOOD, FILE, [r"the report r+\.\.\. cannot be written: expected names of at most \d+ bytes"],
                      extra=["--report", path], modes=([],))

    def stop_files_that_are_something_else(self):
        """The run would remove them."""
        stop = "checkpoint.stop_file={}".format
        yield Row(GOOD, FILE, [r"stop_file = \.' .*found a directory"], extra=[stop(".")])
        for path in ("case.ini", "./result/../case.ini"):
            yield Row(GOOD, USAGE, [rf"stop_file = {path}' .* is the config"], extra=[stop(path)])
        for name in ("case.h5", "case.xmf", "case_series.xdmf", "case_step_000012.h5", "case.checkpoint-7.h5",
                     "case/case_final_xy_id.txt", "case/case_tria_quality_stat_overall.txt", "case.ele",
                     "report"):
            yield Row(GOOD, USAGE, [rf"stop_file = .*{name}' .* is an output of the run"],
                      extra=[stop("result/../result/" + name), "output.formats=vtkhdf text triangle",
                             "--report=result/report"],
                      modes=([],))
        yield Row(GOOD.replace(RECTANGLE, CONTOUR), USAGE, [r"stop_file = ring\.xy' .* is an input of the run"],
                  files={"ring.xy": SQUARE}, extra=[stop("ring.xy")])
        yield Row(GOOD, USAGE, [r"stop_file = p\.xy' .* is an input of the run"], files={"p.xy": "0.5 0.5\n"},
                  extra=[stop("p.xy"), "meshing.fixed_points=p.xy"])

    def inputs_that_would_be_replaced(self):
        """Even where the user lets the run replace files."""
        here = ["output.directory=.", "output.overwrite=true"]
        clash = r"{} is an input of the run, and an output of the run has the same path; set output\.name".format
        ring = json.dumps({"type": "Polygon", "coordinates": [[[0.1, 0.1], [0.9, 0.1], [0.5, 0.9], [0.1, 0.1]]]})
        config = GOOD.replace(RECTANGLE, CONTOUR.replace("ring.xy", "case.geojson"))
        yield Row(config, USAGE, [clash(r"case\.geojson")], files={"case.geojson": ring},
                  extra=[*here, "output.formats=geojson"])
        yield Row(GOOD, USAGE, [clash(r"case\.vtu")], files={"case.vtu": "0.5 0.5\n"},
                  extra=[*here, "output.formats=vtu", "meshing.fixed_points=./case.vtu"])
        for extra in ([], ["output.interval=0"]):
            yield Row(GOOD, USAGE, [r"'--report case\.ini' is the config; choose a name"],
                      extra=["--report=case.ini", *extra], modes=([],))
        yield Row(GOOD, USAGE, [r"'--report \./case\.h5' is another output of the run"],
                  extra=["output.directory=.", "--report=./case.h5"], modes=([],))


class BadOutput(unittest.TestCase):
    def test_table(self):
        for row, problem in tried(rows_of(Rows())):
            with self.subTest(row=row):
                self.assertIsNone(problem, problem)

    def test_pipes_and_links_are_refused_and_stay(self):
        """A file that gets its name by rename would replace them, and HDF5 would wait for a writer without end."""
        with Workspace() as work:
            (work / "case.ini").write_text(GOOD, encoding="utf-8")
            pipe, link, lost = work / "pipe.h5", work / "link", work / "lost"
            outputs = [work / "result" / ("case" + ending) for ending in (".h5", ".xdmf", ".vtkhdf", ".xmf", ".msh")]
            (work / "result").mkdir()
            for path in (pipe, work / "pipe.msh", *outputs):
                os.mkfifo(path)
            link.symlink_to("case.ini")
            lost.symlink_to("nothing")
            (work / "to_pipe").symlink_to(pipe)
            meshes = [work / "case.ini", f"output.directory={work}/other", "output.overwrite=true"]
            commands = [([*meshes, "--report", pipe], r"pipe\.h5 is a named pipe"),
                        ([*meshes, "--report", work / "to_pipe"], r"to_pipe is a named pipe"),
                        ([*meshes, "--report", link], r"link is a link"),
                        ([*meshes, "--report", lost], r"lost is a link"),
                        ([*meshes, f"checkpoint.stop_file={pipe}"], r"stop_file.*pipe\.h5'.*found a named pipe"),
                        ([*meshes, "--restart", pipe], r"pipe\.h5: expected a file.*named pipe"),
                        (["info", pipe], r"pipe\.h5: expected a file.*named pipe"),
                        (["convert", work / "case.ini", work / ("x" * 300 + ".msh")], r"expected names of at most 213"),
                        (["info", work / ("x" * 300)], r"cannot open .*too long"),
                        (["info", work], r"expected a file.*a directory"),
                        (["convert", pipe, work / "a.msh"], r"pipe\.h5: expected a file.*named pipe"),
                        (["convert", pipe, work / "pipe.msh", "--overwrite"], r"pipe\.msh is a named pipe")]
            for (words, expect), ranks in itertools.product(commands, (1, 3)):
                with self.subTest(words=words, ranks=ranks):
                    self.assertIsNone(problem_of(run(*words, ranks=ranks, cwd=work, timeout=60), FILE, [expect]))
            for path, mode in itertools.product(outputs, ([], ["--validate"])):
                for other in outputs:
                    other.unlink(missing_ok=True)
                os.mkfifo(path)
                with self.subTest(output=path.name, mode=mode):
                    done = run(work / "case.ini", f"output.directory={work}/result", "output.overwrite=true",
                               "output.formats=vtkhdf xdmf gmsh", *mode, timeout=60)
                    self.assertIsNone(problem_of(done, FILE, [rf"case\{path.suffix} is a named pipe"]))
                    self.assertTrue(path.is_fifo())
            self.assertTrue(pipe.is_fifo() and (work / "pipe.msh").is_fifo())
            self.assertTrue(link.is_symlink() and lost.is_symlink())
            self.assertEqual((work / "case.ini").read_text(encoding="utf-8"), GOOD)

    def test_the_longest_name(self):
        """All files of a run have it in their names."""
        with Workspace() as work:
            (work / "case.ini").write_text(GOOD, encoding="utf-8")
            done = run(work / "case.ini", f"output.directory={work}/result", "output.name=" + "x" * 162,
                       "output.interval=5",
                       "output.formats=vtkhdf xdmf text gmsh triangle geojson", "checkpoint.interval=1e-9", ranks=2)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            self.assertNotIn("checkpoint failed", done.stdout + done.stderr)


if __name__ == "__main__":
    unittest.main()
