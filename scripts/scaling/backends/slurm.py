# SPDX-License-Identifier: BSD-3-Clause
"""Runs cases as SLURM jobs.

submit() writes and submits one job for each number of ranks and threads. The cases of a job run alternately. collect()
reads the records that the jobs have left.
"""
import dataclasses
import json
import shlex
import shutil
import subprocess

from ..errors import ROOT, RunError, UsageError
from ..record import machine_line, read_record, run_line
from ..summary import group_by
from ..sweep import Case, Plan
from .process import STOPPED_BY_CAP, mesh_arguments

NAME = "slurm"
JOBS = "jobs"  # folder of scripts, records and logs in the output directory

SCRIPT = """#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Written by scripts/scaling.py --backend slurm: all cases on {ranks} ranks of {threads} threads, alternately.
#SBATCH --job-name=trime_scaling
#SBATCH --output={directory}/{name}.log
#SBATCH --ntasks={ranks}
#SBATCH --cpus-per-task={threads}
#SBATCH --exclusive

set -uo pipefail
export TRIME_PROGRAM=${{TRIME_PROGRAM:-{program}}}
source {root}/jobs/common.sh
cd {directory} || exit 2
"${{PYTHON:-/usr/bin/python3}}" {root}/scripts/scaling.py --program "$TRIME_PROGRAM" --machine >{name}.machine

# one NUMBER TURN ARGUMENT...: a run of the case NUMBER. Its record goes to NUMBER-TURN.json, its output to .log, exit
# code, begin and end to .exit. A case that has failed is not tried again.
one() {{
  local stem=$1-$2 begin=$EPOCHREALTIME code=0
  [ ! -e "$1.failed" ] || return 0
  shift 2
  job_run --quiet --report "$stem.json" "$@" >"$stem.log" 2>&1 || code=$?
  echo "$code $begin $EPOCHREALTIME" >"$stem.exit"
  case $code in 0 | {capped}) ;; *) touch "${{stem%-*}}.failed" ;; esac
}}

for ((turn = 0; turn < {turns}; turn++)); do
{lines}
done
"""


def job_name(case):
    return f"{case.ranks}x{case.threads}"


def job_script(numbered, plan, program, directory):
    """The text of the job that runs some cases of the same ranks and threads; `numbered`: pairs (number, case)."""
    case = numbered[0][1]
    lines = [f"  one {number} \"$turn\" {shlex.join(mesh_arguments(each, directory))}" for number, each in numbered]
    paths = {"directory": directory, "root": ROOT, "program": program}
    quoted = {name: shlex.quote(str(path)) for name, path in paths.items()}
    return SCRIPT.format(ranks=case.ranks, threads=case.threads, name=job_name(case), capped=STOPPED_BY_CAP,
                         turns=plan.warm_ups + plan.repeats, lines="\n".join(lines), **quoted)


def submit(plan, program, directory, options):
    """Writes and submits the jobs of a plan; returns a text that says what was submitted.

    `options`: for sbatch, such as --partition=x. Raises UsageError where there is no SLURM or it refuses a job.
    """
    if not shutil.which("sbatch"):
        raise UsageError("there is no SLURM here: expected sbatch on the path, found none; try --backend local")
    place = directory / JOBS
    if place.exists():
        raise UsageError(f"{place} is there already, from jobs that were submitted before; collect them with --collect "
                         f"{directory}, or give another --output")
    place.mkdir(parents=True)
    numbers = {}
    for numbered in group_by(list(enumerate(plan.cases)), lambda pair: job_name(pair[1])):
        name = job_name(numbered[0][1])
        script = place / f"{name}.sbatch"
        script.write_text(job_script(numbered, plan, program, place), encoding="utf-8")
        done = subprocess.run(["sbatch", "--parsable", *options, str(script)], capture_output=True, text=True,
                              check=False)
        if done.returncode != 0:
            raise UsageError(f"sbatch refuses {script}: {done.stderr.strip()}")
        numbers[name] = done.stdout.split(";")[0].strip()
        write_plan(place, plan, numbers)
    return (f"Submitted {len(numbers)} jobs: " + ", ".join(f"{name} as {number}" for name, number in numbers.items())
            + f"\nOnce they have ended: scripts/scaling.py --collect {directory}")


def write_plan(place, plan, numbers):
    """What collect() needs to know."""
    text = json.dumps(dataclasses.asdict(plan) | {"jobs": numbers}, indent=1)
    (place / "plan.json").write_text(text, encoding="utf-8")


def read_plan(place):
    """The plan of submitted jobs. Raises RunError."""
    try:
        plan = json.loads((place / "plan.json").read_text(encoding="utf-8"))
        cases = [Case(**(case | {"options": tuple(case["options"])})) for case in plan["cases"]]
        return Plan(tuple(cases), plan["repeats"], plan["warm_ups"], plan["limit"]), plan["jobs"]
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise RunError(f"expected submitted jobs in {place}, found none that can be read: {error}") from error


def read_turn(place, number, turn):
    """A run, or None where it is still to come. Raises RunError where it has failed."""
    stem = place / f"{number}-{turn}"
    try:
        code, begin, end = stem.with_suffix(".exit").read_text(encoding="utf-8").split()
    except OSError:
        return None
    if int(code) not in (0, STOPPED_BY_CAP):
        log = stem.with_suffix(".log").read_text(encoding="utf-8", errors="replace").strip()
        raise RunError(f"exit code {code}, log {stem}.log\n{log}")
    return read_record(stem.with_suffix(".json")) | {"exit_code": int(code), "command": f"{stem}.log",
                                                     "command_s": float(end) - float(begin), "oversubscribed": False}


def collect(directory):
    """Writes directory/runs.jsonl from the records of the jobs; returns messages about what failed or is missing."""
    place = directory / JOBS
    plan, jobs = read_plan(place)
    messages = []
    with (directory / "runs.jsonl").open("w", encoding="utf-8") as stream:
        for path in sorted(place.glob("*.machine")):
            try:
                print(machine_line(json.loads(path.read_text(encoding="utf-8"))), file=stream)
            except ValueError:
                messages.append(f"the job did not describe its machine: {path}")
        for number, case in enumerate(plan.cases):
            try:
                turns = range(plan.warm_ups, plan.warm_ups + plan.repeats)
                runs = [run for run in (read_turn(place, number, turn) for turn in turns) if run]
            except RunError as error:
                messages.append(f"{case.label}: {error}")
                continue
            for run in runs:
                print(run_line(case, run), file=stream)
            if len(runs) < plan.repeats:
                messages.append(f"{case.label}: {len(runs)} of {plan.repeats} runs are done; see squeue --job "
                                f"{jobs.get(job_name(case), '?')} and {place}/{job_name(case)}.log")
    return messages
