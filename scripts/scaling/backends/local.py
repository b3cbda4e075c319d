# SPDX-License-Identifier: BSD-3-Clause
"""Runs cases under mpirun, on this machine or on the nodes of the SLURM job in which the script runs."""
import os
import shutil

from ..errors import UsageError
from ..machine import cores_per_node, shell
from .process import mesh_arguments, run_command


class Local:
    """mpirun with a block of cores for each rank; without binding where the cores do not suffice. Options of mpirun are
    those of Open MPI, or of the Hydra of MPICH and others, which hands the whole environment on."""
    name = "local"

    def __init__(self, program):
        if not os.access(program, os.X_OK):
            raise UsageError(f"expected the program at {program}, found none; scripts/run.sh builds it, or name one "
                             "with --program")
        if not shutil.which("mpirun"):
            raise UsageError("there is no mpirun on the path; load the module of your MPI")
        self.program = program
        self.nodes = cores_per_node()
        self.is_open_mpi = "Open MPI" in shell("mpirun", "--version")

    def oversubscribed(self, case):
        """More threads than cores, or a rank that no node can hold."""
        return sum(cores // case.threads for cores in self.nodes) < case.ranks

    def check(self, cases):
        """All cases can be tried."""

    def describe(self):
        """For the machine block."""
        return "mpirun, a block of cores for each rank, threads close together; not bound where oversubscribed"

    def command(self, case, record):
        """mpirun and the program with all its arguments."""
        start = ["mpirun", "-np", str(case.ranks)]
        if self.is_open_mpi:
            start += ["-x", "OMP_NUM_THREADS", "-x", "OMP_PROC_BIND", "-x", "OMP_PLACES"]
        if self.oversubscribed(case):
            start += ["--oversubscribe", "--bind-to", "none"] if self.is_open_mpi else ["-bind-to", "none"]
        elif self.is_open_mpi:
            per_node = min(case.ranks, min(self.nodes) // case.threads)
            start += ["--map-by", f"ppr:{per_node}:node:PE={case.threads}", "--bind-to", "core"]
        else:
            start += ["-bind-to", f"core:{case.threads}"]
        return start + [str(self.program), "--quiet", "--report", str(record)] + mesh_arguments(case, record.parent)

    def run(self, case, record, limit):
        """One run; `record` is where its numbers go. Raises RunError."""
        environment = {"OMP_NUM_THREADS": str(case.threads), "OMP_PLACES": "cores",
                       "OMP_PROC_BIND": "false" if self.oversubscribed(case) else "close",
                       # A fixed number of sweeps ends with an exit code. Open MPI then gives ranks that have ended two
                       # seconds to end in.
                       "OMPI_MCA_odls_base_sigkill_timeout": "0"}
        if os.geteuid() == 0:
            environment |= {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
        return run_command(self.command(case, record), record, environment, limit)
