#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Scaling table: the same mesh on several numbers of ranks and threads; --weak: the same number of points per core.

Runs trime_mpi for every case and number of points (one warm-up run dropped, then --repeats runs, all cases in turn),
reads times from the mesh files that it writes, and makes scaling.md, scaling.csv and runs.jsonl in the output
directory. The efficiency is T1 / (p Tp): T of the base case (the one with fewest cores), p = ranks x threads. A case
with more threads than there are cores is marked and gets no efficiency. Every row carries the mesh hash: all rows of
one size must agree. With --weak a case gets --points times its cores, and the efficiency is T1/Tp.

  scripts/scaling.py --cases 1x1,1x2,2x1 --points 1e5,1e6
  scripts/scaling.py --config my.ini --points 1e7 --cases 1x16,2x8,16x1 meshing.max_sweeps=20
"""
import argparse
import csv
import datetime
import json
import os
import pathlib
import platform
import re
import shutil
import statistics
import subprocess
import sys
import time

try:
    import h5py
except ImportError:
    sys.exit("scaling.py needs the Python module h5py. Debian: apt-get install python3-h5py (for /usr/bin/python3)")

ROOT = pathlib.Path(__file__).resolve().parent.parent
STOPPED_BY_CAP = 5  # exit code of trime_mpi: the mesh is written and marked


def shell(*command):
    """Output of a command, or 'unknown'."""
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=True, timeout=30)
        return done.stdout.strip() or "unknown"
    except (OSError, subprocess.SubprocessError):
        return "unknown"


def slurm_cpus_per_node():
    """CPUs that SLURM gave on each node, e.g. [16, 16] from '16(x2)'; empty outside of SLURM."""
    counts = []
    for part in filter(None, os.environ.get("SLURM_JOB_CPUS_PER_NODE", "").split(",")):
        count, times = re.fullmatch(r"(\d+)(?:\(x(\d+)\))?", part).groups()
        counts += [int(count)] * int(times or 1)
    return counts


def cores_per_node():
    """Cores that may be used, per node: SLURM's word, else physical cores of this machine within the CPU mask."""
    if slurm_cpus_per_node():
        return slurm_cpus_per_node()
    allowed = os.sched_getaffinity(0)
    lines = [line.split(",") for line in shell("lscpu", "-p=CPU,CORE,SOCKET").splitlines() if line[:1].isdigit()]
    cores = {(core, socket) for cpu, core, socket in lines if int(cpu) in allowed}
    return [len(cores) or len(allowed)]


def machine_block(program):
    """What a reader needs to judge the times."""
    cpu = re.search(r"Model name:\s*(.*)", shell("lscpu"))
    memory = re.search(r"MemTotal:\s*(\d+)", pathlib.Path("/proc/meminfo").read_text(encoding="utf-8"))
    interesting = ("OMP_", "OMPI_", "SLURM_", "GOMP_")
    return {
        "date": datetime.datetime.now(datetime.timezone.utc).isoformat(timespec="seconds"),
        "host": platform.node(),
        "cpu": cpu.group(1) if cpu else "unknown",
        "cores_per_node": cores_per_node(),
        "memory_gib": round(int(memory.group(1)) / 2**20, 1) if memory else None,
        "kernel": platform.release(),
        "load_average_at_start": os.getloadavg()[0],
        "program": "; ".join(" ".join(line.split()) for line in shell(str(program), "--version").splitlines()),
        "mpirun": shell("mpirun", "--version").splitlines()[0],
        "git_commit": shell("git", "-C", str(ROOT), "describe", "--always", "--dirty=-changed", "--abbrev=12"),
        "environment": {key: value for key, value in sorted(os.environ.items()) if key.startswith(interesting)},
    }


def text_of(value):
    """An HDF5 attribute as plain Python."""
    if isinstance(value, bytes):
        return value.decode()
    return value.item() if hasattr(value, "item") and getattr(value, "size", 1) == 1 else value


def read_record(path):
    """What the program wrote about a run: points, sweeps, hash, memory, seconds per section."""
    with h5py.File(path, "r") as file:
        about = file["trime_mpi"]
        attributes = {key: text_of(value) for key, value in about.attrs.items()}
        timers = about["timers"]
        phases = {text_of(name).strip("\0 "): {"avg": float(average), "max": float(longest)} for name, average, longest
                  in zip(timers["name"][:], timers["avg"][:], timers["max"][:])}
        record = {"points": int(file["VTKHDF/NumberOfPoints"][0]), "triangles": int(file["VTKHDF/NumberOfCells"][0])}
    mesh_hash = attributes.get("mesh_hash", "")
    record["mesh_hash"] = mesh_hash if isinstance(mesh_hash, str) else f"{int(mesh_hash) & (2**64 - 1):016x}"
    record["sweeps"] = attributes.get("iterations", attributes.get("sweeps"))
    record["stop_reason"] = attributes.get("stop_reason", "")
    record["bytes_per_point"] = attributes.get("bytes_per_point")
    record["phases"] = phases
    record["seconds"] = float(attributes.get("seconds_total", sum(phase["avg"] for phase in phases.values())))
    return record


def command_for(options, case, points, directory):
    """mpirun with one block of cores per rank; without binding where the cores do not suffice."""
    ranks, threads = case
    command = ["mpirun", "-np", str(ranks), "-x", "OMP_NUM_THREADS", "-x", "OMP_PROC_BIND", "-x", "OMP_PLACES"]
    if oversubscribed(case):
        command += ["--oversubscribe", "--bind-to", "none"]
    else:
        per_node = min(ranks, min(cores_per_node()) // threads)
        command += ["--map-by", f"ppr:{per_node}:node:PE={threads}", "--bind-to", "core"]
    return command + [str(options.program), str(options.config), f"meshing.points={points}",
                      "meshing.edge_length=",  # takes the length of the config away, if it has one
                      "output.name=scaling", f"output.directory={directory}", "output.overwrite=true", "output.formats=vtkhdf",
                      "--quiet"] + options.overrides


def oversubscribed(case):
    """More threads than cores, or a rank that no node can hold."""
    nodes = cores_per_node()
    return sum(count // case[1] for count in nodes) < case[0]


def run_once(options, case, points):
    """One run: its record, with the wall time of the whole command beside."""
    directory = options.output / "work"
    mesh = directory / "scaling.h5"
    mesh.unlink(missing_ok=True)
    environment = dict(os.environ, OMP_NUM_THREADS=str(case[1]),
                       OMP_PROC_BIND="false" if oversubscribed(case) else "close", OMP_PLACES="cores")
    if os.geteuid() == 0:
        environment |= {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    command = command_for(options, case, points, directory)
    start = time.monotonic()
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    wall = time.monotonic() - start
    if done.returncode not in (0, STOPPED_BY_CAP) or not mesh.exists():
        sys.exit(f"scaling.py: exit code {done.returncode} from {' '.join(command)}\n{done.stdout}{done.stderr}")
    return read_record(mesh) | {"ranks": case[0], "threads": case[1], "points_asked": points, "wall_seconds": wall,
                                "exit_code": done.returncode, "command": " ".join(command)}


def summarise(runs, case, points):
    """One row of the table from the runs of one case."""
    times = sorted(run["seconds"] for run in runs)
    last = runs[-1]
    names = list(last["phases"])
    memory = [run["bytes_per_point"] for run in runs if run["bytes_per_point"] is not None]
    return {
        "points_asked": points, "ranks": case[0], "threads": case[1], "cores": case[0] * case[1],
        "oversubscribed": oversubscribed(case), "repeats": len(runs),
        "median_s": statistics.median(times), "min_s": times[0], "max_s": times[-1],
        "command_s": statistics.median(run["wall_seconds"] for run in runs), "speedup": None, "efficiency": None,
        "points": last["points"], "triangles": last["triangles"], "sweeps": last["sweeps"],
        "stop_reason": last["stop_reason"], "points_per_s": last["points"] / max(statistics.median(times), 1e-9),
        "bytes_per_point": max(memory) if memory else None,
        "mesh_hash": "/".join(sorted({run["mesh_hash"] for run in runs})), "same_mesh": None,
        "phases": {name: statistics.median(run["phases"].get(name, {"avg": 0.0})["avg"] for run in runs)
                   for name in names},
    }


def compare(rows):
    """Fills speed-up (in points per second), efficiency and the verdict on the hash, for the rows of one size."""
    base = min(rows, key=lambda row: row["cores"])
    for row in rows:
        hashes = {other["mesh_hash"] for other in rows if other["points_asked"] == row["points_asked"]}
        row["same_mesh"] = "OK" if len(hashes) == 1 and "/" not in row["mesh_hash"] else "MISMATCH"
        work = row["points_asked"] / base["points_asked"]  # 1 but for --weak
        row["speedup"] = work * base["median_s"] / max(row["median_s"], 1e-9)
        if not row["oversubscribed"]:
            row["efficiency"] = row["speedup"] * base["cores"] / row["cores"]


def points_of(options, case, points):
    """How many points a case is asked for."""
    return points * case[0] * case[1] if options.weak else points


def markdown_table(head, rows):
    """Lines of a Markdown table."""
    return ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)] + ["| " + " | ".join(row) + " |" for row in rows]


def number(value, form):
    """A number as text, or n/a."""
    return "n/a" if value is None else format(value, form)


def scaling_table(rows):
    """The table of times."""
    body = []
    for row in rows:
        efficiency = "n/a (more threads than cores)" if row["oversubscribed"] else number(row["efficiency"], ".2f")
        body.append([f"{row['points_asked']:,}", f"{row['ranks']} x {row['threads']}", number(row["median_s"], ".3f"),
                     f"{row['min_s']:.3f} - {row['max_s']:.3f}", number(row["command_s"], ".2f"),
                     number(row["speedup"], ".2f"), efficiency, str(row["sweeps"]), f"{row['points_per_s']:.3g}",
                     number(row["bytes_per_point"], ".0f"), row["mesh_hash"], row["same_mesh"]])
    return markdown_table(["points", "ranks x threads", "median s", "min - max s", "command s", "speed-up", "efficiency",
                           "sweeps", "points/s", "bytes/point", "mesh_hash", "same mesh"], body)


def phase_table(rows):
    """Seconds per section of the program (mean over ranks, median over runs)."""
    names = list(dict.fromkeys(name for row in rows for name in row["phases"]))
    body = [[f"{row['points_asked']:,}", f"{row['ranks']} x {row['threads']}"] +
            [number(row["phases"].get(name), ".3f") for name in names] for row in rows]
    return markdown_table(["points", "ranks x threads"] + names, body)


def report(rows, machine, options):
    """The whole Markdown text."""
    about = [f"* {key.replace('_', ' ')}: {value}" for key, value in machine.items() if key != "environment"]
    environment = " ".join(f"{key}={value}" for key, value in machine["environment"].items()) or "none"
    return "\n".join([
        f"# {'Weak' if options.weak else 'Strong'} scaling: {options.config.name}", "",
        f"Median of {options.repeats} runs after one that is dropped. Seconds are those of the program from its "
        "start to the writing of the mesh file; 'command s' is the wall clock of the whole command, with start of MPI "
        "and output."
        + (f" Overrides: {' '.join(options.overrides)}." if options.overrides else ""), "",
        *scaling_table(rows), "", "## Seconds by section (mean over ranks)", "", *phase_table(rows), "",
        "## Machine", "",
        *about, f"* environment: {environment}", ""])


def write_csv(path, rows):
    """One line per case, sections as columns phase_NAME."""
    names = list(dict.fromkeys(name for row in rows for name in row["phases"]))
    plain = [key for key in rows[0] if key != "phases"]
    with path.open("w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream)
        writer.writerow(plain + ["phase_" + name.replace(" ", "_") for name in names])
        for row in rows:
            writer.writerow([row[key] for key in plain] + [row["phases"].get(name, "") for name in names])


def measure(options, machine):
    """All runs, warm-ups apart; returns the rows and writes every run to runs.jsonl as it ends."""
    rows = []
    with (options.output / "runs.jsonl").open("w", encoding="utf-8") as stream:
        for points in options.points:
            runs = [[] for _ in options.cases]
            for repeat in range(options.repeats + 1):  # in turn, so that a drift of the machine meets all cases alike
                for case, of_this_case in zip(options.cases, runs):
                    print(f"{points} points, {case[0]} x {case[1]}, "
                          + (f"run {repeat} of {options.repeats}" if repeat else "warm-up"), file=sys.stderr, flush=True)
                    run = run_once(options, case, points_of(options, case, points))
                    if repeat:
                        of_this_case.append(run)
                        stream.write(json.dumps(run | {"machine": machine}) + "\n")
                        stream.flush()
            of_this_size = [summarise(of_this_case, case, points_of(options, case, points))
                            for case, of_this_case in zip(options.cases, runs)]
            compare(of_this_size)
            rows += of_this_size
    return rows


def case_list(text):
    """'1x1,2x4' -> [(1, 1), (2, 4)]."""
    cases = [re.fullmatch(r"([1-9]\d*)x([1-9]\d*)", part.strip()) for part in text.split(",")]
    if not all(cases):
        raise argparse.ArgumentTypeError(f"'{text}' is not like 1x1,1x2,2x1 (ranks x threads)")
    return [(int(case[1]), int(case[2])) for case in cases]


def point_list(text):
    """'1e5,1e6' -> [100000, 1000000]."""
    try:
        values = [int(float(part)) for part in text.split(",")]
    except (ValueError, OverflowError):
        values = []
    if not values or min(values) < 1:
        raise argparse.ArgumentTypeError(f"'{text}' is not like 1e5,1e6")
    return values


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cases", type=case_list, default="1x1,1x2,2x1", help="ranks x threads (default %(default)s)")
    parser.add_argument("--points", type=point_list, default="1e5,1e6", help="default %(default)s")
    parser.add_argument("--weak", action="store_true", help="--points are those of one core")
    parser.add_argument("--repeats", type=int, default=3,
                        help="runs per case, after a dropped one (default %(default)s)")
    parser.add_argument("--config", type=pathlib.Path, default=ROOT / "configs" / "square.ini")
    parser.add_argument("--program", type=pathlib.Path, default=ROOT / "build" / "release" / "trime_mpi")
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path("scaling"), help="default ./scaling")
    parser.add_argument("--keep", action="store_true", help="keep the last mesh, in OUTPUT/work")
    parser.add_argument("overrides", nargs="*", metavar="section.key=value", help="passed on to trime_mpi")
    options = parser.parse_args()
    if options.repeats < 1:
        parser.error("--repeats must be at least 1")
    if not options.program.exists():
        parser.error(f"there is no {options.program}; scripts/run.sh builds it, or name one with --program")
    options.program = options.program.resolve()
    return options


def main():
    options = parse_arguments()
    (options.output / "work").mkdir(parents=True, exist_ok=True)
    machine = machine_block(options.program)
    try:
        rows = measure(options, machine)
    finally:  # also when a run failed
        if not options.keep:
            shutil.rmtree(options.output / "work", ignore_errors=True)
    text = report(rows, machine, options)
    (options.output / "scaling.md").write_text(text, encoding="utf-8")
    write_csv(options.output / "scaling.csv", rows)
    print(text)
    print(f"Written to {options.output}: scaling.md, scaling.csv, runs.jsonl")
    if any(row["same_mesh"] != "OK" for row in rows):
        sys.exit("scaling.py: the meshes of one size differ; that is a bug of the program")


if __name__ == "__main__":
    main()
