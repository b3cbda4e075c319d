#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests failures outside of the program: disks that fill up, directories that vanish, ranks that die.

Each run ends soon, with a message and an exit code. No incomplete file has a final name, and the mesh of an older run
stays whole. The tests print a table. They need the right to mount file systems (root in a container), and are skipped
without it.
"""
import hashlib
import io
import os
import pty
import resource
import select
import signal
import subprocess
import tempfile
import time
import unittest

import h5py

from interrupted_test import processes_of
from progress_test import ERASE
from trime_run import PATIENCE, PROGRAM, ROOT, Workspace, command, environment, run

CONFIG = ROOT / "configs" / "square.ini"
FILE = 4  # exit code
SOON = 30  # seconds from the fault to the end
POINTS = 40_000
ROOM = "16m"  # the mesh needs 4 MB, and twice that while it replaces an older one
# As the live line names them, in their order.
PHASES = ("shape", "size field", "boundary", "points", "sweeps", "settle", "clean-up", "extract", "certificate",
          "output")
TABLE = []


class SmallDisk:
    """A file system in memory, at a separate directory."""

    def __init__(self, test):
        self.test = test

    def __enter__(self):
        self.path = tempfile.mkdtemp(prefix="trime-disk-")
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={ROOM}", "none", self.path], capture_output=True,
                                 text=True, check=False)
        if mounted.returncode != 0:
            os.rmdir(self.path)
            self.test.skipTest(f"no right to mount a file system: {mounted.stderr.strip()}")
        return self

    def fill(self):
        """Somebody else takes all that is left."""
        try:
            with open(f"{self.path}/other", "ab", buffering=0) as other:
                while other.write(bytes(1 << 16)):
                    pass
        except OSError:
            pass

    def make_read_only(self):
        """As soon as it can be: a file that is open for writing, such as the run's first trial, keeps it busy."""
        end = time.monotonic() + SOON
        while subprocess.run(["mount", "-o", "remount,ro", self.path], check=False).returncode != 0:
            if time.monotonic() > end:
                raise TimeoutError(f"{self.path} does not become read-only within {SOON} s")
            time.sleep(0.002)

    def __exit__(self, *_):
        subprocess.run(["umount", "-l", self.path], check=False)
        os.rmdir(self.path)


def digest(path):
    return hashlib.sha256(path.read_bytes()).hexdigest()


class Faults(unittest.TestCase):
    @classmethod
    def tearDownClass(cls):
        print("\n".join(["| fault | ranks | code | seconds |", "|---|---|---|---|"] +
                        [f"| {what} | {ranks} | {code} | {seconds:.1f} |" for what, ranks, code, seconds in TABLE]))

    @staticmethod
    def arguments(folder, points):
        return [CONFIG, f"meshing.points={points}", f"output.directory={folder}", "output.name=mesh",
                "output.overwrite=true", "--verbose"]

    def start(self, folder, ranks, *more, points=POINTS, limit=None):
        """A run that has said its first word. Its group of processes is its own."""
        self.said = tempfile.TemporaryFile()
        self.addCleanup(self.said.close)
        limits = None if limit is None else lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))
        started = subprocess.Popen(command(self.arguments(folder, points) + list(more), ranks), env=environment(1),
                                   stdout=self.said, stderr=subprocess.STDOUT, start_new_session=True,
                                   preexec_fn=limits)
        self.wait_until(lambda: os.fstat(self.said.fileno()).st_size > 0 or started.poll() is not None)
        return started

    @staticmethod
    def wait_until(is_due, seconds=PATIENCE):
        end = time.monotonic() + seconds
        while not is_due() and time.monotonic() < end:
            time.sleep(0.002)

    def end_of(self, what, ranks, started, since):
        """Code and text of a run that ends soon after the fault."""
        try:
            code = started.wait(PATIENCE)
        except subprocess.TimeoutExpired:
            os.killpg(started.pid, signal.SIGKILL)
            self.fail(f"{what}, {ranks} ranks: no end within {PATIENCE} s")
        seconds = time.monotonic() - since
        TABLE.append((what, ranks, code, seconds))
        self.said.seek(0)
        return code, self.said.read().decode(errors="replace")

    def refused(self, what, ranks, started, since, words):
        code, told = self.end_of(what, ranks, started, since)
        self.assertEqual(code, FILE, told)
        self.assertRegex(told, words)
        self.assertRegex(told, r"trime_mpi: error: ")

    def older(self, folder):
        """A mesh of an older run, which has to stay."""
        done = run(CONFIG, "meshing.points=1000", f"output.directory={folder}", "output.name=mesh")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return digest(folder / "mesh.h5")

    def in_each_way(self, what, harm, words, *more):
        """On a small disk, on 1 and 3 ranks: harm(disk) as soon as the run is up."""
        for ranks in (1, 3):
            with self.subTest(ranks=ranks), SmallDisk(self) as disk:
                folder = type(CONFIG)(disk.path)
                before = self.older(folder)
                started = self.start(folder, ranks, *more)
                since = time.monotonic()
                harm(disk)
                self.refused(what, ranks, started, since, words)
                self.assertEqual(digest(folder / "mesh.h5"), before, "the older mesh is another one")
                left = {path.name for path in folder.iterdir() if path.is_file() and path.name != "other"}
                self.assertLessEqual(left - {"mesh.xmf", "mesh.xdmf", "mesh.vtkhdf"}, {"mesh.h5"}, "half a file")

    def test_a_disk_that_fills_up(self):
        self.in_each_way("the disk fills up", SmallDisk.fill, "No space left|are free")

    def test_a_disk_that_fills_up_while_text_is_written(self):
        def fill_late(disk):
            text = type(CONFIG)(disk.path) / "mesh"
            self.wait_until(lambda: any(text.glob("*")))
            disk.fill()
        for ranks in (1, 3):
            with self.subTest(ranks=ranks), SmallDisk(self) as disk:
                folder = type(CONFIG)(disk.path)
                started = self.start(folder, ranks, "output.formats=text", points=20_000)
                since = time.monotonic()
                fill_late(disk)
                code, told = self.end_of("it fills up among text files", ranks, started, since)
                self.assertIn(code, (0, FILE), told)  # all were written before, or not
                if code == FILE:
                    self.assertRegex(told, "No space left|are free")
                self.assertFalse(any(".tmp-" in path.name for path in folder.rglob("*")))
                with h5py.File(folder / "mesh.h5", "r") as file:
                    self.assertEqual(int(file["trime_mpi"].attrs["complete"]), 1)

    def test_a_disk_that_becomes_read_only(self):
        self.in_each_way("the disk becomes read-only", SmallDisk.make_read_only, "Read-only file system")

    def test_a_directory_that_vanishes(self):
        for ranks in (1, 3):
            with self.subTest(ranks=ranks), Workspace() as work:
                folder = work / "out"
                folder.mkdir()
                started = self.start(folder, ranks)
                since = time.monotonic()
                folder.rename(work / "elsewhere")  # in one step: the run may be making or removing a file in it
                # If the run makes the directory again before it looks for it, the run makes a mesh.
                code, told = self.end_of("the directory vanishes", ranks, started, since)
                self.assertIn(code, (0, FILE), told)
                if code == FILE:
                    self.assertRegex(told, "trime_mpi: error: .*No such file or directory")
                else:
                    self.assertTrue((folder / "mesh.h5").exists())

    def test_a_file_beyond_its_limit(self):
        """MPI's own files need 20 MB, the mesh with its cells more than twice the limit."""
        limit = 25_000_000
        for ranks in (1, 3):
            with self.subTest(ranks=ranks), Workspace() as folder:
                started = self.start(folder, ranks, "output.formats=vtkhdf xdmf voronoi", points=180_000, limit=limit)
                self.refused("the file is beyond its limit", ranks, started, time.monotonic(), "File too large")
                self.assertEqual(list(folder.iterdir()), [])

    def dies_in(self, phase, folder, points):
        """Returns the exit code of a run on 3 ranks. One of them is killed as soon as the live line shows the phase."""
        mine, its = pty.openpty()
        with subprocess.Popen(command(self.arguments(folder, points), 3), env=environment(1) | {"TERM": "xterm"},
                              stdin=subprocess.DEVNULL, stdout=its, stderr=its, start_new_session=True) as started:
            os.close(its)
            live = (ERASE + phase).encode()
            told = self.read_until(mine, lambda text: live in text)
            since = time.monotonic()
            ranks = self.ranks_of(folder)
            if ranks:
                try:
                    os.kill(ranks[-1], signal.SIGKILL)
                except ProcessLookupError:
                    pass
            told += self.read_until(mine, lambda text: False)
            os.close(mine)
            self.said = io.BytesIO(told)
            self.assertIn(live, told)
            code, text = self.end_of(f"a rank dies: {phase}", 3, started, since)
        self.assertLess(time.monotonic() - since, SOON, text)
        self.wait_until(lambda: not processes_of(folder))
        self.assertEqual(processes_of(folder), [], "ranks survive their mpirun")
        return code

    @staticmethod
    def read_until(terminal, is_enough):
        """What a pseudo-terminal is given until it is enough, its writers are gone, or time is up."""
        text = b""
        end = time.monotonic() + PATIENCE
        while not is_enough(text) and select.select([terminal], [], [], max(0.0, end - time.monotonic()))[0]:
            try:
                part = os.read(terminal, 1 << 16)
            except OSError:  # the reading end raises this when nobody can write
                break
            if not part:
                break
            text += part
        return text

    def test_a_rank_that_dies(self):
        """In each phase."""
        with Workspace() as folder:
            before = self.older(folder)
            for phase in PHASES:
                with self.subTest(phase=phase):
                    for points in (POINTS, 4 * POINTS, 16 * POINTS):  # more, until the phase lasts long enough
                        code = self.dies_in(phase, folder, points)
                        is_new = digest(folder / "mesh.h5") != before
                        with h5py.File(folder / "mesh.h5", "r") as file:
                            self.assertEqual(int(file["trime_mpi"].attrs["complete"]), 1)
                        before = digest(folder / "mesh.h5")
                        if code != 0:
                            break
                        self.assertTrue(is_new, "a run that was over has left no mesh")
                        TABLE.pop()
                    self.assertNotEqual(code, 0, "the run was over each time")
                    # Only at its very end may it have given its mesh the name.
                    self.assertTrue(phase == PHASES[-1] or not is_new)

    @staticmethod
    def ranks_of(folder):
        """Processes of the program that write to this folder, without their mpirun."""
        found = []
        for number in processes_of(folder):
            try:
                with open(f"/proc/{number}/cmdline", "rb") as stream:
                    if stream.read().startswith(os.fsencode(PROGRAM)):
                        found.append(number)
            except OSError:
                pass
        return sorted(found)


if __name__ == "__main__":
    unittest.main()
