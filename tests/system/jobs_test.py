#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests all job scripts with a real SLURM of one node (scripts/slurm_here.sh).

The test is skipped, with the reason, if SLURM cannot start: without root, or without the packages.
"""
import csv
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

import h5py

from trime_run import PROGRAM, ROOT, run

SLURM = ROOT / "scripts" / "slurm_here.sh"
SMALL = "meshing.points=800"
FIRST_WORD = " thread on 1 node"  # of the program, not of the job script
QUICK = ("--repeats", "1", "--methods", "cvd", "--stops", "rule")  # for scripts/scaling.py


class Jobs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if os.geteuid() != 0 or not shutil.which("slurmctld"):
            raise unittest.SkipTest("no SLURM here: needs root and munge slurmctld slurmd slurm-client")
        cls.work = pathlib.Path(tempfile.mkdtemp(prefix="trime-jobs-"))
        cls.slurm = cls.work / "slurm"
        cls.addClassCleanup(cls.stop)
        with (cls.work / "start.log").open("w", encoding="utf-8") as log:  # daemons would keep a pipe open
            done = subprocess.run([SLURM, "start", cls.slurm], stdout=log, stderr=log, check=False, timeout=90)
        if done.returncode != 0:
            said = (cls.work / "start.log").read_text(encoding="utf-8")
            raise unittest.SkipTest(f"SLURM does not start here: {said}")
        for name in ("jobs", "configs", "scripts"):
            (cls.work / name).symlink_to(ROOT / name)
        done = run(ROOT / "configs" / "square.ini", SMALL, f"output.directory={cls.work / 'direct'}")
        assert done.returncode == 0, done.stdout + done.stderr
        cls.expected = cls.hash_of(cls.work / "direct" / "square.h5")

    @classmethod
    def stop(cls):
        subprocess.run([SLURM, "stop", cls.slurm], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)
        shutil.rmtree(cls.work, ignore_errors=True)

    @staticmethod
    def hash_of(path):
        with h5py.File(path) as file:
            return file["trime_mpi"].attrs["mesh_hash"]

    def submit(self, *arguments, succeeds=True, **changes):
        """Submits and waits; returns the number of the job and the text of its logs."""
        environment = dict(os.environ, SLURM_CONF=str(self.slurm / "slurm.conf"), TRIME_PROGRAM=PROGRAM) | changes
        done = subprocess.run(["sbatch", "--wait", "--parsable", *arguments], cwd=self.work, env=environment, text=True,
                              capture_output=True, check=False, timeout=120)
        job = done.stdout.split(";")[0].strip()
        self.assertTrue(job.isdigit(), done.stdout + done.stderr)
        log = "".join(path.read_text(encoding="utf-8") for path in sorted(self.work.glob(f"*-{job}*.log")))
        self.assertEqual(done.returncode == 0, succeeds, log)
        return job, log

    def table(self, directory):
        with (self.work / directory / "scaling.csv").open(encoding="utf-8") as stream:
            return list(csv.DictReader(stream))

    def test_python_under_srun(self):
        """Each of two processes of Python starts a run of one rank, and one of two."""
        folders = {ranks: self.work / f"python{ranks}" for ranks in (1, 2)}
        for folder in folders.values():
            folder.mkdir()
        program = f"srun --mpi=none -n 2 {sys.executable} {ROOT}/tests/system/mesh_in_a_job.py"
        self.submit("-n", "2", "-o", self.work / "python-%j.log", "--wrap",
                    " && ".join(f"{program} {folder} {ranks}" for ranks, folder in folders.items()))
        for ranks, folder in folders.items():
            found = [json.loads(path.read_text(encoding="utf-8")) for path in folder.glob("*.json")]
            self.assertEqual([(one.get("ranks"), one.get("read")) for one in found], [(ranks, found[0]["hash"])] * 2)

    def test_single_node(self):
        job, log = self.submit("jobs/single_node.sbatch", SMALL)
        self.assertEqual(self.hash_of(self.work / "out" / job / "square.h5"), self.expected)
        self.assertIn("2 ranks x 1 threads", log)

    def test_restartable(self):
        """The signal comes as SLURM sends it before the limit, but as soon as the program has said a word: all sweeps
        are still to come then, however fast the machine is."""
        points = "meshing.points=500000"
        done = run(ROOT / "configs" / "square.ini", points, f"output.directory={self.work / 'long'}", ranks=2)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        environment = dict(os.environ, SLURM_CONF=str(self.slurm / "slurm.conf"), TRIME_PROGRAM=PROGRAM)
        done = subprocess.run(["sbatch", "--parsable", "jobs/restartable.sbatch", points, "log.level=info"],
                              cwd=self.work, env=environment, text=True, capture_output=True, check=False, timeout=60)
        job = done.stdout.split(";")[0].strip()
        self.assertTrue(job.isdigit(), done.stdout + done.stderr)
        log, end = self.work / f"trime_mpi-{job}.log", time.monotonic() + 120
        while not (log.exists() and FIRST_WORD in log.read_text(encoding="utf-8")) and time.monotonic() < end:
            time.sleep(0.05)
        subprocess.run(["scancel", "--batch", "--signal=USR1", job], env=environment, check=True)
        log = self.wait_for_end(job)
        self.assertIn("start 0", log)
        self.assertIn("stopped at the checkpoint", log)
        self.assertIn("start 1", log)
        self.assertIn("restart: from", log)
        self.assertEqual(self.hash_of(self.work / "out" / job / "square.h5"),
                         self.hash_of(self.work / "long" / "square.h5"))

    def wait_for_end(self, job):
        """Waits for the end of a job that may be queued again. Returns the text of its log."""
        environment = dict(os.environ, SLURM_CONF=str(self.slurm / "slurm.conf"))
        end = time.monotonic() + 240
        while time.monotonic() < end:
            state = subprocess.run(["squeue", "-h", "-j", job, "-o", "%T"], env=environment, text=True,
                                   capture_output=True, check=False).stdout.strip()
            if state in ("", "COMPLETED", "FAILED", "TIMEOUT", "CANCELLED"):
                break
            time.sleep(1)
        return (self.work / f"trime_mpi-{job}.log").read_text(encoding="utf-8")

    def test_multi_node(self):
        job, log = self.submit("--nodes=1", "--ntasks-per-node=1", "--ntasks-per-socket=1", "--cpus-per-task=2",
                               "jobs/multi_node.sbatch", "configs/square.ini", SMALL)
        self.assertEqual(self.hash_of(self.work / "out" / job / "square.h5"), self.expected)
        self.assertIn("1 ranks x 2 threads", log)

    def test_strong_scaling(self):
        job, _ = self.submit("jobs/strong_scaling.sbatch", "--points", "800", *QUICK)
        rows = self.table(f"scaling-{job}")
        self.assertEqual([(row["ranks"], row["threads"]) for row in rows], [("1", "1"), ("2", "1"), ("1", "2")])
        self.assertEqual(len({row["mesh_hash"] for row in rows}), 1)

    def test_weak_scaling(self):
        job, _ = self.submit("jobs/weak_scaling.sbatch", "--points", "500", *QUICK)
        rows = self.table(f"weak-{job}")
        self.assertEqual([row["points_asked"] for row in rows], ["500", "1000", "1000"])
        self.assertEqual(rows[1]["mesh_hash"], rows[2]["mesh_hash"])
        self.assertEqual({row["same_mesh"] for row in rows}, {"True"})
        for row in rows:
            self.assertAlmostEqual(float(row["efficiency"]), float(rows[0]["seconds"]) / float(row["seconds"]))

    def test_scaling_submits_and_collects(self):
        def scaling(*arguments):
            environment = dict(os.environ, SLURM_CONF=str(self.slurm / "slurm.conf"), MPLCONFIGDIR=str(self.work))
            done = subprocess.run([ROOT / "scripts" / "scaling.py", *arguments], cwd=self.work, env=environment,
                                  capture_output=True, text=True, check=False, timeout=120)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        scaling("--backend", "slurm", "--kind", "strong", "--cases", "1x1,2x1,1x2", "--points", "800", *QUICK,
                "--program", PROGRAM, "--output", "many", "--sbatch=--wait")
        scaling("--collect", "many")
        rows = self.table("many")
        self.assertEqual([(row["ranks"], row["threads"]) for row in rows], [("1", "1"), ("2", "1"), ("1", "2")])
        self.assertEqual(len({row["mesh_hash"] for row in rows}), 1)
        self.assertIn("SLURM_JOB_ID", (self.work / "many" / "scaling.md").read_text(encoding="utf-8"))

    def test_array(self):
        (self.work / "list.txt").write_text("configs/square.ini\nconfigs/circle.ini meshing.seed=3\n", encoding="utf-8")
        job, _ = self.submit("--array=1-2", "jobs/array.sbatch", "list.txt", SMALL)
        self.assertEqual(self.hash_of(self.work / "out" / job / "1" / "square.h5"), self.expected)
        self.assertTrue((self.work / "out" / job / "2" / "circle.h5").exists())

    def test_array_beyond_the_list(self):
        (self.work / "short.txt").write_text("configs/square.ini\n", encoding="utf-8")
        _, log = self.submit("--array=2", "jobs/array.sbatch", "short.txt", succeeds=False)
        self.assertIn("Expected a config in line 2 of short.txt, found none", log)

    def test_srun(self):
        environment = dict(os.environ, SLURM_CONF=str(self.slurm / "slurm.conf"))
        known = subprocess.run(["srun", "--mpi=list"], env=environment, capture_output=True, text=True, check=False)
        if "pmix" not in known.stdout + known.stderr:
            self.skipTest("this srun has no PMIx")
        job, log = self.submit("jobs/single_node.sbatch", SMALL, TRIME_LAUNCHER="srun --mpi=pmix")
        self.assertEqual(self.hash_of(self.work / "out" / job / "square.h5"), self.expected)
        self.assertIn("2 ranks x 1 thread on 1 node", log)

    def test_no_program(self):
        environment = dict(os.environ, SLURM_JOB_ID="1", TRIME_PROGRAM="/nowhere")
        done = subprocess.run(["bash", "jobs/single_node.sbatch"], cwd=self.work, env=environment, capture_output=True,
                              text=True, check=False)
        self.assertEqual(done.returncode, 2)
        self.assertIn("Expected the program at /nowhere", done.stderr)


if __name__ == "__main__":
    unittest.main()
