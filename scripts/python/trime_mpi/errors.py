# SPDX-License-Identifier: BSD-3-Clause
"""The exceptions of a run, with a class for each exit code of the program."""
import sys


class TrimeError(Exception):
    """A run that failed. `messages`: the errors that the program told, each with its place; `code`: its exit code;
    `output`: all that it printed."""
    code = 1

    def __init__(self, messages, code=None, output=""):
        super().__init__("\n".join(messages))
        self.messages = list(messages)
        self.code = type(self).code if code is None else code
        self.output = output


class InternalError(TrimeError):
    """Exit code 1, and all codes that have no class of their own."""


class ConfigError(TrimeError, ValueError):
    """Exit code 2: config or options; also fewer points than the boundary takes."""
    code = 2


class GeometryError(TrimeError, ValueError):
    """Exit code 3: the shape cannot be meshed."""
    code = 3


class FileError(TrimeError, OSError):
    """Exit code 4: a file cannot be read or written, or is no mesh file."""
    code = 4


class IncompleteError(TrimeError):
    """Exit code 5: stopped by the sweep cap, or a check failed. `mesh` is what was made, marked as incomplete."""
    code = 5
    mesh = None


class MemoryLimit(TrimeError, MemoryError):
    """Exit code 6: out of memory."""
    code = 6


class StoppedAtCheckpoint(TrimeError):
    """Exit code 75: the run stopped at a checkpoint, from which `trime_mpi --restart auto` goes on."""
    code = 75


class InterruptedRun(TrimeError):
    """The program was ended by a signal, whose number is `signal`."""
    code = 128

    @property
    def signal(self):
        """Number of the signal; 0 where mpirun has not told it."""
        return max(self.code - 128, 0)


class ProgramMissing(TrimeError, FileNotFoundError):
    """There is no trime_mpi, or no mpirun, to be started."""
    code = 127


def error_of(code, messages, output=""):
    """The exception of an exit code, those of signals (128 + n, or -n as subprocess has them) included."""
    if code < 0:
        code = 128 - code
    if code > 128:
        return InterruptedRun(messages, code, output)
    kinds = {kind.code: kind for kind in (ConfigError, GeometryError, FileError, IncompleteError, MemoryLimit,
                                          StoppedAtCheckpoint)}
    return kinds.get(code, InternalError)(messages, code, output)


def missing_module(error):
    """The error of an import again, with the way to install the module. error: ModuleNotFoundError."""
    name = (error.name or "").split(".")[0]
    return ModuleNotFoundError(f"trime_mpi needs the Python module '{name}', which {sys.executable} does not have; "
                               f"Debian: apt-get install python3-{name}, for /usr/bin/python3; elsewhere: pip install "
                               f"{name}", name=error.name)
