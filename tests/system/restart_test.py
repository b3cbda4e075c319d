#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests that a run that stops at a checkpoint and continues on other ranks makes the mesh of an uninterrupted run, bit
for bit.

TRIME_RESTART_KILLS=n kills n runs at random moments for each signal and number of ranks (default: 1).
"""
import itertools
import os
import random
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

import h5py

from interrupted_test import processes_of
from trime_run import PATIENCE, ROOT, Workspace, command, environment, run

CIRCLE = ROOT / "configs" / "circle.ini"
KILLS = int(os.environ.get("TRIME_RESTART_KILLS", "1"))
STOPPED, USAGE, FILE = 75, 2, 4  # exit codes
MANY = 150_000  # points: some seconds


def hash_and_history(directory):
    """Of the final mesh; without what may differ from run to run."""
    with h5py.File(directory / "mesh.h5", "r") as file:
        group = file["trime_mpi"]
        history = {name: column[:].tolist() for name, column in group["history"].items()
                   if name not in ("seconds", "rebuilt_stars")}
        return group.attrs["mesh_hash"], history


def places(directory):
    return [f"output.directory={directory}", "output.name=mesh", "output.overwrite=true"]


def checkpoints(directory):
    return sorted(directory.glob("mesh.checkpoint-*.h5"))


class Runs(unittest.TestCase):
    def whole(self, directory, *arguments):
        """The mesh of a run without a break."""
        done = run(*arguments, *places(directory))
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        found = hash_and_history(directory)
        (directory / "mesh.h5").unlink()
        return found


class EverySweep(Runs):
    def chain(self, ranks, *arguments, threads=1):
        """Stops a run after each sweep, and goes on with other ranks. Runs of one rank start fast, so they are many."""
        with Workspace() as directory:
            expected = self.whole(directory, *arguments)
            stop = directory / "stop"
            runs = 0
            for here in itertools.cycle(ranks):
                stop.touch()
                done = run(*arguments, *places(directory), f"checkpoint.stop_file={stop}", "--restart", "auto",
                           ranks=here, threads=threads)
                runs += 1
                if done.returncode != STOPPED:
                    break
                self.assertFalse(stop.exists(), "the next run would stop by it")
                self.assertIn("continue with --restart", done.stderr)
                self.assertFalse((directory / "mesh.h5").exists())
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            self.assertGreater(runs, 5)
            self.assertFalse(stop.exists(), "the next run would stop by it")
            self.assertEqual(hash_and_history(directory), expected)
            self.assertEqual(checkpoints(directory), [], "a mesh that is written needs none")
            with h5py.File(directory / "mesh.h5", "r") as file:
                seconds = file["trime_mpi/history/seconds"][:].tolist()
            self.assertEqual(seconds, sorted(seconds), "the clock goes on where it was")

    def test_every_sweep_of_a_uniform_mesh(self):
        self.chain([1, 3, 1, 1, 2, 1], CIRCLE, "meshing.points=2000")

    def test_every_sweep_of_a_mesh_that_is_divided(self):
        self.chain([2, 1, 1], CIRCLE, "meshing.points=6000", "sizing.type=automatic", "sizing.gradation=0.3")

    def test_every_sweep_of_insertions_with_bars(self):
        self.chain([3, 1, 1], CIRCLE, "meshing.points=1500", "sizing.type=automatic", "meshing.initial_fraction=0.4",
                   "meshing.method=distmesh", "meshing.stop_tolerance=0.2")

    def test_every_sweep_of_a_torus(self):
        self.chain([1, 2, 1], ROOT / "configs" / "torus_hole.ini", "meshing.points=1500", threads=2)


class Restart(Runs):
    def test_steps_from_before_the_break_stay(self):
        arguments = [CIRCLE, "meshing.points=1500", "output.interval=3", "output.formats=vtkhdf xdmf text"]

        def series(directory):
            """Returns the names of all files, and the lines that depend on several meshes."""
            names = sorted(str(path.relative_to(directory)) for path in directory.rglob("*") if path.is_file())
            told = [directory / "mesh.vtkhdf.series", directory / "mesh_series.xdmf",
                    directory / "mesh" / "mesh_tria_quality_stat_overall.txt"]
            return names, [path.read_text(encoding="utf-8") for path in told]

        with Workspace() as once, Workspace() as directory:
            done = run(*arguments, *places(once))
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            stop = directory / "stop"
            for ranks in (1, 2, 1):
                for _ in range(3):
                    stop.touch()
                    done = run(*arguments, *places(directory), f"checkpoint.stop_file={stop}", "--restart", "auto",
                               ranks=ranks)
                    self.assertEqual(done.returncode, STOPPED, done.stdout + done.stderr)
                (directory / "mesh_step_000777.h5").write_bytes(b"of an older run")
            damaged = directory / "mesh_step_000003.h5"
            whole = damaged.read_bytes()
            damaged.write_bytes(whole[:1000])
            stop.touch()
            done = run(*arguments, *places(directory), f"checkpoint.stop_file={stop}", "--restart", "auto", ranks=3)
            self.assertIn("mesh_step_000003.h5: a step of the run before", done.stdout + done.stderr)
            damaged.write_bytes(whole)
            done = run(*arguments, *places(directory), "--restart", "auto", ranks=3)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            self.assertEqual(series(directory), series(once))

    # Signals

    def start(self, directory, ranks, *more):
        """Starts a run, and waits for its first line. From then on mpirun forwards signals, and the ranks handle them.
        The run is a separate process group, so that a test can end all of it."""
        arguments = [CIRCLE, f"meshing.points={MANY}", "sizing.type=automatic", *places(directory), "--verbose", *more]
        self.said = tempfile.TemporaryFile()
        self.addCleanup(self.said.close)
        started = subprocess.Popen(command(arguments, ranks), env=environment(1), stdout=self.said,
                                   stderr=subprocess.PIPE, text=True, start_new_session=True)
        end = time.monotonic() + PATIENCE
        while os.fstat(self.said.fileno()).st_size == 0 and started.poll() is None and time.monotonic() < end:
            time.sleep(0.005)
        return started

    def finish(self, directory, ranks):
        """Goes on to the end; returns what the mesh is."""
        done = run(CIRCLE, f"meshing.points={MANY}", "sizing.type=automatic", *places(directory), "--restart", "auto",
                   ranks=ranks)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual(checkpoints(directory), [])
        return hash_and_history(directory)

    def test_killed_at_random_moments(self):
        moments = random.Random(int(os.environ.get("TRIME_RESTART_SEED", "1")))
        equal = tried = from_checkpoint = 0
        with Workspace() as directory:
            expected = self.whole(directory, CIRCLE, f"meshing.points={MANY}", "sizing.type=automatic")
            begin = time.monotonic()
            self.start(directory, 1).communicate(timeout=PATIENCE)
            seconds = time.monotonic() - begin
            for number, ranks, _ in itertools.product((signal.SIGUSR1, signal.SIGTERM, signal.SIGKILL), (1, 2, 3),
                                                      range(KILLS)):
                with self.subTest(signal=number, ranks=ranks):
                    tried += 1
                    stopped = self.start(directory, ranks, "checkpoint.interval=0.1")
                    try:
                        stopped.wait(moments.uniform(0, seconds))
                    except subprocess.TimeoutExpired:
                        if number == signal.SIGKILL:
                            os.killpg(stopped.pid, number)
                        else:
                            stopped.send_signal(number)
                    told = stopped.communicate(timeout=PATIENCE)[1]
                    end = time.monotonic() + PATIENCE
                    while processes_of(directory) and time.monotonic() < end:
                        time.sleep(0.05)  # ranks outlive an mpirun that was killed, and go on for a moment
                    if number == signal.SIGUSR1:
                        self.assertIn(stopped.returncode, (0, STOPPED), told)
                    left = checkpoints(directory)
                    from_checkpoint += bool(left)
                    self.assertLessEqual(len(left), 2)
                    found = self.finish(directory, ranks % 3 + 1)
                    self.assertEqual(found, expected)
                    equal += 1
                    for path in directory.iterdir():  # a killed run may leave its temporary file
                        path.unlink()
        print(f"killed and restarted: {equal} of {tried} with the same mesh, {from_checkpoint} from a checkpoint")

    def test_usr2_writes_and_goes_on(self):
        with Workspace() as directory:
            going = self.start(directory, 2)
            end = time.monotonic() + PATIENCE
            while not checkpoints(directory) and going.poll() is None and time.monotonic() < end:
                going.send_signal(signal.SIGUSR2)
                time.sleep(0.02)
            told = going.communicate(timeout=PATIENCE)[1]
            self.assertEqual(going.returncode, 0, told)
            self.said.seek(0)
            self.assertIn(b"checkpoint: ", self.said.read())  # its file goes at the end of the run
            self.assertTrue((directory / "mesh.h5").exists())

    def test_usr1_after_the_sweeps(self):
        """The checkpoint from before the clean-up is the only one of this run."""
        with Workspace() as directory:
            for _ in range(5):  # the clean-up takes a moment only
                going = self.start(directory, 2, "checkpoint.interval=1000")
                end = time.monotonic() + PATIENCE
                while not checkpoints(directory) and going.poll() is None and time.monotonic() < end:
                    time.sleep(0.002)
                in_time = going.poll() is None
                if in_time:
                    going.send_signal(signal.SIGUSR1)
                told = going.communicate(timeout=PATIENCE)[1]
                self.assertIn(going.returncode, (0, STOPPED), told)
                self.assertEqual(any(".tmp-" in path.name for path in directory.iterdir()), False)
                if going.returncode == STOPPED:
                    self.assertFalse((directory / "mesh.h5").exists())
                    self.finish(directory, 1)
                    return
            self.skipTest("five runs ended before they could be stopped")

    def test_the_time_limit(self):
        with Workspace() as directory:
            begin = time.monotonic()
            done = run(CIRCLE, "meshing.points=3000000", *places(directory), "--time-limit", "00:00:01")
            self.assertEqual(done.returncode, STOPPED, done.stdout + done.stderr)
            self.assertLess(time.monotonic() - begin, 20)
            self.assertIn("the time limit is near", done.stderr)
            self.assertEqual(len(checkpoints(directory)), 1)

    # Files that cannot be used

    def refused(self, directory, name, code, text, *more, ranks=1):
        done = run(CIRCLE, "meshing.points=2000", *places(directory), *more, "--restart", directory / name, ranks=ranks,
                   timeout=30)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        self.assertRegex(done.stderr, text)
        self.assertFalse((directory / "mesh.h5").exists())

    def test_files_that_are_refused(self):
        with Workspace() as directory:
            (directory / "stop").touch()
            stops = f"checkpoint.stop_file={directory / 'stop'}"
            done = run(CIRCLE, "meshing.points=2000", *places(directory), stops, ranks=2)
            self.assertEqual(done.returncode, STOPPED, done.stdout + done.stderr)
            good = checkpoints(directory)[0]
            size = good.stat().st_size
            (directory / "foreign.h5").write_bytes((directory / good.name).read_bytes()[:100] + b"x" * 1000)
            with h5py.File(directory / "mesh_of_others.h5", "w") as file:
                file["data"] = [1, 2, 3]
            for ranks in (1, 3):
                self.refused(directory, "missing.h5", FILE, "missing.h5", ranks=ranks)
                self.refused(directory, "foreign.h5", FILE, "foreign.h5", ranks=ranks)
                self.refused(directory, "mesh_of_others.h5", FILE, "not a checkpoint of trime_mpi", ranks=ranks)
                for share in (0.1, 0.5, 0.99):
                    (directory / "short.h5").write_bytes(good.read_bytes()[:int(share * size)])
                    self.refused(directory, "short.h5", FILE, "short.h5", ranks=ranks)
                self.refused(directory, good.name, USAGE, r"points in \[meshing\]: 2000 then, 2500 now",
                             "meshing.points=2500", ranks=ranks)
                for place, change in (("sites/position", 1e-9), ("sites/pushes", 1), ("tiles/drift", 1e-3),
                                      ("history/mean_alpha", 1e-6)):
                    self.damaged(good, directory / "changed.h5", place, change)
                    self.refused(directory, "changed.h5", FILE, "damaged", ranks=ranks)
            self.attribute(good, directory / "older.h5", "format_version", 0)
            self.refused(directory, "older.h5", FILE, "version 0; expected .*version 1")
            self.attribute(good, directory / "numbers.h5", "number", 77)
            self.refused(directory, "numbers.h5", FILE, "damaged")

    @staticmethod
    def damaged(good, path, place, change):
        shutil.copyfile(good, path)
        with h5py.File(path, "r+") as file:
            data = file["trime_mpi_state/" + place]
            data[len(data) // 2] = data[len(data) // 2] + change

    @staticmethod
    def attribute(good, path, name, value):
        shutil.copyfile(good, path)
        with h5py.File(path, "r+") as file:
            file["trime_mpi_state"].attrs.modify(name, value)

    def test_another_shape_is_refused(self):
        with Workspace() as directory:
            for name in ("coast.ini", "coast.xy"):
                shutil.copyfile(ROOT / "configs" / name, directory / name)
            (directory / "stop").touch()
            arguments = [directory / "coast.ini", "meshing.points=1500", *places(directory)]
            done = run(*arguments, f"checkpoint.stop_file={directory / 'stop'}")
            self.assertEqual(done.returncode, STOPPED, done.stdout + done.stderr)
            lines = (directory / "coast.xy").read_text(encoding="utf-8").splitlines(keepends=True)
            at = next(k for k, line in enumerate(lines) if line[0].isdigit() or line[0] == "-")
            x, y = lines[at].split()[:2]
            lines[at] = f"{float(x) + 1e-4} {y}\n"
            (directory / "coast.xy").write_text("".join(lines), encoding="utf-8")
            done = run(*arguments, "--restart", checkpoints(directory)[0])
            self.assertEqual(done.returncode, FILE, done.stdout + done.stderr)
            self.assertIn("another shape", done.stderr)

    def test_the_older_file_serves_where_the_newest_is_damaged(self):
        with Workspace() as directory:
            arguments = [CIRCLE, "meshing.points=2000"]
            expected = self.whole(directory, *arguments)
            for _ in range(2):
                (directory / "stop").touch()
                done = run(*arguments, *places(directory), f"checkpoint.stop_file={directory / 'stop'}", "--restart",
                           "auto")
                self.assertEqual(done.returncode, STOPPED, done.stdout + done.stderr)
            newest = max(checkpoints(directory), key=lambda path: path.stat().st_mtime_ns)
            self.assertEqual(len(checkpoints(directory)), 2)
            newest.write_bytes(newest.read_bytes()[:5000])
            done = run(*arguments, *places(directory), "--restart", "auto", ranks=2)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            self.assertIn("this checkpoint is ignored", done.stdout + done.stderr)
            self.assertEqual(hash_and_history(directory), expected)

    def test_without_a_checkpoint_a_run_goes_on(self):
        """Whoever asked it to stop: its work would be lost. A directory is in the way of the file."""
        with Workspace() as directory:
            arguments = [CIRCLE, "meshing.points=2000"]
            expected = self.whole(directory, *arguments)
            (directory / "mesh.checkpoint-2.h5").mkdir()
            (directory / "stop").touch()
            for ranks in (1, 3):
                done = run(*arguments, *places(directory), f"checkpoint.stop_file={directory / 'stop'}", ranks=ranks)
                self.goes_on(done.returncode, done.stdout + done.stderr)
                self.assertEqual(hash_and_history(directory), expected)
                self.assertFalse((directory / "stop").exists())
                (directory / "stop").touch()
            done = run(CIRCLE, f"meshing.points={4 * MANY}", *places(directory), "--time-limit", "00:00:01")
            self.goes_on(done.returncode, done.stdout + done.stderr)
            self.assertIn("(the time limit is near)", done.stdout + done.stderr)
            for ranks in (1, 2):
                self.goes_on(*self.signalled(directory, ranks, signal.SIGUSR1))
            code, told = self.signalled(directory, 1, signal.SIGTERM)
            self.assertEqual(code, FILE, told)
            self.assertRegex(told, "checkpoint failed: .*is a directory.*its work is lost")

    def goes_on(self, code, told):
        self.assertEqual(code, 0, told)
        self.assertEqual(told.count("the run does not stop"), 1, told)

    def signalled(self, directory, ranks, number):
        """Exit code and words of a run that gets a signal in its sweeps."""
        going = self.start(directory, ranks, "checkpoint.interval=1000", f"meshing.points={3 * MANY}")
        end = time.monotonic() + PATIENCE
        while "sweep stage" not in self.told() and time.monotonic() < end:
            time.sleep(0.01)
        time.sleep(0.1)  # the sweep that this line heads
        going.send_signal(number)
        told = going.communicate(timeout=PATIENCE)[1]
        return going.returncode, self.told() + told

    def told(self):
        return os.pread(self.said.fileno(), 1 << 20, 0).decode()

    def test_fewer_are_kept_from_now_on(self):
        """The newest lies under a name that a smaller `keep` does not make."""
        with Workspace() as directory:
            arguments = [CIRCLE, "meshing.points=2000"]
            expected = self.whole(directory, *arguments)
            stop = f"checkpoint.stop_file={directory / 'stop'}"
            for number in range(1, 7):
                (directory / "stop").touch()
                done = run(*arguments, *places(directory), stop, "checkpoint.keep=5", "--restart", "auto")
                self.assertEqual(done.returncode, STOPPED, done.stdout + done.stderr)
                self.assertEqual(len(checkpoints(directory)), min(number, 5))
            (directory / "mesh.checkpoint-1001.h5").write_bytes(b"of nobody")
            for ranks, number in ((2, 2), (1, 1)):  # six sweeps, then seven
                (directory / "stop").touch()
                done = run(*arguments, *places(directory), stop, "checkpoint.keep=1", "--restart", "auto", "--verbose",
                           ranks=ranks)
                self.assertEqual(done.returncode, STOPPED, done.stdout + done.stderr)
                self.assertRegex(done.stdout, rf"restart: from .*/mesh.checkpoint-{number}\.h5")
            done = run(*arguments, *places(directory), "checkpoint.keep=1", "--restart", "auto", ranks=3)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            self.assertEqual(hash_and_history(directory), expected)
            self.assertEqual([path.name for path in checkpoints(directory)], ["mesh.checkpoint-1001.h5"])


if __name__ == "__main__":
    unittest.main()
