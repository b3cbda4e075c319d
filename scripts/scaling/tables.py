# SPDX-License-Identifier: BSD-3-Clause
"""Writes rows as Markdown and CSV."""
import csv

from .record import TRAFFIC
from .summary import curves_of, group_by, key_of

OVERSUBSCRIBED = "oversubscribed"


def markdown_table(head, body):
    """Lines of a Markdown table."""
    return ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)] + ["| " + " | ".join(row) + " |" for row in body]


def number(value, form):
    """A number as text; nothing for None."""
    return "" if value is None else format(value, form)


def percent(value):
    """A share as text; nothing for None."""
    return "" if value is None else f"{100 * value:.0f} %"


def title_of(row):
    """What the curves of one sweep have in common."""
    return row["sweep"] + (f", {row['variant']}" if row["variant"] else "") + (
        f" ({row['backend']})" if row["backend"] != "local" else "")


def sort_key(row):
    return (row["points_per_core"] or row["points_asked"], row["cores"], row["threads"])


ROW_HEAD = ["method", "stop", "points", "ranks x threads"]


def row_head(row):
    """The cells below ROW_HEAD."""
    return [row["method"], row["stop"], f"{row['points_asked']:,}", f"{row['ranks']} x {row['threads']}"]


def times_of(row):
    """Seconds, spread, efficiency and serial fraction of a row."""
    share = OVERSUBSCRIBED if row["oversubscribed"] else number(row["efficiency"], ".2f")
    return [number(row["seconds"], ".3g"), percent(row["spread"]), share, number(row["serial_fraction"], ".3f"),
            str(row["iterations"])]


def published_time(row, reference):
    """Returns the seconds of TriMe++ for a row, or an empty text if they are unknown or belong to another way to place
    points."""
    variant, seconds = reference.get(key_of(row, ("reference", "points_asked", "method", "cores")), ("", ""))
    return seconds if row["variant"] in ("", variant) else ""


def efficiency_table(rows, reference):
    """A fixed number of sweeps (the machine) and the stop rule (the user) side by side, of one method.

    `reference`: published times, see reference_times; a column if any fits.
    """
    stops = list(dict.fromkeys(row["stop"] for row in rows))
    head = ["points", "ranks x threads"]
    for stop in stops:
        head += [f"{stop}: seconds", "spread", "E", "serial", "sweeps"]
    body, published = [], []
    for same in group_by(sorted(rows, key=sort_key), lambda row: key_of(row, ("points_asked", "ranks", "threads"))):
        by_stop = {row["stop"]: row for row in same}
        cells = [f"{same[0]['points_asked']:,}", f"{same[0]['ranks']} x {same[0]['threads']}"]
        for stop in stops:
            cells += times_of(by_stop[stop]) if stop in by_stop else [""] * 5
        published.append(published_time(same[0], reference))
        body.append(cells)
    if any(published):
        head.append("TriMe++: seconds")
        body = [cells + [seconds] for cells, seconds in zip(body, published)]
    return markdown_table(head, body)


def phase_table(rows):
    """Seconds of each phase, mean over ranks; set-up, mesh and output of each row apart."""
    names = list(dict.fromkeys(name for row in rows for name in row["phases"]))
    body = [row_head(row) + [number(row["set_up_s"], ".3f"), number(row["mesh_s"], ".3f"),
                             number(row["output_s"] or None, ".3f"), number(row["command_s"], ".2f")]
            + [number(row["phases"].get(name, {}).get("avg"), ".3f") for name in names] for row in rows]
    return markdown_table(ROW_HEAD + ["set-up", "mesh", "output", "command"] + names, body)


def quality_table(rows):
    """What was made: counts, quality, traffic, memory, hash."""
    body = []
    for row in rows:
        quality = row["quality"]
        body.append(row_head(row) + [
                     f"{row['points']:,}", number(quality.get("alpha_median"), ".4f"),
                     number(quality.get("alpha_mean"), ".4f"), number(quality.get("alpha_max"), ".3f"),
                     number(quality.get("min_angle_degrees"), ".1f"), number(row["imbalance"], ".2f"),
                     f"{row['messages']:,}", f"{row['bytes']:,}", f"{row['collectives']:,}",
                     number(row["bytes_per_point"], ".0f"), row["mesh_hash"], "OK" if row["same_mesh"] else "MISMATCH"])
    return markdown_table(ROW_HEAD + ["made", "median alpha", "mean", "max", "min angle", "imbalance", "messages",
                                      "bytes", "collectives", "bytes/point", "mesh_hash", "same mesh"], body)


def counter_text(counter):
    """Mean of the ranks, and the largest where they differ."""
    if not counter:
        return ""
    most = f" ({counter['max']:,.4g})" if counter["max"] != counter["min"] else ""
    return f"{counter['mean']:,.4g}{most}"


def counter_table(rows):
    """Returns the counters of the whole run except the traffic, or no lines if there are no counters."""
    names = [name for name in dict.fromkeys(name for row in rows for name in row["counters"].get("run", {}))
             if name not in TRAFFIC]
    if not names:
        return []
    body = [row_head(row) + [counter_text(row["counters"].get("run", {}).get(name)) for name in names] + [row["limit"]]
            for row in rows]
    return ["Counters, mean of the ranks (largest):", "",
            *markdown_table(ROW_HEAD + names + ["what limits the run"], body), ""]


def sweep_text(rows, reference):
    """All tables of one sweep and variant."""
    first = rows[0]
    what = ("Strong scaling: E = T1/(p Tp), `points` are those of the mesh." if first["kind"] == "strong" else
            "Weak scaling: E = T1/Tp, the points of one core are the same in all rows.")
    lines = [f"## {title_of(first)}", "", f"`{first['config']}`. {what}", ""]
    for of_method in group_by(rows, lambda row: row["method"]):
        bases = " or ".join(dict.fromkeys(curve[0]["base"] for curve in curves_of(of_method)))
        lines += [f"### {of_method[0]['method']}", "", f"Base: {bases}.", "",
                  *efficiency_table(of_method, reference), ""]
    ordered = [row for of_method in group_by(rows, lambda row: (row["method"], row["stop"]))
               for row in sorted(of_method, key=sort_key)]
    return lines + ["Seconds by phase, mean over ranks:", "", *phase_table(ordered), "", "What was made:", "",
                    *quality_table(ordered), "", *counter_table(ordered)]


def machine_text(machine):
    """The block of the machine."""
    about = [f"* {key.replace('_', ' ')}: {value}" for key, value in machine.items() if key != "environment"]
    environment = " ".join(f"{key}={value}" for key, value in machine.get("environment", {}).items()) or "none"
    return ["## Machine", "", *about, f"* environment: {environment}", ""]


def report(rows, machine, reference, notes=()):
    """The whole Markdown text; `notes`: failures and other words that belong to the top."""
    repeats = sorted({row["repeats"] for row in rows})
    counts = " to ".join(str(count) for count in dict.fromkeys((repeats[0], repeats[-1])))
    few = " Fewer than five say little about the spread." if repeats[0] < 5 else ""
    lines = ["# Scaling", "",
             f"Medians of the runs of each case ({counts}) after warm-ups that are dropped. The cases took turns.{few}",
             "",
             "* `fixed`: a fixed number of sweeps, so the work is the same in all rows: how the machine scales. "
             "`rule`: the stop rule of the method: what a user waits for.",
             "* seconds: from the start of the program to the finished mesh, without output. Set-up, output and the "
             "whole command with the start of MPI stand in the table by phase.",
             "* spread: width of the middle half of the runs over the median. serial: the fraction of Karp and Flatt.",
             f"* `{OVERSUBSCRIBED}`: more threads than cores; such a row has no efficiency.", ""]
    lines += [f"**{note.splitlines()[0]}**\n" for note in notes]
    for group in group_by(rows, lambda row: key_of(row, ("backend", "sweep", "variant", "output"))):
        lines += sweep_text(group, reference)
    return "\n".join(lines + machine_text(machine))


def flat(row):
    """A row for CSV: quality as quality_NAME, average seconds of the phases as phase_NAME."""
    plain = {key: value for key, value in row.items() if key not in ("phases", "quality", "counters", "options")}
    plain["options"] = " ".join(row["options"])
    plain |= {f"quality_{key}": value for key, value in row["quality"].items() if not isinstance(value, (list, dict))}
    plain |= {f"{name}_{key}": counter[key] for name, counter in row["counters"].get("run", {}).items()
              for key in ("mean", "max")}
    return plain | {"phase_" + name.replace(" ", "_"): phase["avg"] for name, phase in row["phases"].items()}


def write_csv(path, rows):
    """One line per row."""
    flattened = [flat(row) for row in rows]
    names = list(dict.fromkeys(name for row in flattened for name in row))
    with path.open("w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, names)
        writer.writeheader()
        writer.writerows(flattened)


def reference_times(path):
    """Published times of TriMe++ from reference.csv: variant and text of seconds by (name, points, method, threads)."""
    with path.open(encoding="utf-8") as stream:
        lines = (line for line in stream if not line.startswith("#"))
        return {(row["name"], int(float(row["points"])), row["method"], int(row["threads"])):
                (row["variant"], row["seconds"]) for row in csv.DictReader(lines)}
