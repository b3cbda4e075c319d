#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the whole program on random configs, each on 1 and 3 ranks, and compares every star with a newly computed one.

Both runs must give the same hash, or the same error. A difference, a crash, a hang, a failed check and a use of much
memory are findings.

Usage: random_runs.py [--seed S] [--first K] [--count N] [--keep DIRECTORY] [--slow SECONDS]
  --keep D   write the config and the files of each finding here; `trime_mpi D/S-K/case.ini` repeats it
  --slow T   a run of one rank with more than T processor seconds is a finding, too (default: none; machines differ)
The script exits with 1 if it has findings.
"""
import argparse
import collections
import json
import os
import pathlib
import random
import re
import resource
import subprocess
import sys
import time

from random_shapes import RandomConfig
from trime_run import Workspace, command, environment

PATIENCE = 300  # seconds until a run counts as hanging; most take less than one
MEBIBYTES = 1024  # of one rank: the largest meshes here have about 10^4 points
MOST_POINTS = 20000  # that are meshed; a config that asks for more is only validated
DONE, USAGE, GEOMETRY, INCOMPLETE = 0, 2, 3, 5
ALLOWED = {DONE, USAGE, GEOMETRY, INCOMPLETE}
# A mesh may fail these without a mistake of the program: triangles that are worse than the user wants.
QUALITY = {"worst_alpha"}


class Run:
    """A finished run: code, what was printed, processor seconds and peak memory of the largest process."""

    def __init__(self, work, arguments, ranks):
        words = command([work / "case.ini", *arguments], ranks)
        begin = time.monotonic()
        with open(work / "printed", "wb") as out:
            # Its own group, so that a run that hangs can be ended with all its ranks.
            process = subprocess.Popen(words, cwd=work, stdout=out, stderr=out, start_new_session=True,
                                       env=dict(environment(1), TRIME_VERIFY_STARS="1"))
        self.hangs = False
        while True:
            done, status, used = os.wait4(process.pid, os.WNOHANG)
            if done:
                break
            if time.monotonic() - begin > PATIENCE and not self.hangs:
                self.hangs = True
                os.killpg(process.pid, 9)
            time.sleep(0.005)
        process.returncode = os.waitstatus_to_exitcode(status)
        self.code = process.returncode
        self.seconds = used.ru_utime + used.ru_stime
        self.mebibytes = used.ru_maxrss / 1024
        self.text = (work / "printed").read_text(errors="replace")

    def errors(self, work):
        """Without what differs from run to run."""
        return [line.replace(str(work), "") for line in self.text.splitlines() if line.startswith("trime_mpi: error")]


class Trial:
    """One config."""

    def __init__(self, work, config, slow):
        self.work, self.slow = work, slow
        (work / "case.ini").write_text(config.text)
        for name, text in config.files.items():
            (work / name).write_text(text)
        self.findings = []
        self.seconds = self.mebibytes = 0
        self.outcome = self.try_it()

    def run(self, *arguments, ranks=1):
        done = Run(self.work, arguments, ranks)
        what = f"{' '.join(arguments[:1])} on {ranks} rank{'s' if ranks > 1 else ''}"
        if done.hangs:
            self.findings.append(f"{what}: no end within {PATIENCE} s")
        elif done.code not in ALLOWED or re.search(r"internal error|Assertion|Segmentation", done.text):
            self.findings.append(f"{what}: exit code {done.code}")
        elif done.code in (USAGE, GEOMETRY) and not done.errors(self.work):
            self.findings.append(f"{what}: exit code {done.code} without a message")
        if ranks == 1:
            self.seconds, self.mebibytes = max(self.seconds, done.seconds), max(self.mebibytes, done.mebibytes)
            if done.mebibytes > MEBIBYTES:
                self.findings.append(f"{what}: {done.mebibytes:.0f} MiB")
            if self.slow and done.seconds > self.slow:
                self.findings.append(f"{what}: {done.seconds:.1f} s")
        return done

    def try_it(self):
        told = self.run("--validate")
        points = re.search(r"^about (\d+) points", told.text, re.M)
        if self.findings or (told.code == DONE and not points):
            return "finding"
        if points and int(points[1]) > MOST_POINTS:
            return "too large to mesh"
        results = []
        for ranks in (1, 3):
            report = self.work / f"report-{ranks}.json"
            done = self.run("output.directory=out", "output.overwrite=true", "--report", str(report), ranks=ranks)
            results.append((done.code, done.errors(self.work), self.judge(report)))
        if results[0] != results[1]:
            self.findings.append(f"1 rank: {results[0]}; 3 ranks: {results[1]}")
        # Of two mistakes each reports the first that it finds.
        if told.code != DONE and results[0][0] not in (USAGE, GEOMETRY):
            self.findings.append(f"--validate ends with {told.code}, the run with {results[0][0]}")
        left = [path.name for path in (self.work / "out").glob("*") if ".tmp" in path.name]
        if left or (results[0][0] in (USAGE, GEOMETRY) and list((self.work / "out").glob("*.h5"))):
            self.findings.append(f"files that should not be there: {left}")
        return "finding" if self.findings else f"exit {results[0][0]}"

    def judge(self, report):
        """The hash of a mesh; a check that failed is a finding, unless it is about quality."""
        if not report.exists():
            return None
        told = json.loads(report.read_text())
        checks = told["groups"]["checks"]["columns"]
        failed = [name for name, passed in zip(checks["name"], checks["passed"]) if not passed]
        if set(failed) - QUALITY:
            self.findings.append(f"failed checks: {failed}")
        return told["attributes"]["mesh_hash_hex"]


def keep(directory, work, findings):
    """The config with its files and what was found."""
    directory.mkdir(parents=True, exist_ok=True)
    for path in work.iterdir():
        if path.suffix in (".ini", ".xy") or path.name == "printed":
            (directory / path.name).write_bytes(path.read_bytes())
    (directory / "findings").write_text("\n".join(findings) + "\n")


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--count", type=int, default=5)
    parser.add_argument("--keep", type=pathlib.Path)
    parser.add_argument("--slow", type=float, default=0)
    arguments = parser.parse_args()
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    outcomes, found, slowest, largest = collections.Counter(), 0, (0, 0), (0, 0)
    for k in range(arguments.first, arguments.first + arguments.count):
        with Workspace() as work:
            trial = Trial(work, RandomConfig(random.Random(f"{arguments.seed} {k}")), arguments.slow)
            outcomes[trial.outcome] += 1
            slowest, largest = max(slowest, (trial.seconds, k)), max(largest, (trial.mebibytes, k))
            if trial.findings:
                found += 1
                print(f"config {k} of seed {arguments.seed}:", *trial.findings, sep="\n  ", flush=True)
                if arguments.keep:
                    keep(arguments.keep / f"{arguments.seed}-{k}", work, trial.findings)
                else:
                    print((work / "case.ini").read_text(), (work / "printed").read_text(), sep="\n")
    print(", ".join(f"{count} {outcome}" for outcome, count in sorted(outcomes.items())))
    print("slowest: {:.1f} s (config {}); largest: {:.0f} MiB (config {})".format(*slowest, *largest))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
