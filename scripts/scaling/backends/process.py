# SPDX-License-Identifier: BSD-3-Clause
"""Runs one command that makes a mesh and writes its record."""
import os
import signal
import subprocess
import time

from ..errors import ROOT, RunError
from ..record import read_record

GRACE = 10          # seconds for a command to end by itself
STOPPED_BY_CAP = 5  # exit code of trime_mpi: the mesh is made and marked


def end(process):
    """Ends a command and all that it has started."""
    os.killpg(process.pid, signal.SIGTERM)
    try:
        process.communicate(timeout=GRACE)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        process.communicate()


def run_command(command, record, environment, limit):
    """Runs a command that writes `record`; returns the run, with the wall time of the whole command.

    Raises RunError with the output of the command where it fails, or lasts longer than `limit` seconds.
    """
    record.unlink(missing_ok=True)
    start = time.monotonic()
    with subprocess.Popen(command, env=os.environ | environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True, errors="replace", start_new_session=True) as process:
        try:
            output, _ = process.communicate(timeout=limit)
        except subprocess.TimeoutExpired as error:
            end(process)
            raise RunError(f"no end after {limit} s: {' '.join(command)}") from error
        except KeyboardInterrupt:
            end(process)
            raise
    wall = time.monotonic() - start
    if process.returncode not in (0, STOPPED_BY_CAP):
        raise RunError(f"exit code {process.returncode} from {' '.join(command)}\n{output.strip()}")
    return read_record(record) | {"exit_code": process.returncode, "command": " ".join(command), "command_s": wall}


def mesh_arguments(case, directory):
    """Config and overrides of a case for trime_mpi. A mesh file, if the case wants one, goes into the directory."""
    output = [f"output.directory={directory}", "output.name=mesh", "output.overwrite=true"]
    return [str(ROOT / case.config), f"meshing.points={case.points_asked}",
            "meshing.edge_length=",  # takes the length of the config away, if it has one
            *(output if case.output else ["output.interval=0"]), *case.options]
