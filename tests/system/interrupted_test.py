#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests that a killed run leaves no incomplete file under the final name: the file does not exist, or its mesh is
whole."""
import os
import resource
import signal
import subprocess
import time
import unittest

import h5py

from trime_run import MPIEXEC, PATIENCE, PROGRAM, ROOT, Workspace, command, environment

CONFIG = ROOT / "configs" / "square.ini"
LONG, SHORT = 8_000_000, 100_000  # points: far from its end after some seconds; soon at its end


def processes_of(directory):
    """Ids of the processes whose command line names this directory (ours alone, it is a fresh one)."""
    found = []
    for entry in os.listdir("/proc"):
        if entry.isdigit() and int(entry) != os.getpid():
            try:
                with open(f"/proc/{entry}/cmdline", "rb") as stream:
                    if str(directory).encode() in stream.read():
                        found.append(int(entry))
            except OSError:
                pass
    return found


def size_of(path):
    """Size of a file that may vanish at any moment (as those with which MPI tries out locks do): then 0."""
    try:
        return path.stat().st_size
    except FileNotFoundError:
        return 0


class Interrupted(unittest.TestCase):
    def start(self, directory, points):
        """Starts a run on 2 ranks."""
        arguments = [CONFIG, f"meshing.points={points}", f"output.directory={directory}", "output.name=mesh"]
        return subprocess.Popen(command(arguments, 2), env=environment(1), stdout=subprocess.DEVNULL,
                                stderr=subprocess.DEVNULL)

    def kill_when(self, directory, points, due, number):
        """Sends the signal to mpirun as soon as due() holds, and waits until no rank is left."""
        mpirun = self.start(directory, points)
        end = time.monotonic() + PATIENCE
        while not due() and mpirun.poll() is None and time.monotonic() < end:
            time.sleep(0.002)
        mpirun.send_signal(number)
        mpirun.wait(PATIENCE)
        while processes_of(directory) and time.monotonic() < end:
            time.sleep(0.05)
        self.assertEqual(processes_of(directory), [], "ranks survive their mpirun")

    def assert_nothing_or_whole(self, directory):
        """The promise. Returns whether there is a mesh."""
        for left in directory.glob("mesh.h5.tmp-*"):
            self.assert_incomplete_or_whole(left)
        mesh = directory / "mesh.h5"
        if not mesh.exists():
            return False
        with h5py.File(mesh, "r") as file:
            self.assertEqual(int(file["trime_mpi"].attrs["complete"]), 1)
            self.assertGreater(file["Mesh/mesh/topology"][:].max(), SHORT // 2)
        return True

    def assert_incomplete_or_whole(self, temporary):
        """The run may have been killed just before it renamed the file. The first vertex of a triangle is the lowest;
        rows that are not written are 0."""
        try:
            with h5py.File(temporary, "r") as file:
                complete = int(file["trime_mpi"].attrs["complete"])
                triangles = file["Mesh/mesh/topology"][:] if complete else None
        except (OSError, KeyError):  # not even its beginning has reached the disk
            return
        if complete:
            self.assertTrue((triangles[:, 0] < triangles[:, 1]).all(), "part of the file looks like a whole mesh")

    def test_killed_while_meshing(self):
        for number in (signal.SIGKILL, signal.SIGTERM):
            with self.subTest(signal=number), Workspace() as directory:
                begin = time.monotonic()
                self.kill_when(directory, LONG, lambda: time.monotonic() > begin + 1, number)
                self.assertFalse(self.assert_nothing_or_whole(directory), "the run ended before it could be killed")

    def test_killed_while_writing(self):
        for number in (signal.SIGKILL, signal.SIGTERM):
            with self.subTest(signal=number), Workspace() as directory:
                def written(folder=directory):
                    return any(".tmp-" in path.name and size_of(path) > 100_000 for path in folder.iterdir())
                self.kill_when(directory, SHORT, written, number)
                self.assert_nothing_or_whole(directory)

    @staticmethod
    def is_in(process, row, number):
        """Whether the kernel has the signal in this set of the process: SigCgt, SigIgn (proc(5))."""
        with open(f"/proc/{process.pid}/status", encoding="ascii") as stream:
            words = next(line.split() for line in stream if line.startswith(f"{row}:"))
        return int(words[1], 16) >> (number - 1) & 1 == 1

    def interrupted(self, number, ignored=False):
        """Sends the signal to a single rank without mpirun, as soon as it listens, or 1 s after the start where its
        caller ignores the signal; returns its exit code and what it said."""
        before = (lambda: signal.signal(number, signal.SIG_IGN)) if ignored else None
        with Workspace() as directory:
            arguments = [CONFIG, f"meshing.points={LONG}", f"output.directory={directory}", "output.name=mesh"]
            with subprocess.Popen(command(arguments, 1), env=environment(1), stdout=subprocess.DEVNULL,
                                  stderr=subprocess.PIPE, text=True, preexec_fn=before) as run:
                end = time.monotonic() + PATIENCE
                time.sleep(1)
                while not ignored and not self.is_in(run, "SigCgt", number) and time.monotonic() < end:
                    time.sleep(0.01)
                self.assertEqual(self.is_in(run, "SigIgn", number), ignored)
                run.send_signal(number)
                try:
                    run.wait(2 if ignored else PATIENCE)
                    code = run.returncode
                except subprocess.TimeoutExpired:
                    code = None  # it goes on
                    run.kill()
                return code, run.stderr.read(), sorted(path.name for path in directory.iterdir())

    def test_a_word_is_said_on_every_signal_that_ends_a_program(self):
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT, signal.SIGABRT, signal.SIGXCPU):
            with self.subTest(signal=number):
                code, told, left = self.interrupted(number)
                self.assertEqual(code, -number)
                self.assertEqual(told.count("trime_mpi: interrupted; the final mesh was not written\n"), 1, told)
                self.assertEqual(left, [])

    def test_a_mesh_that_is_written_is_not_said_to_be_lost(self):
        with Workspace() as directory:
            mesh = directory / "mesh.h5"
            arguments = [CONFIG, f"meshing.points={SHORT}", f"output.directory={directory}", "output.name=mesh",
                         "output.formats=vtkhdf xdmf text"]
            with subprocess.Popen(command(arguments, 1), env=environment(1), stdout=subprocess.DEVNULL,
                                  stderr=subprocess.PIPE, text=True) as run:
                end = time.monotonic() + PATIENCE
                while not mesh.exists() and run.poll() is None and time.monotonic() < end:
                    time.sleep(0.001)
                run.send_signal(signal.SIGTERM)
                run.wait(PATIENCE)
                told = run.stderr.read()
            self.assertTrue(self.assert_nothing_or_whole(directory))
            self.assertNotIn("not written", told)
            if run.returncode != 0:  # it was not done before the signal came
                self.assertEqual(run.returncode, -signal.SIGTERM)
                self.assertIn("interrupted; the final mesh is written", told)

    def test_a_file_that_grows_beyond_its_limit_is_an_error(self):
        """SIGXFSZ would end the program, and leave a part of the file."""
        limit = 40_000_000  # bytes: more than MPI's own files need, less than those of the mesh
        with Workspace() as directory:
            arguments = [CONFIG, "meshing.points=500000", f"output.directory={directory}", "output.name=mesh"]
            done = subprocess.run(command(arguments, 1), env=environment(1), capture_output=True, text=True,
                                  check=False, timeout=PATIENCE, preexec_fn=lambda: resource.setrlimit(
                                      resource.RLIMIT_FSIZE, (limit, limit)))
            self.assertEqual(done.returncode, 4, done.stdout + done.stderr)
            self.assertIn("File too large", done.stderr)
            self.assertEqual(list(directory.iterdir()), [])

    def together(self, *programs):
        """One rank of each command line, as one job; code, text, seconds."""
        line = [MPIEXEC]
        for program in programs:
            line += ([":"] if len(line) > 1 else []) + ["-np", "1"] + [str(part) for part in program]
        begin = time.monotonic()
        done = subprocess.run(line, env=environment(1), capture_output=True, text=True, check=False, timeout=PATIENCE)
        return done.returncode, done.stdout + done.stderr, time.monotonic() - begin

    def test_an_error_that_one_rank_has_alone_ends_the_job(self):
        with Workspace() as directory:
            run = [PROGRAM, CONFIG, "meshing.points=1000", f"output.directory={directory}"]
            code, told, seconds = self.together(run, run + ["--nonsense"])
            self.assertNotEqual(code, 0)
            self.assertIn("--nonsense", told)
            self.assertIn("(rank 1 alone)", told)
            self.assertLess(seconds, 30)
            self.assertEqual(list(directory.iterdir()), [])

    def test_the_environment_of_rank_0_decides(self):
        with Workspace() as directory:
            run = [PROGRAM, CONFIG, "meshing.points=1000", f"output.directory={directory}", "output.overwrite=true"]
            asks = ["env", "TRIME_VERIFY_STARS=1"] + run
            for programs in ((asks, run), (run, asks)):
                code, told, _ = self.together(*programs)
                self.assertEqual(code, 0, told)

    def test_a_signal_that_the_caller_ignores_stays_ignored(self):
        for number in (signal.SIGINT, signal.SIGHUP):
            with self.subTest(signal=number):
                code, told, _ = self.interrupted(number, ignored=True)
                self.assertIsNone(code, told)


if __name__ == "__main__":
    unittest.main()
