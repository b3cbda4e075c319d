#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests the Python package in programs that mpirun has started. A run is a separate job, and gets the settings of the
user.
"""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import unittest

from mesh_in_a_job import DISC
from trime_run import MPIEXEC, PROGRAM, ROOT, Workspace, users_environment

sys.path.insert(0, str(ROOT / "scripts" / "python"))
import trime_mpi  # noqa: E402  (found by the line above)
from trime_mpi.environment import run_environment  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent
# What mpirun leaves for its processes that is not part of its job: they use it as if the user had set it.
HARMLESS = {"OMPI_MCA_orte_tmpdir_base", "PMIX_MCA_mca_base_component_show_load_errors"}


def outer(count, *options, launcher=MPIEXEC):
    """The command that starts `count` ranks of Python."""
    return [launcher, *options, "-n", str(count), sys.executable]


def in_a_job(count, ranks, *options, launcher=MPIEXEC, places=()):
    """What each rank of mesh_in_a_job.py finds."""
    with Workspace() as work:
        done = subprocess.run(
            [*outer(count, *places, launcher=launcher), HERE / "mesh_in_a_job.py", work, str(ranks), *options],
            env=users_environment(1) | {"TRIME_PROGRAM": PROGRAM, "TRIME_MPIEXEC": MPIEXEC}, capture_output=True,
            text=True, timeout=120, check=False)
        if done.returncode != 0:
            raise AssertionError(f"exit code {done.returncode}\n{done.stdout}{done.stderr}")
        return [json.loads((work / f"{rank}.json").read_text(encoding="utf-8")) for rank in range(count)]


def is_open_mpi():
    """True if the launcher of the tests is that of Open MPI, with which Debian's mpi4py is built."""
    said = subprocess.run([MPIEXEC, "--version"], capture_output=True, text=True, check=False, timeout=60).stdout
    return "Open MPI" in said or "OpenRTE" in said


class Jobs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.open_mpi = is_open_mpi()
        os.environ.update(users_environment(1), TRIME_PROGRAM=PROGRAM, TRIME_MPIEXEC=MPIEXEC)
        cls.hash = trime_mpi.mesh(DISC, threads=1).hash

    def check_meshes(self, found, count, ranks):
        expected = {"hash": self.hash, "ranks": ranks, "read": self.hash} | ({"size": count} if count else {})
        for one in found:
            self.assertEqual(one, expected)

    def test_each_rank_makes_and_reads_a_mesh(self):
        for count in (1, 2):
            for ranks in (1, 2):
                with self.subTest(count=count, ranks=ranks):
                    self.check_meshes(in_a_job(count, ranks), 0, ranks)

    def test_the_same_where_mpi_is_running(self):
        if not self.open_mpi:
            self.skipTest("Debian's mpi4py is built with Open MPI")
        for count in (1, 2):
            for ranks in (1, 2):
                with self.subTest(count=count, ranks=ranks):
                    self.check_meshes(in_a_job(count, ranks, "mpi4py"), count, ranks)

    def test_the_other_mpi_around_it(self):
        other = shutil.which("mpiexec.mpich" if self.open_mpi else "mpirun.openmpi")
        if not other:
            self.skipTest("there is no other MPI here")
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                self.check_meshes(in_a_job(2, ranks, launcher=other), 0, ranks)

    def test_places_of_the_job_are_not_those_of_the_run(self):
        """The job allows two processes a node; the run has three."""
        if not self.open_mpi:
            self.skipTest("options of Open MPI")
        found = in_a_job(2, 3, places=("--map-by", "ppr:2:node", "--bind-to", "none"))
        self.check_meshes(found, 0, 3)

    def test_one_rank_that_fails_leaves_the_others_alone(self):
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                wrong, right = in_a_job(2, ranks, "wrong=0", *(["mpi4py"] if self.open_mpi else []))
                self.assertEqual(wrong["error"], "ConfigError")
                self.assertIn("unknown key 'gradaton'", wrong["message"])
                self.assertEqual(right["hash"], self.hash)

    def test_each_rank_raises_an_error_of_its_own(self):
        for one in in_a_job(2, 2, "wrong=0", "wrong=1", *(["mpi4py"] if self.open_mpi else [])):
            self.assertEqual(one["error"], "ConfigError")
            self.assertIn("unknown key 'gradaton'", one["message"])


class Variables(unittest.TestCase):
    def test_outside_of_a_job_all_are_handed_on(self):
        own = {"OMPI_MCA_btl": "self,vader", "OMPI_MCA_rmaps_base_mapping_policy": "core", "HYDRA_IFACE": "lo",
               "PMIX_MCA_gds": "hash", "HOME": "/root"}
        self.assertEqual(run_environment(own), run_environment({}) | own)

    def test_what_mpirun_sets_stays_behind(self):
        """Inside of a job the run gets what it would get outside, and the user's settings, also options of mpirun."""
        if not is_open_mpi():
            self.skipTest("variables of Open MPI")
        own = {"OMPI_MCA_btl": "self,vader,tcp", "OMPI_MCA_orte_base_help_aggregate": "0", "PMIX_MCA_gds": "hash",
               "OMPI_MCA_mpi_yield_when_idle": "0", "OMPI_MCA_ess_base_verbose": "0", "HYDRA_IFACE": "lo",
               "OMP_WAIT_POLICY": "active"}
        program = "import json, os; print(json.dumps(dict(os.environ)))"
        done = subprocess.run([*outer(1, "--mca", "coll", "^hcoll", "--bind-to", "core"), "-c", program],
                              env=users_environment(1) | own, capture_output=True, text=True, timeout=60, check=True)
        inside = json.loads(done.stdout)
        self.assertIn("OMPI_MCA_ess_base_jobid", inside)
        left = {name: value for name, value in run_environment(inside).items() if name not in HARMLESS}
        expected = run_environment(users_environment(1) | own) | {"OMPI_MCA_coll": "^hcoll"}
        of_mpi = ("OMPI_", "OMP_", "PMIX_", "PMI_", "PRTE_", "HYDRA_")
        self.assertEqual({name: value for name, value in left.items() if name.startswith(of_mpi)},
                         {name: value for name, value in expected.items() if name.startswith(of_mpi)})

    def test_what_the_user_sets_for_pmix_is_handed_on(self):
        job = {"OMPI_COMM_WORLD_SIZE": "1"}
        self.assertNotIn("OMPI_MCA_pmix", run_environment(job | {"OMPI_MCA_pmix": "^s1,s2,cray,isolated"}))
        self.assertEqual(run_environment(job | {"OMPI_MCA_pmix": "ext3x"})["OMPI_MCA_pmix"], "ext3x")

    def test_what_slurm_sets_stays_behind(self):
        """Except the number of the job. A batch script is not a process of a job: its runs may use all nodes."""
        batch = {"SLURM_JOB_ID": "7", "SLURM_JOBID": "7", "SLURM_NODELIST": "a,b", "SLURM_PROCID": "0"}
        self.assertEqual(run_environment(batch), run_environment({}) | batch)
        left = run_environment(batch | {"SLURM_STEP_ID": "0", "SLURM_STEP_NUM_TASKS": "2"})
        self.assertEqual([name for name in left if name.startswith("SLURM")], ["SLURM_JOB_ID"])

    def test_what_mpich_sets_stays_behind(self):
        job = {"PMI_FD": "6", "PMI_RANK": "0", "PMI_SIZE": "2", "HYDI_CONTROL_FD": "7", "MPI_LOCALNRANKS": "2",
               "MPI_LOCALRANKID": "0"}
        self.assertFalse(set(job) & set(run_environment(job)))


if __name__ == "__main__":
    unittest.main()
