# SPDX-License-Identifier: BSD-3-Clause
"""Invented runs for the tests of the scaling harness, and the path to its modules."""
import sys

from trime_run import ROOT

sys.path.insert(0, str(ROOT / "scripts"))


def made_run(ranks=1, threads=1, seconds=1.0, points=1000, **changes):
    """A run as runs.jsonl holds it."""
    phases = {"start": {"calls": 1, "min": 0.1, "avg": 0.2 * seconds, "max": seconds, "messages": ranks - 1,
                        "bytes": 10, "collectives": 3},
              "sweeps": {"calls": 1, "min": 0.1, "avg": 0.8 * seconds, "max": seconds, "messages": 0, "bytes": 0,
                         "collectives": 1}}
    run = {"sweep": "s", "kind": "strong", "config": "c.ini", "method": "cvd", "variant": "", "stop": "rule",
           "points_asked": points, "points_per_core": 0, "ranks": ranks, "threads": threads, "options": (),
           "output": False, "backend": "local", "reference": "", "oversubscribed": False, "exit_code": 0,
           "points": points, "triangles": 2 * points, "mesh_hash": "a", "iterations": 10, "point_sweeps": 10 * points,
           "stop_reason": "stalled", "most_points_of_a_rank": points // ranks, "bytes_per_point": 200.0,
           "peak_memory_bytes": 1, "quality": {"alpha_mean": 1.01}, "counters": {}, "limit": "", "phases": phases,
           "total_s": seconds, "seconds": seconds, "set_up_s": 0.2 * seconds, "mesh_s": 0.8 * seconds, "output_s": 0.0,
           "command_s": seconds + 0.4}
    return run | changes
