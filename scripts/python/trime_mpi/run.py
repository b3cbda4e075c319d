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

ERROR, WARNING = "trime_mpi: error: ", "warning: "  # the beginnings of lines of the program
PATIENCE = 5                                        # seconds in which a run must end after a signal


def find_program(program=None):
    """Returns the path of the program: the given one, $TRIME_PROGRAM, the one on the PATH, or the one of the source
    tree that holds this package."""
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
    """Returns the path of $TRIME_MPIEXEC, mpirun or mpiexec, the first that exists."""
    for candidate in (os.environ.get("TRIME_MPIEXEC"), "mpirun", "mpiexec"):
        found = shutil.which(candidate) if candidate else None
        if found:
            return found
    raise ProgramMissing(["there is no mpirun on the PATH, which ranks > 1 need; set TRIME_MPIEXEC to the one of your "
                          "MPI"])


def end(process):
    """Stops a run and all processes that it has started, after some seconds at the latest. The run leaves no incomplete
    file."""
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
    """Returns the exit code and the output of a command. If something ends the wait, such as Ctrl-C or the timeout, the
    command is stopped."""
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
    """Returns the rest of each line that begins with `start`."""
    return [line[len(start):] for line in text.splitlines() if line.startswith(start)]


def output_options(output, overwrite, directory):
    """Returns the overrides of [output] for a file NAME.h5, or for the directory of a run without one."""
    if output is None:
        return [f"output.directory={directory}", "output.name=mesh", "output.formats=xdmf", "output.interval=-1"]
    path = pathlib.Path(output)
    options = [f"output.directory={path.parent}",
               f"output.name={path.name[:-3] if path.suffix == '.h5' else path.name}"]
    return options + (["output.overwrite=true"] if overwrite else [])


def names_output(config):
    """True if the config is a dict that names the directory of the mesh."""
    return isinstance(config, collections.abc.Mapping) and "directory" in sections_of(config).get("output", {})


def read_report(path):
    """Returns the report of a run, or an empty one if the run has left none."""
    try:
        return json.loads(pathlib.Path(path).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}


def mesh(config, ranks=1, threads=None, program=None, *, output=None, overwrite=False, options=None, verbose=False,
         timeout=None):
    """Runs trime_mpi, and returns the Mesh.

    config is the path of an ini file, or a dict {section: {key: value}} with the keys of configs/keys.md. In a dict a
    part may have `rings` instead of a file: one ring [k,2], a list of rings, or polygons of shapely, geopandas and
    others that have __geo_interface__. `fixed_points` may be an array [k,2]. A key with several values takes a list,
    such as {"output": {"accept": ["adcirc", "fvcom"], "open_boundary": ["open sea", "river"]}}. Then the Mesh has
    `verdicts`. Sizes are formulas; they cannot be arrays or functions yet. Paths in a dict are relative to the working
    directory. Paths in an ini file, and in the options for it, are relative to the ini file.

      ranks       number of MPI ranks (default: 1); mpirun starts them if there are more than one
      threads     number of threads of each rank (default: OMP_NUM_THREADS, or all cores)
      program     path of trime_mpi (default: $TRIME_PROGRAM, or the one on the PATH)
      output      path NAME.h5 of the mesh file; without it, and without a directory in [output] of a dict, the run
                  works in a temporary directory, and only the arrays remain
      overwrite   replace files that exist
      options     overrides {"section.key": value}
      verbose     show the messages and the progress of the program
      timeout     largest number of seconds

    A program that mpirun has started may call this, too. Each rank that calls it starts a separate run, and waits for
    no other rank. If several ranks write files, the files need different names. If only one rank calls it and others
    wait for the mesh, that rank must send errors to them, or Python must be started with `-m mpi4py`: an exception on
    one rank does not end the ranks that wait for it.

    Raises the errors of the program: ConfigError, GeometryError, FileError, IncompleteError (which has the mesh),
    MemoryLimit, StoppedAtCheckpoint, InterruptedRun, InternalError. Raises ProgramMissing if there is no program or no
    mpirun, and subprocess.TimeoutExpired. The warnings of the program become warnings of Python, and are in
    Mesh.warnings. Ctrl-C stops the run.
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
        warned = [line.replace(work + os.sep, "") for line in lines_after(WARNING, out)]
        files = [name for name in read_report(report).get("files", []) if name.endswith(".h5")]
        if code in (0, IncompleteError.code) and files:
            made = read(files[0])
        elif code == 0:
            raise FileError(["the run wrote no mesh file: [output] interval is 0, or its formats have none"], 0, out)
        else:
            made = None
        messages = [line.replace(work + os.sep, "") for line in lines_after(ERROR, err)]
    if made is not None:
        made.warnings = warned
    if code != 0:
        raise failed(code, messages or [*warned[-1:]] or [(out + err).strip() or f"trime_mpi ended with {code}"],
                     out + err, made)
    for warning in warned:
        python_warnings.warn(warning, stacklevel=2)
    return made


def failed(code, messages, output, made) -> TrimeError:
    """Returns the exception of a run, with the mesh if the run has made one."""
    error = error_of(code, messages, output)
    if isinstance(error, IncompleteError):
        error.mesh = made
    return error
