#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Measures the time of whole runs of one program, or compares two programs.

Every case runs `--repeats` times after a first run that does not count. With `--against` the two programs run
alternately, and the script prints the ratio of their medians. "Seconds" is the time that the program itself measures,
from the start of main until the mesh file is written. "Command" also includes the start and the end of MPI. "ns" are
nanoseconds of all cores per point and sweep: stars, moves, measuring and sorting together. The script prints a table in
Markdown.

  scripts/benchmark.py                                         # squares of 1e5 and 1e6 points
  scripts/benchmark.py --data DIR --cases all                  # with DIR/poker.xy and DIR/north_america.xy
  scripts/benchmark.py --against ../old/trime_mpi --cases "square 1e5"
  scripts/benchmark.py --gmsh --cases "square 1e5"             # compares with Gmsh's Frontal-Delaunay algorithm

With `--gmsh` a second row shows a mesh of Gmsh that has as many vertices. Its "seconds" are the times that Gmsh prints
for the meshing of curves and surfaces on one thread, without its start and its files. Its "command" is the whole
command. On graded shapes Gmsh meshes the size field of our mesh, see gmsh_rival.py.
"""
import argparse
import os
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile
import time

from gmsh_rival import Rival
from quality_table import COAST, POKER, automatic

ROOT = pathlib.Path(__file__).resolve().parent.parent
SQUARE = "[shape]\ngeometry = domain\n"
CASES = {
    "square 1e4": (SQUARE, 10_000),
    "square 1e5": (SQUARE, 100_000),
    "square 1e6": (SQUARE, 1_000_000),
    "square 1e7": (SQUARE, 10_000_000),
    "poker 1e5": (POKER + automatic(0.1), 100_000),
    "coast 2e4": (COAST + automatic(0.2), 20_000),
    "coast 1e6": (COAST + automatic(0.2), 1_000_000),
}
SWEEPING = ("stars", "measure", "sweeps", "sort", "move")


def text_of(pattern, report, what):
    found = re.search(pattern, report, re.MULTILINE)
    if not found:
        sys.exit(f"benchmark.py: no {what} in the report of the program:\n{report}")
    return found.groups()


def run(program, config, points, threads, directory, overrides):
    """One run: its figures by name. Into new files: to free the pages of old ones takes as long as a third of the
    output."""
    for old in directory.glob("m.*"):
        old.unlink()
    file = directory / "case.ini"
    file.write_text(f"{config}[meshing]\npoints = {points}\n[output]\ndirectory = {directory}\nname = m\n"
                    "overwrite = true\n", encoding="utf-8")
    begun = time.perf_counter()
    done = subprocess.run([str(program), str(file), *overrides, "--log-level=info"], capture_output=True,
                          text=True, check=False, env=os.environ | {"OMP_NUM_THREADS": str(threads)})
    command = time.perf_counter() - begun
    if done.returncode != 0:
        sys.exit(f"benchmark.py: {program} ended with {done.returncode}:\n{done.stdout}{done.stderr}")
    report = done.stdout
    phases = {name.strip(): float(mean) for name, mean in
              re.findall(r"^  ([a-z][a-z -]*?) +[\d.]+ +([\d.]+) +[\d.]+ +[\d.]+ %$", report, re.MULTILINE)}
    made, = text_of(r"^(\d+) points, \d+ triangles", report, "number of points")
    sweeps, = text_of(r"^Stopped after (\d+) sweeps", report, "number of sweeps")
    mean, worst = text_of(r"^  alpha +[\d.]+ +([\d.]+) +([\d.]+)", report, "quality")
    return {"seconds": float(text_of(r"^  total +([\d.]+)", report, "time")[0]), "command": command,
            "points": int(made), "sweeps": int(sweeps), "mean": float(mean), "worst": float(worst),
            "bytes": float(text_of(r"([\d.]+) bytes per point", report, "memory")[0]), "phases": phases,
            "sweeping": sum(phases.get(name, 0.0) for name in SWEEPING)}


def median_of(runs):
    middle = dict(runs[-1])
    for name in ("seconds", "command", "sweeping"):
        middle[name] = statistics.median(one[name] for one in runs)
    middle["phases"] = {name: statistics.median(one["phases"].get(name, 0.0) for one in runs)
                        for name in runs[-1]["phases"]}
    return middle


def row(name, who, result, threads, note=""):
    share = {key: 100 * value / result["seconds"] for key, value in result["phases"].items()}
    setup = sum(share.get(key, 0.0) for key in ("shape", "size field", "boundary", "start"))
    arrays = share.get("extract", 0.0) + share.get("certificate", 0.0)
    per_sweep = 1e9 * threads * result["sweeping"] / result["points"] / max(1, result["sweeps"])
    print(f"| {name} | {who} | {result['points']} | {result['seconds']:.3f} | {result['command']:.3f} "
          f"| {result['points'] / result['seconds']:.3g} | {result['sweeps']} | {per_sweep:.0f} | {setup:.0f} % "
          f"| {share.get('clean-up', 0.0):.0f} % | {arrays:.0f} % | {share.get('output', 0.0):.0f} % "
          f"| {result['bytes']:.0f} | {result['mean']:.4f} | {result['worst']:.3f} | {note} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", type=pathlib.Path, default=ROOT / "build" / "release" / "trime_mpi",
                        help="the program to measure (default: build/release/trime_mpi)")
    parser.add_argument("--against", type=pathlib.Path, help="another build, to compare the program with")
    parser.add_argument("--gmsh", action="store_true",
                        help="compare with meshes of Gmsh (Debian: gmsh python3-scipy)")
    parser.add_argument("--data", type=pathlib.Path, help="the directory of poker.xy and north_america.xy")
    parser.add_argument("--cases", default="square 1e5,square 1e6",
                        help="names separated by commas, or all (default: %(default)s): " + ", ".join(CASES))
    parser.add_argument("--repeats", type=int, default=5, help="counted runs of each case (default: %(default)s)")
    parser.add_argument("--threads", type=int, default=os.cpu_count(), help="default: one per core, %(default)s here")
    parser.add_argument("overrides", nargs="*", help="section.key=value, for every run")
    arguments = parser.parse_args()
    if arguments.gmsh and any(override.startswith(("shape", "sizing", "domain")) for override in arguments.overrides):
        parser.error("--gmsh cannot be combined with overrides of shape, sizing and domain")
    names = list(CASES) if arguments.cases == "all" else [name.strip() for name in arguments.cases.split(",")]
    for name in names:
        if name not in CASES:
            parser.error(f"there is no case '{name}'; known: {', '.join(CASES)}")
        if "{data}" in CASES[name][0] and not arguments.data:
            parser.error(f"'{name}' needs --data")
    programs = [("this", arguments.program)] + ([("other", arguments.against)] if arguments.against else [])
    for _, program in programs:
        if not program.is_file():
            parser.error(f"there is no program {program}; build it, or name another one by --program")
    print("| case | program | points | seconds | command | points/s | sweeps | ns | set-up | clean-up | extract "
          "| output | bytes/point | mean | max alpha | |\n" + "|---" * 16 + "|")
    for name in names:
        config, points = CASES[name]
        if arguments.data:
            config = config.replace("{data}", str(arguments.data.resolve()))
        runs = {who: [] for who, _ in programs}
        rival, others = None, []
        with tempfile.TemporaryDirectory(prefix="trime-benchmark-") as work:
            for repeat in range(arguments.repeats + 1):
                for who, program in programs:
                    result = run(program.resolve(), config, points, arguments.threads, pathlib.Path(work),
                                 arguments.overrides)
                    if repeat > 0:
                        runs[who].append(result)
                    elif arguments.gmsh and who == "this":
                        rival = Rival(config, pathlib.Path(work) / "m.h5", result["points"], pathlib.Path(work))
                if rival and repeat > 0:
                    others.append(rival.run())
        ours = median_of(runs["this"])
        row(name, "this", ours, arguments.threads)
        if arguments.against:
            theirs = median_of(runs["other"])
            row(name, "other", theirs, arguments.threads,
                f"takes {theirs['seconds'] / ours['seconds']:.2f} times as long")
        if others:
            seconds, command = (statistics.median(one[key] for one in others) for key in ("seconds", "command"))
            print(f"| {name} | Gmsh Frontal-Delaunay | {others[-1]['points']} | {seconds:.3f} | {command:.3f} "
                  f"| {others[-1]['points'] / seconds:.3g} " + "| " * 7 +
                  f"| {others[-1]['mean']:.4f} | {others[-1]['worst']:.3f} | takes "
                  f"{seconds / ours['seconds']:.1f} times as long |", flush=True)


if __name__ == "__main__":
    main()
