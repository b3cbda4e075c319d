# SPDX-License-Identifier: BSD-3-Clause
"""Runs trime_mpi for the system tests. The program and mpirun come from the environment that ctest sets."""
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("TRIME_PROGRAM", str(ROOT / "build" / "ci" / "trime_mpi"))
MPIEXEC = os.environ.get("TRIME_MPIEXEC", "mpirun")
# Seconds until a run counts as hanging. Ranks that share a core with many others wait for each other in every exchange:
# a run of 4 s on an idle machine has taken 140 s beside 14 busy processes.
PATIENCE = 600


# Open MPI starts faster by 0.2 s if it looks for no network. Singletons keep their daemons: without them
# (ess_singleton_isolated), all processes of a machine share one directory, and fail where they make and remove it.
QUICK_START = {"OMPI_MCA_pml": "ob1", "OMPI_MCA_btl": "self,vader", "OMPI_MCA_osc": "^ucx"}


def environment(threads):
    """Returns the environment in which tests start the program: that of `users_environment`, with a quick start."""
    return users_environment(threads) | QUICK_START


def users_environment(threads):
    """Returns the environment for more ranks and threads than cores, also as root in a container."""
    return dict(os.environ, OMP_NUM_THREADS=str(threads), OMP_WAIT_POLICY="passive", OMPI_ALLOW_RUN_AS_ROOT="1",
                OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1", OMPI_MCA_rmaps_base_oversubscribe="1",
                OMPI_MCA_hwloc_base_binding_policy="none", OMPI_MCA_mpi_yield_when_idle="1")


def command(arguments, ranks):
    """Returns the command line. One rank runs without mpirun."""
    start = [] if ranks == 1 else [MPIEXEC, "-np", str(ranks)]
    return start + [PROGRAM] + [str(argument) for argument in arguments]


def run(*arguments, ranks=1, threads=1, timeout=PATIENCE, cwd=None):
    """Returns a finished run: returncode, stdout, stderr. Open MPI waits a second, twice, for ranks to end after a
    failure; here it does not."""
    at_once = {"OMPI_MCA_odls_base_sigkill_timeout": "0"}
    return subprocess.run(command(arguments, ranks), env=environment(threads) | at_once, cwd=cwd, capture_output=True,
                          text=True, timeout=timeout, check=False)


class Workspace:
    """A separate directory for a test, which is removed at the end of the test."""

    def __enter__(self):
        self.path = pathlib.Path(tempfile.mkdtemp(prefix="trime-system-"))
        return self.path

    def __exit__(self, *_):
        shutil.rmtree(self.path, ignore_errors=True)


class WorkspaceCase(unittest.TestCase):
    """Tests that each have a separate directory, `self.directory`."""

    def setUp(self):
        self.space = Workspace()
        self.directory = self.space.__enter__()

    def tearDown(self):
        self.space.__exit__(None, None, None)

    def write(self, name, *lines):
        """Writes lines of points as text, as `.xy` files hold curves and rings."""
        text = "\n\n".join("\n".join(f"{x!r} {y!r}" for x, y in line) for line in lines)
        (self.directory / name).write_text(text + "\n")
