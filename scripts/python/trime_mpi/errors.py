# SPDX-License-Identifier: BSD-3-Clause
"""The exceptions of a run, with a class for each exit code of the program."""
import sys


class TrimeError(Exception):
    """A run has failed.

    messages holds the errors of the program, each with its place. code is the exit code, and output is all that the
    program has printed.
    """
    code = 1

    def __init__(self, messages, code=None, output=""):
        super().__init__("\n".join(messages))
        self.messages = list(messages)
        self.code = type(self).code if code is None else code
        self.output = output


class InternalError(TrimeError):
    """The program ended with exit code 1, or with a code that has no other class."""


class ConfigError(TrimeError, ValueError):
    """Exit code 2: the config or the options are wrong, or there are fewer points than the boundary needs."""
    code = 2


class GeometryError(TrimeError, ValueError):
    """Exit code 3: the shape cannot be meshed."""
    code = 3


class FileError(TrimeError, OSError):
    """Exit code 4: a file cannot be read or written, or is not a mesh file."""
    code = 4


class IncompleteError(TrimeError):
    """Exit code 5: the run stopped at its largest number of sweeps, or a check failed. mesh is the result, which is
    marked as incomplete."""
    code = 5
    mesh = None


class MemoryLimit(TrimeError, MemoryError):
    """Exit code 6: the memory did not suffice."""
    code = 6


class StoppedAtCheckpoint(TrimeError):
    """Exit code 75: the run stopped at a checkpoint. `trime_mpi --restart auto` continues it."""
    code = 75


class InterruptedRun(TrimeError):
    """A signal ended the program; signal is its number."""
    code = 128

    @property
    def signal(self):
        """The number of the signal, or 0 if mpirun did not report it."""
        return max(self.code - 128, 0)


class ProgramMissing(TrimeError, FileNotFoundError):
    """There is no trime_mpi or no mpirun to start."""
    code = 127


def error_of(code, messages, output=""):
    """Returns the exception for an exit code. Signals have the codes 128 + n, or -n as in subprocess."""
    if code < 0:
        code = 128 - code
    if code > 128:
        return InterruptedRun(messages, code, output)
    kinds = {kind.code: kind for kind in (ConfigError, GeometryError, FileError, IncompleteError, MemoryLimit,
                                          StoppedAtCheckpoint)}
    return kinds.get(code, InternalError)(messages, code, output)


def missing_module(error):
    """Returns an import error that says how to install the module. error: the ModuleNotFoundError."""
    name = (error.name or "").split(".")[0]
    return ModuleNotFoundError(f"trime_mpi needs the Python module '{name}', which {sys.executable} does not have; "
                               f"Debian: apt-get install python3-{name}, for /usr/bin/python3; elsewhere: pip install "
                               f"{name}", name=error.name)
