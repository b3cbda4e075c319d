# SPDX-License-Identifier: BSD-3-Clause
"""Describes the machine on which the times are measured: processor, cores, memory, software, environment, load."""
import datetime
import os
import pathlib
import platform
import re
import subprocess

from .errors import ROOT

ENVIRONMENT = ("OMP_", "OMPI_", "GOMP_", "KMP_", "SLURM_", "TRIME_", "MPICH_", "I_MPI_", "UCX_")


def shell(*command):
    """Output of a command, or 'unknown'."""
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=True, timeout=30)
        return done.stdout.strip() or "unknown"
    except (OSError, subprocess.SubprocessError):
        return "unknown"


def slurm_cores(text):
    """CPUs on each node as SLURM writes them: '16(x2),8' is [16, 16, 8]."""
    counts = []
    for part in filter(None, text.split(",")):
        count, times = re.fullmatch(r"(\d+)(?:\(x(\d+)\))?", part).groups()
        counts += [int(count)] * int(times or 1)
    return counts


def cores_per_node():
    """Cores that may be used, per node: SLURM's word, else physical cores of this machine within the CPU mask."""
    given = slurm_cores(os.environ.get("SLURM_JOB_CPUS_PER_NODE", ""))
    if given:
        return given
    allowed = os.sched_getaffinity(0)
    lines = [line.split(",") for line in shell("lscpu", "-p=CPU,CORE,SOCKET").splitlines() if line[:1].isdigit()]
    cores = {(core, socket) for cpu, core, socket in lines if int(cpu) in allowed}
    return [len(cores) or len(allowed)]


def compile_flags(program):
    """Returns the flags from the CMake cache next to the program, or 'unknown' for an installed program."""
    cache = pathlib.Path(program).resolve().parent / "CMakeCache.txt"
    try:
        entries = dict(re.findall(r"^([\w]+):\w+=(.*)$", cache.read_text(encoding="utf-8"), re.MULTILINE))
    except OSError:
        return "unknown"
    kind = entries.get("CMAKE_BUILD_TYPE", "")
    flags = [entries.get("CMAKE_CXX_FLAGS", ""), entries.get(f"CMAKE_CXX_FLAGS_{kind.upper()}", "")]
    options = [f"{key}={value}" for key, value in entries.items() if key == "TRIME_NATIVE"]
    return " ".join(filter(None, [kind, *flags, *options]))


def machine_block(program):
    """What a reader needs to judge the times, by name."""
    cpu = re.search(r"Model name:\s*(.*)", shell("lscpu"))
    memory = re.search(r"MemTotal:\s*(\d+)", pathlib.Path("/proc/meminfo").read_text(encoding="utf-8"))
    kib_per_gib = 2**20
    return {
        "date": datetime.datetime.now(datetime.timezone.utc).isoformat(timespec="seconds"),
        "host": platform.node(),
        "processor": cpu.group(1) if cpu else "unknown",
        "cores_per_node": cores_per_node(),
        "memory_gib": round(int(memory.group(1)) / kib_per_gib, 1) if memory else None,
        "kernel": platform.release(),
        "load_average": os.getloadavg()[0],
        "program": "; ".join(" ".join(line.split()) for line in shell(str(program), "--version").splitlines()),
        "compile_flags": compile_flags(program),
        "mpirun": shell("mpirun", "--version").splitlines()[0],
        "source": shell("git", "-C", str(ROOT), "describe", "--always", "--dirty=-changed", "--abbrev=12"),
        "environment": {key: value for key, value in sorted(os.environ.items()) if key.startswith(ENVIRONMENT)},
    }
