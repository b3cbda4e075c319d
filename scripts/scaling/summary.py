# SPDX-License-Identifier: BSD-3-Clause
"""Makes rows from runs: medians, spread, speed-up, efficiency, serial fraction, and whether all runs made one mesh."""
import statistics

from .errors import RunError
from .record import TRAFFIC

CASE = ("backend", "sweep", "kind", "config", "method", "variant", "stop", "points_asked", "points_per_core",
        "ranks", "threads", "options", "output", "reference")
MESH = ("config", "options", "points_asked")                                      # what a mesh is a function of
SERIES = ("backend", "sweep", "kind", "config", "variant", "method", "stop", "output")  # rows of one curve ...
RESULT = ("oversubscribed", "points", "triangles", "iterations", "point_sweeps", "stop_reason", "exit_code", "quality",
          "counters", "limit", "most_points_of_a_rank")  # equal in all runs of a case
TIMES = ("seconds", "total_s", "set_up_s", "mesh_s", "output_s", "command_s")


def key_of(row, names):
    """The values of some fields as a tuple."""
    return tuple(row[name] for name in names)


def size_of(row):
    """... and of one size: points of the mesh (strong) or of one core (weak)."""
    return row["points_per_core"] if row["kind"] == "weak" else row["points_asked"]


def group_by(rows, key):
    """Lists of rows with equal keys, in order of first appearance."""
    groups = {}
    for row in rows:
        groups.setdefault(key(row), []).append(row)
    return list(groups.values())


def curves_of(rows):
    """Groups of rows among which efficiency means something: one method on one size over numbers of cores."""
    return group_by(rows, lambda row: key_of(row, SERIES) + (size_of(row),))


def spread_of(values):
    """Width of the middle half over the median; None for fewer than three values."""
    if len(values) < 3:
        return None
    low, middle, high = statistics.quantiles(values, n=4, method="inclusive")
    return (high - low) / max(middle, 1e-12)


def median_phase(runs, name):
    """One phase over the runs of a case: medians of its seconds; traffic, the same in all runs, of the last."""
    found = [run["phases"][name] for run in runs if name in run["phases"]]
    return {key: statistics.median(phase[key] for phase in found) for key in ("min", "avg", "max")} | {
        key: found[-1].get(key, 0) for key in TRAFFIC}


def summarise(runs):
    """One row from the runs of one case."""
    last = runs[-1]
    row = {key: last[key] for key in CASE} | {"cores": last["ranks"] * last["threads"], "repeats": len(runs)}
    row |= {name: statistics.median(run[name] for run in runs) for name in TIMES}
    seconds = [run["seconds"] for run in runs]
    row |= {"min_s": min(seconds), "max_s": max(seconds), "spread": spread_of(seconds)}
    row |= {key: last[key] for key in RESULT}
    row["bytes_per_point"] = max(run["bytes_per_point"] for run in runs)
    row["imbalance"] = last["most_points_of_a_rank"] * last["ranks"] / max(last["points"], 1)
    row["mesh_hash"] = "/".join(sorted({run["mesh_hash"] for run in runs}))
    names = dict.fromkeys(name for run in runs for name in run["phases"])
    row["phases"] = {name: median_phase(runs, name) for name in names}
    row |= {key: sum(phase[key] for phase in row["phases"].values()) for key in TRAFFIC}
    return row


def efficiency(base, row):
    """E = T1/(p Tp) for a strong row, T1/Tp for a weak one; p counts the cores of the base as one."""
    ratio = base["seconds"] / max(row["seconds"], 1e-12)
    return ratio if row["kind"] == "weak" else ratio * base["cores"] / row["cores"]


def serial_fraction(speedup, cores):
    """Karp and Flatt (1990): the share f of serial work that explains a speed-up; None on one core."""
    return None if cores < 2 else (1 / speedup - 1 / cores) / (1 - 1 / cores)


def fill_scaling(rows):
    """Base, speed-up, efficiency and serial fraction of the rows of one curve; none for oversubscribed ones."""
    base = min(rows, key=lambda row: (row["oversubscribed"], row["cores"], row["threads"]))
    for row in rows:
        row |= {"base": f"{base['ranks']} x {base['threads']}", "is_base": row is base, "speedup": None,
                "efficiency": None, "serial_fraction": None}
        if row["oversubscribed"] or base["oversubscribed"]:
            continue
        row["efficiency"] = efficiency(base, row)
        row["speedup"] = row["efficiency"] * row["cores"] / base["cores"]
        if row["kind"] == "strong":
            row["serial_fraction"] = serial_fraction(row["speedup"], row["cores"] / base["cores"])


def check_hashes(rows):
    """Sets same_mesh of each row. Returns a message for each mesh whose runs differ."""
    messages = []
    for group in group_by(rows, lambda row: key_of(row, MESH)):
        hashes = {row["mesh_hash"] for row in group}
        same = len(hashes) == 1 and "/" not in group[0]["mesh_hash"]
        for row in group:
            row["same_mesh"] = same
        if not same:
            first = group[0]
            cases = [f"{row['backend']} {row['ranks']} x {row['threads']}: {row['mesh_hash']}" for row in group]
            messages.append(f"unequal meshes of {first['sweep']}, {first['method']}, {first['points_asked']} points, "
                            f"which is a bug of the program: {', '.join(cases)}")
    return messages


def rows_of(runs):
    """Rows with efficiencies from all runs, and messages about unequal hashes. Raises RunError for runs without all."""
    try:
        rows = [summarise(group) for group in group_by(runs, lambda run: key_of(run, CASE))]
    except KeyError as error:
        raise RunError(f"a run has no {error}; was it written by another version of scaling.py?") from error
    for curve in curves_of(rows):
        fill_scaling(curve)
    return rows, check_hashes(rows)
