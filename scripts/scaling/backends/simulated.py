# SPDX-License-Identifier: BSD-3-Clause
"""Runs cases on a simulated cluster, on one core, by scripts/simulate_cluster.sh, which needs SimGrid."""
import os
import subprocess

from ..errors import ROOT, UsageError
from .process import mesh_arguments, run_command

SCRIPT = ROOT / "scripts" / "simulate_cluster.sh"


class Simulated:
    """Simulated ranks of one thread each; seconds are those of the simulated cluster."""
    name = "simulated"

    def __init__(self, cluster):
        self.cluster = cluster and cluster.resolve()
        self.hashes = {}  # by arguments: that of the real run with which the script compares a first simulated one
        if not os.access(SCRIPT, os.X_OK):
            raise UsageError(f"there is no simulator: expected {SCRIPT}, found none")
        done = subprocess.run([str(SCRIPT), "--ranks", "1", *self.cluster_option(), "--build-only"], text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
        if done.returncode != 0:
            raise UsageError(f"the simulator cannot be built: exit code {done.returncode} from {SCRIPT} --build-only\n"
                             f"{done.stdout.strip()}")

    def cluster_option(self):
        return ["--cluster", str(self.cluster)] if self.cluster else []

    def check(self, cases):
        """Raises UsageError for threads."""
        for case in cases:
            if case.threads != 1:
                raise UsageError(f"simulated ranks have one thread each; found the case {case.layout} in {case.sweep}")

    def oversubscribed(self, case):
        """Never: there is no end of simulated cores."""
        return False

    def describe(self):
        """For the machine block."""
        return f"simulated by {SCRIPT.name}, cluster {self.cluster or 'of the script'}; seconds are simulated"

    def run(self, case, record, limit):
        """One run; `record` is where its numbers go. Raises RunError."""
        arguments = mesh_arguments(case, record.parent)
        known = self.hashes.get(tuple(arguments))
        command = [str(SCRIPT), "--ranks", str(case.ranks), *self.cluster_option(), "--report", str(record),
                   *(["--hash", known] if known else []), *arguments]
        run = run_command(command, record, {}, limit)
        self.hashes[tuple(arguments)] = run["mesh_hash"]
        return run
