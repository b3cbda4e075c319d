# SPDX-License-Identifier: BSD-3-Clause
"""Runs the program, and raises its errors as exceptions."""
import collections.abc
import json
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import warnings as python_warnings

from .config import ini_text, override_texts, sections_of
from .environment import run_environment
from .errors import ConfigError, FileError, IncompleteError, ProgramMissing, TrimeError, error_of
from .read import read

ERROR, WARNING = "trime_mpi: error: ", "warning: "  # what lines of the program begin with
PATIENCE = 5                                        # seconds for a run to end after a signal


def find_program(program=None):
    """The program: as given, $TRIME_PROGRAM, on the PATH, or of the source tree in which this package lies."""
    built = pathlib.Path(__file__).resolve().parents[3] / "build" / "release" / "trime_mpi"
    for candidate in (program, os.environ.get("TRIME_PROGRAM"), "trime_mpi", built):
        found = shutil.which(candidate) if candidate else None
        if found:
            return os.path.abspath(found)
        if candidate and candidate is program:
            break
    raise ProgramMissing([f"there is no program {program}" if program else
                          "there is no trime_mpi on the PATH; install it, or give program=..., or set TRIME_PROGRAM"])


def find_launcher():
    """mpirun, or what $TRIME_MPIEXEC says."""
    for candidate in (os.environ.get("TRIME_MPIEXEC"), "mpirun", "mpiexec"):
        found = shutil.which(candidate) if candidate else None
        if found:
            return found
    raise ProgramMissing(["there is no mpirun on the PATH, which ranks > 1 need; set TRIME_MPIEXEC to the one of your "
                          "MPI"])


def end(process):
    """Ends a run and all that it has started, at the latest after some seconds; leaves no half file."""
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGKILL):
        try:
            os.killpg(process.pid, number)
            process.wait(PATIENCE)
            return
        except ProcessLookupError:
            return
        except subprocess.TimeoutExpired:
            continue


def run_to_end(command, verbose, timeout):
    """Exit code and output of a command; whatever ends the wait (Ctrl-C, a timeout) ends the command."""
    with tempfile.TemporaryFile("w+", encoding="utf-8", errors="replace") as out, \
            tempfile.TemporaryFile("w+", encoding="utf-8", errors="replace") as err:
        with subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=None if verbose else out, stderr=err,
                              env=run_environment(), start_new_session=True) as process:
            try:
                code = process.wait(timeout)
            except BaseException:
                end(process)
                raise
        texts = []
        for file in (out, err):
            file.seek(0)
            texts.append(file.read())
        return code, texts


def lines_after(start, text):
    """What stands behind `start` in the lines that begin with it."""
    return [line[len(start):] for line in text.splitlines() if line.startswith(start)]


def output_options(output, overwrite, directory):
    """Overrides of [output] for a file NAME.h5, or a directory of its own."""
    if output is None:
        return [f"output.directory={directory}", "output.name=mesh", "output.formats=xdmf", "output.interval=-1"]
    path = pathlib.Path(output)
    options = [f"output.directory={path.parent}",
               f"output.name={path.name[:-3] if path.suffix == '.h5' else path.name}"]
    return options + (["output.overwrite=true"] if overwrite else [])


def names_output(config):
    """Does a dict say where the mesh goes?"""
    return isinstance(config, collections.abc.Mapping) and "directory" in sections_of(config).get("output", {})


def read_report(path):
    """The report of a run, or an empty one where it has left none."""
    try:
        return json.loads(pathlib.Path(path).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}


def mesh(config, ranks=1, threads=None, program=None, *, output=None, overwrite=False, options=None, verbose=False,
         timeout=None):
    """Runs trime_mpi, and returns the Mesh.

    config: the path of an ini, or a dict {section: {key: value}} with the keys of configs/keys.md. In a dict a part
    may have `rings` in place of a file: a ring [k,2] or a list of them, or polygons of shapely, geopandas and others
    that have __geo_interface__. `fixed_points` may be an array [k,2]. Sizes are formulas; they cannot be arrays or
    functions yet. Paths in a dict are relative to the working directory, in an ini and its options to the ini.
    options: overrides {"section.key": value}. ranks: more than one start by mpirun. threads: of each rank. output:
    NAME.h5, which stays; without it (and without [output] directory in a dict) the run works in a temporary directory,
    and only the arrays remain. verbose: the program's messages and progress are shown. timeout: seconds.

    A program that mpirun has started may call this too. Each rank that calls it starts a run of its own, and waits for
    no other rank; ranks that write a file need different names. Where one rank alone makes the mesh, hand errors to the
    others, or start Python with `-m mpi4py`: a rank that raises does not end those that wait for it.

    Raises subprocess.TimeoutExpired, and the errors of the program: ConfigError, GeometryError, FileError,
    IncompleteError (which has the mesh), MemoryLimit, InterruptedRun, InternalError. Its warnings become Python's, and
    Mesh.warnings. Ctrl-C ends the run.
    """
    if int(ranks) < 1:
        raise ConfigError([f"ranks={ranks}: expected 1 or more"])
    command = [] if int(ranks) == 1 else [find_launcher(), "-n", str(int(ranks))]
    command.append(find_program(program))
    with tempfile.TemporaryDirectory(prefix="trime-") as work:
        if isinstance(config, collections.abc.Mapping):
            path = os.path.join(work, "config.ini")
            pathlib.Path(path).write_text(ini_text(config, work), encoding="utf-8")
        else:
            path = os.fspath(config)
        report = os.path.join(work, "report.json")
        command += [path] + override_texts(options or {}, not isinstance(config, collections.abc.Mapping))
        if output is not None or not names_output(config):
            command += output_options(output, overwrite, os.path.join(work, "out"))
        elif overwrite:
            command.append("output.overwrite=true")
        command += ["--report", report] + ([] if verbose else ["--quiet"])
        if threads is not None:
            command += ["--threads", str(int(threads))]
        code, (out, err) = run_to_end(command, verbose, timeout)
        told = [line.replace(work + os.sep, "") for line in lines_after(WARNING, out)]
        files = [name for name in read_report(report).get("files", []) if name.endswith(".h5")]
        if code in (0, IncompleteError.code) and files:
            made = read(files[0])
        elif code == 0:
            raise FileError(["the run wrote no mesh file: [output] interval is 0, or its formats have none"], 0, out)
        else:
            made = None
        messages = [line.replace(work + os.sep, "") for line in lines_after(ERROR, err)]
    if made is not None:
        made.warnings = told
    if code != 0:
        raise failed(code, messages or [*told[-1:]] or [(out + err).strip() or f"trime_mpi ended with {code}"],
                     out + err, made)
    for warning in told:
        python_warnings.warn(warning, stacklevel=2)
    return made


def failed(code, messages, output, made) -> TrimeError:
    """The exception of a run, with the mesh where there is one."""
    error = error_of(code, messages, output)
    if isinstance(error, IncompleteError):
        error.mesh = made
    return error
