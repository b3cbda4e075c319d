# SPDX-License-Identifier: BSD-3-Clause
"""Reads the numbers of a run from the report of trime_mpi, and keeps them in runs.jsonl."""
import dataclasses
import json

from .errors import RunError

SET_UP = ("shape", "size field", "boundary", "start")  # before the first sweep
OUTPUT = ("output", "snapshots")
BUILD = ("program_version", "git_commit", "build_type", "compiler", "mpi_library", "hdf5_library", "host")
TRAFFIC = ("messages", "bytes", "collectives")
MACHINE, RUN = "machine", "run"  # kinds of lines in runs.jsonl


def table_rows(group):
    """The columns of a group as a list of dicts."""
    columns = group.get("columns", {})
    return [dict(zip(columns, values)) for values in zip(*columns.values())]


def nested_counters(group):
    """Counters as {phase: {name: {sum, min, mean, max}}}; of a phase `run` those of the whole run."""
    nested = {}
    for row in table_rows(group):
        nested.setdefault(row["phase"], {})[row["name"]] = {key: row[key] for key in ("sum", "min", "mean", "max")}
    return nested


def point_sweeps(history):
    """Points moved in all sweeps together: a sweep over a coarse mesh counts with its points."""
    moved, before = 0, 0
    for row in history:
        moved += (row["sweep"] - before) * row["points"]
        before = row["sweep"]
    return moved


def read_record(path):
    """A run from the JSON of --report: quality, hash, phases with their traffic, seconds with output apart.

    Raises RunError where the file is not there or not as expected.
    """
    try:
        record = json.loads(path.read_text(encoding="utf-8"))
        attributes, groups = record["attributes"], record["groups"]
        phases = {row.pop("name"): row for row in table_rows(groups["timers"])}
        run = {
            "points": attributes["points"], "triangles": attributes["triangles"],
            "mesh_hash": attributes["mesh_hash_hex"], "iterations": attributes["iterations"],
            "stop_reason": attributes["stop_reason"], "total_s": attributes["seconds_total"],
            "point_sweeps": point_sweeps(table_rows(groups.get("history", {}))),
            "bytes_per_point": attributes["bytes_per_point"], "peak_memory_bytes": attributes["peak_memory_bytes"],
            "most_points_of_a_rank": attributes["most_points_of_a_rank"],
            "quality": groups.get("quality", {}).get("attributes", {}),
            "counters": nested_counters(groups.get("counters", {})),
            "limit": groups.get("counters", {}).get("attributes", {}).get("limit", ""),
            "build": {key: attributes.get(key, "unknown") for key in BUILD},
        }
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
        raise RunError(f"expected the record of a run in {path}, found none that can be read: "
                       f"{type(error).__name__}: {error}") from error
    run["phases"] = phases
    run["output_s"] = sum(phases[name]["avg"] for name in OUTPUT if name in phases)
    run["set_up_s"] = sum(phases[name]["avg"] for name in SET_UP if name in phases)
    run["seconds"] = run["total_s"] - run["output_s"]
    run["mesh_s"] = run["seconds"] - run["set_up_s"]
    return run


def run_line(case, run):
    """A line of runs.jsonl."""
    return json.dumps({"line": RUN} | dataclasses.asdict(case) | run)


def machine_line(machine):
    """The line of runs.jsonl that stands before the runs of this machine."""
    return json.dumps({"line": MACHINE} | machine)


def read_runs(paths):
    """All runs of some runs.jsonl, and the block of the machine of the last one. Raises RunError."""
    runs, machine = [], {}
    for path in paths:
        try:
            with open(path, encoding="utf-8") as stream:
                lines = [json.loads(line) for line in stream if line.strip()]
        except (OSError, ValueError) as error:
            raise RunError(f"expected runs of scaling.py in {path}, one JSON object a line: {error}") from error
        for line in lines:
            kind = line.pop("line", "") if isinstance(line, dict) else ""
            if kind == MACHINE:
                machine = line
            elif kind == RUN:
                line["options"] = tuple(line["options"])
                runs.append(line)
            else:
                raise RunError(f"{path}: found a line that is neither a run nor a machine; it is not of scaling.py")
    if not runs:
        raise RunError(f"there is no run in {', '.join(str(path) for path in paths)}")
    return runs, machine
