# SPDX-License-Identifier: BSD-3-Clause
"""Runs a plan. The cases run alternately, so that a slow drift of the machine affects all of them equally."""
import sys
import time

from .errors import RunError
from .record import machine_line, run_line


class Progress:
    """A line on stderr for each run, with the time that is left."""

    def __init__(self, plan):
        self.plan = plan
        self.seconds = {}  # wall time of the last run of a case
        self.done = 0

    def guess(self, case):
        """Seconds of the next run: those of the last, else by the seconds per point of the other cases."""
        if case in self.seconds or not self.seconds:
            return self.seconds.get(case, 0.0)
        return case.points_asked * sum(self.seconds.values()) / sum(other.points_asked for other in self.seconds)

    def show(self, case, turn, left):
        """Before a run; `left`: the cases of all runs that are still to come."""
        self.done += 1
        number = turn - self.plan.warm_ups + 1
        which = "warm-up" if number < 1 else f"run {number} of {self.plan.repeats}"
        seconds = sum(self.guess(other) for other in left)
        rest = f"about {time.strftime('%H:%M:%S', time.gmtime(seconds))} left" if self.seconds else "time left unknown"
        print(f"[{self.done}/{self.done - 1 + len(left)}] {case.label}: {which}; {rest}", file=sys.stderr, flush=True)


def measure(plan, backends, machine, directory):
    """Runs a plan; every run that counts goes to directory/runs.jsonl as it ends.

    `backends`: by name. Returns the messages of cases that failed; those are not tried again. Ctrl-C ends the measuring
    like a failure: what is done stays.
    """
    work = directory / "work"
    work.mkdir(parents=True, exist_ok=True)
    failures, progress = {}, Progress(plan)
    turns = [(turn, case) for turn in range(plan.warm_ups + plan.repeats) for case in plan.cases]
    with (directory / "runs.jsonl").open("w", encoding="utf-8") as stream:
        print(machine_line(machine), file=stream, flush=True)
        try:
            for number, (turn, case) in enumerate(turns):
                if case in failures:
                    continue
                progress.show(case, turn, [other for _, other in turns[number:] if other not in failures])
                backend = backends[case.backend]
                try:
                    run = backend.run(case, work / "record.json", plan.limit)
                except RunError as error:
                    failures[case] = f"{case.label}: {error}"
                    print(f"scaling.py: {failures[case]}", file=sys.stderr, flush=True)
                    continue
                progress.seconds[case] = run["command_s"]
                if turn >= plan.warm_ups:
                    run["oversubscribed"] = backend.oversubscribed(case)
                    print(run_line(case, run), file=stream, flush=True)
        except KeyboardInterrupt:
            failures[None] = "interrupted"
    return list(failures.values())
