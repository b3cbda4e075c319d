# SPDX-License-Identifier: BSD-3-Clause
"""The exceptions that end a command, with the exit codes of trime_mpi."""
import pathlib

ROOT = pathlib.Path(__file__).resolve().parents[2]  # of the source tree

USAGE = 2         # command line or ini
FAILED = 4        # a run failed, or a file cannot be read or written
CHECK_FAILED = 5  # --compare found regressions; trime_mpi: stopped by the sweep cap


class HarnessError(Exception):
    """Ends the command with a message and an exit code."""
    code = FAILED


class UsageError(HarnessError):
    """The command line, the ini, or what it asks for is not there."""
    code = USAGE


class RunError(HarnessError):
    """A run that failed, or a file that is not as expected."""
