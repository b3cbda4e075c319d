#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests what a run prints: one live line on a terminal, a summary at the end, rows of a table with --verbose, and only
warnings with --quiet.
"""
import fcntl
import json
import os
import pty
import re
import signal
import struct
import subprocess
import termios
import unittest

from trime_run import ROOT, Workspace, command, environment, run

CONFIG = ROOT / "configs" / "spade.ini"
ERASE = "\r\x1b[K"
ROW = re.compile(r"^ *(\d+) +(\d+) +(\d+) +1\.\d{5} +1\.\d{5} +\d\S+ +\d+\.\d\d +\d\.\d{3} +\d+ +\d+\.\d\d$")


def arguments(work, *more):
    return [CONFIG, "meshing.points=5000", f"output.directory={work}", "output.overwrite=true", *more]


def read_all(terminal, at_live_line):
    """All that was written to a pseudo-terminal; its reading end fails where the writers have gone. Calls
    at_live_line() once the live line has appeared."""
    text = b""
    while True:
        try:
            part = os.read(terminal, 1 << 16)
        except OSError:
            break
        if not part:
            break
        is_first = ERASE.encode() not in text
        text += part
        if is_first and ERASE.encode() in text:
            at_live_line()
    return text.decode()


def run_on_terminal(given, ranks=1, columns=100, kind="xterm", interrupt=False):
    """Returns the exit code and the output of a run on a terminal with this number of columns. With `interrupt` the
    run gets a SIGINT when its live line appears: from then on the program catches it, however busy the machine is."""
    mine, its = pty.openpty()
    fcntl.ioctl(its, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))
    with subprocess.Popen(command(given, ranks), env=environment(1) | {"TERM": kind}, stdin=subprocess.DEVNULL,
                          stdout=its, stderr=its) as process:
        os.close(its)
        text = read_all(mine, lambda: process.send_signal(signal.SIGINT) if interrupt else None)
        os.close(mine)
        return process.wait(120), text


def shown(text):
    """The lines that remain on the screen: what stood before an erasure is gone."""
    return [line.rsplit(ERASE, 1)[-1].rstrip("\r") for line in text.split("\n")]


def rows(text):
    """The rows of the table of sweeps as (sweep, stage)."""
    return [(int(found[1]), int(found[2])) for found in map(ROW.match, shown(text)) if found]


class Progress(unittest.TestCase):
    def test_one_live_line_on_a_terminal(self):
        for ranks in (1, 2):
            with self.subTest(ranks=ranks), Workspace() as work:
                code, text = run_on_terminal(arguments(work, "meshing.points=20000"), ranks)
                self.assertEqual(code, 0, text)
                live = [part.split("\n")[0].rstrip("\r") for part in text.split(ERASE)[1:]]
                self.assertTrue(any(re.match(r"sweeps: sweep \d+, alpha median 1\.\d{4}, max \S+, \d+\.\d % move", line)
                                    for line in live), text)
                self.assertTrue(any(line.endswith(" left") for line in live), live)
                for phase in ("shape", "size field", "clean-up", "certificate", "output"):
                    self.assertTrue(any(line.startswith(phase) for line in live), phase)
                # Nothing of it stays, and no message stands behind it in a line.
                self.assertEqual([line for line in shown(text) if " % move" in line or line == "certificate"], [])
                self.assertTrue(any(line.startswith("Checks ") for line in shown(text)), text)
                self.assertEqual(rows(text), [])

    def test_the_line_fits_into_the_window(self):
        with Workspace() as work:
            code, text = run_on_terminal(arguments(work), columns=30)
            self.assertEqual(code, 0)
            live = [re.split(r"[\r\n]", part)[0] for part in text.split(ERASE)[1:]]
            drawn = [line for line in live if line.startswith("sweeps")]
            self.assertTrue(drawn)
            self.assertLessEqual(max(map(len, drawn)), 29)

    def test_rows_above_the_line_if_the_config_asks(self):
        with Workspace() as work:
            code, text = run_on_terminal(arguments(work, "log.interval=10"))
            self.assertEqual(code, 0)
            self.assertGreater(len(rows(text)), 5)
            self.assertIn(ERASE, text)

    def test_sparse_rows_in_a_log(self):
        with Workspace() as work:
            done = run(*arguments(work, "--verbose"), ranks=2)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertNotIn("\r", done.stdout)
            self.assertNotIn("\x1b", done.stdout)
            found = rows(done.stdout)
            self.assertEqual([sweep for sweep, _ in found[:6]], [0, 3, 6, 12, 21, 51])
            self.assertEqual({stage for _, stage in found}, {0, 1}, "each stage shows its start")
            self.assertEqual(done.stdout.count("alpha: median"), 1)
            widths = {len(line) for line in done.stdout.split("\n") if ROW.match(line)}
            self.assertEqual(len(widths), 1, "columns stand")
            code, text = run_on_terminal(arguments(work), kind="dumb")
            self.assertEqual((code, text.count("\x1b")), (0, 0))

    def test_a_summary_without_rows_in_a_log(self):
        """At most 20 lines, each of one fact, and the numbers are those of the JSON report."""
        for ranks in (1, 2):
            with self.subTest(ranks=ranks), Workspace() as work:
                done = run(*arguments(work, "--report", work / "r.json"), ranks=ranks)
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                lines = [line for line in done.stdout.splitlines() if not line.startswith("warning: ")]
                self.assertLessEqual(len(lines), 20, done.stdout)
                self.assertEqual(rows(done.stdout), [])
                words = [line[:11].strip() for line in lines]
                self.assertEqual(len(set(words)), len(words), "each fact once")
                facts = {line[:11].strip(): line[11:] for line in lines}
                report = json.loads((work / "r.json").read_text(encoding="utf-8"))
                attributes, checks = report["attributes"], report["groups"]["checks"]["columns"]["passed"]
                self.assertEqual(facts["Mesh hash"], attributes["mesh_hash_hex"])
                self.assertEqual(facts["Checks"], f"{len(checks)} of {len(checks)} passed")
                self.assertIn(f"{attributes['points']} points, {attributes['triangles']} triangles, ", facts["Mesh"])
                self.assertIn("; 1 piece, 1 hole", facts["Mesh"])
                self.assertIn("; 1 piece, 1 hole", facts["Shape"])
                self.assertRegex(facts["Run"], rf"spade.ini, {ranks} ranks? x 1 thread on 1 node$")
                self.assertRegex(facts["Names"], r"^edges of spade \d+, hole \d+$")
                self.assertEqual(sum(map(int, re.findall(r" (\d+)", facts["Names"]))),
                                 int(re.search(r"(\d+) boundary edges", facts["Mesh"])[1]))
                self.assertRegex(facts["Quality"],
                                 r"alpha median 1\.\d+, .* at \(\S+, \S+\).*; smallest angle \S+ degrees")
                quality = report["groups"]["quality"]["attributes"]
                shortest = re.match(r"edge of length (\S+) at \((\S+), (\S+)\)", facts["Shortest"]).groups()
                for found, name in zip(shortest, ("shortest_edge", "shortest_edge_x", "shortest_edge_y")):
                    self.assertAlmostEqual(float(found), quality[name], delta=1e-5 * quality[name])
                self.assertRegex(facts["Time"], r"^\S+ s: [a-z -]+ \d+ %, [a-z -]+ \d+ %; memory")
                self.assertTrue(facts["Files"].startswith(f"{work}/spade.h5 .xdmf .xmf .vtkhdf  ("), facts["Files"])

    def test_quiet_keeps_warnings_and_only_these(self):
        with Workspace() as work:
            (work / "two.xy").write_text("0.1 0.3\n0.4 0.3\n0.4 0.499\n0.6 0.499\n0.6 0.3\n0.9 0.3\n0.9 0.7\n0.6 0.7\n"
                                         "0.6 0.501\n0.4 0.501\n0.4 0.7\n0.1 0.7\n", encoding="utf-8")
            (work / "two.ini").write_text("[shape]\nregion = two\n[shape.two]\ntype = contour\nfile = two.xy\n"
                                          "[meshing]\npoints = 300\n", encoding="utf-8")
            for more in ([], ["--validate"], ["--dry-run"]):
                done = run(work / "two.ini", f"output.directory={work}/out", "output.overwrite=true", "--quiet",
                           "meshing.connect=cut", *more)
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                lines = done.stdout.splitlines()
                self.assertTrue(all(line.startswith("warning: ") for line in lines), done.stdout)
                self.assertRegex(lines[0], r"two\.ini:2: 'region' in \[shape\] has a new name; write 'geometry = two'")
                start = "warning: 1 component became 2: 1 neck was cut, the widest 0.0"
                pieces = [line for line in lines if line.startswith(start)]
                self.assertEqual(len(pieces), 1, done.stdout)

    def test_quiet_is_silent(self):
        with Workspace() as work:
            code, text = run_on_terminal(arguments(work, "--quiet"))
            self.assertEqual((code, text), (0, ""))

    def test_an_error_stands_in_a_line_of_its_own(self):
        with Workspace() as work:
            code, text = run_on_terminal(arguments(work, "shape.spade.file=nothing.xy"))
            self.assertEqual(code, 4)
            self.assertIn(ERASE, text)
            self.assertTrue(any(line.startswith("trime_mpi: error: ") for line in shown(text)), text)

    def test_an_interrupt_erases_the_line(self):
        with Workspace() as work:
            code, text = run_on_terminal(arguments(work, "meshing.points=2000000"), interrupt=True)
            self.assertEqual(code, -signal.SIGINT)
            self.assertTrue(any(line.startswith("trime_mpi: interrupted") for line in shown(text)), text)


class Report(unittest.TestCase):
    def test_schema(self):
        with Workspace() as work:
            done = run(*arguments(work, "--quiet", "--report", work / "r.json"))
            self.assertEqual(done.returncode, 0, done.stderr)
            report = json.loads((work / "r.json").read_text(encoding="utf-8"))
            self.assertEqual(set(report), {"format", "format_version", "exit_code", "files", "warnings", "attributes",
                                           "groups"})
            self.assertEqual((report["format"], report["format_version"]), ("trime_mpi-report", 1))
            self.assertEqual(report["files"], [f"{work}/spade.{ending}" for ending in ("h5", "xdmf", "xmf", "vtkhdf")])
            for name in ("points", "triangles", "mesh_hash_hex", "stop_reason", "seconds_total", "complete"):
                self.assertIn(name, report["attributes"])
            for name in ("history", "quality", "checks", "timers", "counters", "tags"):
                self.assertIn(name, report["groups"])
            page = (ROOT / "src" / "files.md").read_text(encoding="utf-8")
            for name in report:
                self.assertIn(f"| `{name}`", page)

    def test_exit_code_and_no_files(self):
        with Workspace() as work:
            done = run(*arguments(work, "output.interval=0", "meshing.max_sweeps=2", "--record", work / "r.json"))
            self.assertEqual(done.returncode, 5)  # --record: its name in earlier versions
            report = json.loads((work / "r.json").read_text(encoding="utf-8"))
            self.assertEqual((report["exit_code"], report["files"]), (5, []))


if __name__ == "__main__":
    unittest.main()
