#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Measures strong and weak scaling: sweeps over ranks, threads, methods and points that a small ini file describes.

Each case runs once to warm up and then five times. The cases run alternately. The tables hold medians, spread, the
efficiency E = T1/(p Tp) (strong) or T1/Tp (weak), the serial fraction of Karp and Flatt, and seconds by phase. All runs
of one mesh must have the same hash. The directory OUTPUT gets scaling.md, scaling.csv, runs.jsonl with every run, and
plots as PNG and SVG.

  scripts/scaling.py                                           # scaling/sweeps/default.ini: 1 and 2 cores, some minutes
  scripts/scaling.py --kind strong --points 1e7 --cases powers --config my.ini sizing.gradation=0.2
  scripts/scaling.py scripts/scaling/sweeps/trime_square.ini   # the study of TriMe++
  scripts/scaling.py scripts/scaling/sweeps/simulated.ini --backend simulated
  scripts/scaling.py --backend slurm --cases ranks --nodes 4x64; scripts/scaling.py --collect scaling
  scripts/scaling.py --compare old/runs.jsonl                  # measures, and lists what became slower
  scripts/scaling.py --read new/runs.jsonl --compare old/runs.jsonl
  scripts/scaling.py --model a/runs.jsonl b/runs.jsonl         # fits a model, checks it, predicts times on 10^4 ranks

Exit codes: 0 success; 2 bad use; 4 a run failed, a file cannot be read, or hashes differ (the rows so far are kept);
5 --compare found regressions.
"""
import argparse
import json
import pathlib
import re
import shlex
import shutil
import sys

from scaling import model_report, tables
from scaling.backends import NAMES, make_backend, slurm
from scaling.compare import compare
from scaling.errors import CHECK_FAILED, FAILED, ROOT, HarnessError, UsageError
from scaling.machine import cores_per_node, machine_block
from scaling.measure import measure
from scaling.plots import draw
from scaling.record import read_runs
from scaling.summary import rows_of
from scaling.sweep import SWEEPS, read_plan

REFERENCE = ROOT / "scripts" / "scaling" / "reference.csv"


def parser():
    """The command line."""
    made = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add = made.add_argument
    add("arguments", nargs="*", metavar="INI | section.key=value",
        help="the file of sweeps (default: default.ini), and options of trime_mpi")
    add("--backend", default="local", help=f"one of {', '.join(NAMES)} (default: %(default)s)")
    add("--program", type=pathlib.Path, default=ROOT / "build" / "release" / "trime_mpi",
        help="the program to measure (default: build/release/trime_mpi)")
    add("--cluster", type=pathlib.Path, help="for --backend simulated: the platform file of SimGrid")
    add("--output", type=pathlib.Path, default=pathlib.Path("scaling"),
        help="the directory of the results (default: ./scaling)")
    add("--only", default="", metavar="TEXT", help="only the sweeps whose name contains TEXT")
    add("--kind", default="", choices=("strong", "weak"), help="only the sweeps of this kind")
    for key in ("config", "points", "cases", "methods", "stops", "sweeps", "repeats"):
        add(f"--{key}", help="replaces the value in the ini")
    add("--nodes", default="", metavar="NxC",
        help="for --backend slurm: N nodes of C cores, for the words powers, ranks, threads")
    add("--sbatch", default="", metavar="OPTIONS",
        help="for --backend slurm: more options for sbatch, in one text")
    add("--collect", type=pathlib.Path, metavar="DIR",
        help="make the tables of the SLURM jobs that wrote into DIR")
    add("--compare", type=pathlib.Path, metavar="OLD.jsonl", help="list what is slower than in OLD.jsonl")
    add("--model", nargs="+", type=pathlib.Path, metavar="RUNS.jsonl",
        help="fit, check and extrapolate a model of the time")
    add("--machine", action="store_true", help="print the description of this machine, as SLURM jobs do")
    add("--list", action="store_true", help="print the cases without running them")
    add("--read", nargs="+", type=pathlib.Path, metavar="RUNS.jsonl",
        help="make the tables of these runs without running anything")
    return made


def split_arguments(arguments):
    """The ini and the options of trime_mpi."""
    inis = [argument for argument in arguments if "=" not in argument]
    if len(inis) > 1:
        raise UsageError(f"expected one ini, found {' and '.join(inis)}")
    return pathlib.Path(inis[0]) if inis else SWEEPS / "default.ini", [a for a in arguments if "=" in a]


def plan_of(options, nodes):
    """The cases that the command line asks for."""
    ini, overrides = split_arguments(options.arguments)
    changes = {key: getattr(options, key) for key in ("points", "cases", "methods", "stops", "sweeps", "repeats")}
    if options.config:  # published times are those of the shape in the ini
        changes |= {"config": str(pathlib.Path(options.config).resolve()), "reference": ""}
    return read_plan(ini, options.backend, nodes, changes, overrides, options.only, options.kind)


def write_results(options, paths, failures):
    """Tables and plots of some runs.jsonl into the output directory; returns the exit code."""
    runs, machine = read_runs(paths)
    rows, mismatches = rows_of(runs)
    old_rows = rows_of(read_runs([options.compare])[0])[0] if options.compare else []
    text = tables.report(rows, machine, tables.reference_times(REFERENCE), mismatches + failures)
    compared, slower = compare(old_rows, rows) if options.compare else ([], 0)
    pictures = draw(rows, options.output)
    text += "\n".join(compared + [f"![{name}]({name})" for name in pictures]) + "\n"
    (options.output / "scaling.md").write_text(text, encoding="utf-8")
    tables.write_csv(options.output / "scaling.csv", rows)
    print(text)
    print(f"Written to {options.output}: scaling.md, scaling.csv, {len(pictures)} plots (PNG, SVG)", file=sys.stderr)
    for message in mismatches + failures:
        print(f"scaling.py: {message}", file=sys.stderr)
    return FAILED if mismatches or failures else CHECK_FAILED if slower else 0


def write_model(options):
    """Fits the model to some runs.jsonl; model.md goes into the output directory. Returns the exit code."""
    runs, machine = read_runs(options.model)
    rows, mismatches = rows_of(runs)
    text = model_report.report(rows, sum(machine.get("cores_per_node", [])))
    options.output.mkdir(parents=True, exist_ok=True)
    (options.output / "model.md").write_text(text, encoding="utf-8")
    print(text)
    for message in mismatches:
        print(f"scaling.py: {message}", file=sys.stderr)
    return FAILED if mismatches else 0


def backends_of(options, plan):
    """Returns the backends of the cases by name. Each can run its cases."""
    made = {}
    for name in dict.fromkeys(case.backend for case in plan.cases):
        made[name] = make_backend(name, options.program.resolve(), options.cluster)
        made[name].check([case for case in plan.cases if case.backend == name])
    return made


def run_here(options, plan):
    """Measures, case by case."""
    backends = backends_of(options, plan)
    options.output.mkdir(parents=True, exist_ok=True)
    machine = machine_block(options.program)
    machine["launch"] = "; ".join(backend.describe() for backend in backends.values())
    try:
        failures = measure(plan, backends, machine, options.output.resolve())
    finally:
        shutil.rmtree(options.output / "work", ignore_errors=True)
    return write_results(options, [options.output / "runs.jsonl"], failures)


def nodes_of(options):
    """Returns the cores of each node, for the words that stand for cases, or an empty list if the user did not give
    them."""
    if options.backend != "slurm":
        return cores_per_node()
    match = re.fullmatch(r"(\d+)x(\d+)|", options.nodes)
    if not match:
        raise UsageError(f"--nodes: expected nodes x cores like 4x64, found '{options.nodes}'")
    return [int(match[2])] * int(match[1]) if options.nodes else []


def work(options):
    """What the command line asks for; returns the exit code."""
    if options.machine:
        print(json.dumps(machine_block(options.program)))
        return 0
    if options.model:
        return write_model(options)
    if options.collect:
        options.output = options.collect
        return write_results(options, [options.output / "runs.jsonl"], slurm.collect(options.output.resolve()))
    if options.read:
        options.output.mkdir(parents=True, exist_ok=True)
        return write_results(options, options.read, [])
    if options.backend not in NAMES:
        raise UsageError(f"expected a backend out of {', '.join(NAMES)}; found '{options.backend}'")
    plan = plan_of(options, nodes_of(options))
    if options.list:
        print("\n".join(f"{case.backend}: {case.label}" for case in plan.cases))
        return 0
    if options.backend == "slurm":
        print(slurm.submit(plan, options.program.resolve(), options.output.resolve(), shlex.split(options.sbatch)))
        return 0
    return run_here(options, plan)


def main():
    options = parser().parse_intermixed_args()
    try:
        return work(options)
    except HarnessError as error:
        print(f"scaling.py: {error}", file=sys.stderr)
        return error.code


if __name__ == "__main__":
    sys.exit(main())
