# SPDX-License-Identifier: BSD-3-Clause
"""Writes the report on the model as Markdown: measured and modelled times, and predictions for 10^4 ranks.

The predictions come from the fit to all rows. Two other fits show how far it can be trusted. One leaves out the row
that it predicts. The other uses only the rows with few ranks, or with small sizes, and predicts the rest.
"""
import math

from .errors import RunError
from .model import PLATFORMS, fit, sample_of
from .summary import group_by, key_of
from .tables import markdown_table
from .traffic_model import fit_traffic

PROBLEM = ("backend", "config", "method", "variant", "stop", "options")  # rows that one model describes
LEAST_ROWS = 3      # for a model
MANY_RANKS = 4      # that must have been measured for predictions
HELD_RANKS = 2      # this many of the largest numbers of ranks are held out ...
LEAST_RANKS = 3     # ... if as many others are left; else the largest size, if two others are left
BARS = {"local": (0.20, "all rows"), "simulated": (0.25, "rows of 64 ranks and more")}  # what the model must reach
BAR_RANKS = {"local": 1, "simulated": 64}

STRONG_POINTS = (10**6, 10**8, 10**10)
WEAK_POINTS = (10**4, 10**5, 10**6)  # of a rank
RANKS = (1, 4, 16, 64, 256, 1024, 4096, 10**4)
FEWEST_POINTS = 100  # of a rank: below that no row is predicted

TERMS = {"work": "work", "threads": "work that threads do not share", "memory": "memory shared by busy cores",
         "once": "work of each rank", "boundary": "work of each rank on the boundary",
         "tables": "tables of the whole mesh", "packing": "packing", "waiting": "waiting at collectives",
         "ranks": "data that grow with the ranks", "imbalance": "imbalance", "messages": "latency",
         "bytes": "bandwidth", "collectives": "steps of collectives"}
UNITS = {"work": (1e9, "ns a point"), "threads": (1e9, "ns a point"), "memory": (1e9, "ns a point"),
         "once": (1e3, "ms"), "boundary": (1e6, "us sqrt(N)"), "tables": (1e9, "ns N"), "packing": (1e9, "ns a byte"),
         "waiting": (1e6, "us log2 P"), "ranks": (1e9, "ns P")}


def held_out(rows):
    """The rows that the first fit does not see; none where too few are left."""
    ranks, sizes = (sorted({row[key] for row in rows}) for key in ("ranks", "points"))
    if len(ranks) >= LEAST_RANKS + HELD_RANKS:
        return [row for row in rows if row["ranks"] in ranks[-HELD_RANKS:]]
    return [row for row in rows if row["points"] == sizes[-1]] if len(sizes) > 2 else []


def error_text(predicted, row):
    return f"{100 * (predicted / row['seconds'] - 1):+.0f} %"


def left_out(samples, platform):
    """Seconds of each sample by a model that is fitted to all others; a case may be in two sweeps."""
    def others(one):
        case = one.points, one.ranks, one.threads
        return [sample for sample in samples if (sample.points, sample.ranks, sample.threads) != case]
    return [fit(others(sample), platform).seconds(sample) if others(sample) else math.nan for sample in samples]


def check(rows, samples, platform):
    """Lines that compare model and rows, and the model of all rows."""
    held = held_out(rows)
    first = fit([sample for row, sample in zip(rows, samples) if row not in held], platform)
    last, alone = fit(samples, platform), left_out(samples, platform)
    body = []
    for row, sample, other in zip(rows, samples, alone):
        blind = error_text(first.seconds(sample), row) if held else ""
        body.append([f"{row['points']:,}", f"{row['ranks']} x {row['threads']}", f"{row['seconds']:.4g}",
                     f"{last.seconds(sample):.4g}", error_text(last.seconds(sample), row), error_text(other, row),
                     blind, "held out" if row in held else ""])
    lines = markdown_table(["points", "ranks x threads", "measured s", "model s", "error", "fitted to all other rows",
                            "fitted to rows not held out", "row"], body)
    return lines + ["", *bar_text(rows, alone, platform)], last


def bar_text(rows, predicted, platform):
    """Returns the largest error of the rows that count, with the bar."""
    errors = [abs(seconds / row["seconds"] - 1) for row, seconds in zip(rows, predicted)
              if row["ranks"] >= BAR_RANKS.get(platform.name, 1)]
    if platform.name not in BARS or not errors:
        return []
    bar, which = BARS[platform.name]
    return [f"Largest error of {which}, each by the model fitted to all other rows: {100 * max(errors):.0f} % "
            f"(bar: {100 * bar:.0f} %)."]


def factor_text(phase, term):
    """The factor of a term with its unit."""
    per, unit = UNITS[term]
    return f"{per * phase.factors[term]:.3g} {unit}" if term in phase.factors else ""


def coefficient_table(model):
    """What was fitted, by phase; terms that no phase has are left out."""
    used = [term for term in UNITS if any(term in phase.factors for phase in model.phases)]
    return markdown_table(["phase"] + [TERMS[term] for term in used],
                          [[phase.name] + [factor_text(phase, term) for term in used] for phase in model.phases])


def limit_text(terms, total):
    """Returns the largest term except the work, with its phase and its share of the time."""
    losses = {key: seconds for key, seconds in terms.items() if key[1] != "work"}
    (phase, term), seconds = max(losses.items(), key=lambda item: item[1])
    return f"{TERMS[term]}, {phase} ({100 * seconds / total:.0f} %)"


def prediction_row(model, traffic, points, ranks, like, base):
    """Seconds, efficiency and limit of one number of points and ranks; base: seconds for E = 1 here."""
    sample = traffic.sample(points, ranks, like)
    terms = model.terms(sample)
    total = sum(terms.values())
    return [f"{points:.3g}", f"{ranks:,}", f"{total:.3g}", f"{base / total:.2f}", f"{sample.imbalance:.2f}",
            limit_text(terms, total)]


def prediction_tables(model, traffic, like):
    """Strong and weak efficiency to 10^4 ranks."""
    head = ["points", "ranks", "seconds", "E", "imbalance", "largest term beside the work"]
    lines = []
    for points in STRONG_POINTS:
        alone = model.seconds(traffic.sample(points, 1, like))
        body = [prediction_row(model, traffic, points, ranks, like, alone / ranks) for ranks in RANKS
                if points / ranks >= FEWEST_POINTS]
        lines += [f"Strong, {points:.0e} points:", "", *markdown_table(head, body), ""]
    for points in WEAK_POINTS:
        alone = model.seconds(traffic.sample(points, 1, like))
        body = [prediction_row(model, traffic, points * ranks, ranks, like, alone) for ranks in RANKS]
        lines += [f"Weak, {points:.0e} points a rank:", "", *markdown_table(head, body), ""]
    return lines


def assumptions(samples, platform, like, traffic):
    """Returns the assumptions of the predictions."""
    ranks, points = (sorted({getattr(sample, key) for sample in samples}) for key in ("ranks", "points"))
    return ["Assumptions of the predictions:", "",
            f"* platform {platform.source}; overhead of a message {platform.overhead:.2g} s, latency in a node "
            f"{platform.latency:.2g} s, between nodes {platform.network_latency:.2g} s; bandwidth of a rank in a node "
            f"{platform.bandwidth:.3g} B/s, of a node {platform.network_bandwidth:.3g} B/s",
            f"* one in {math.sqrt(platform.cores):.3g} messages and bytes leaves the node; no jams in the network",
            "* one thread a rank; the cores of a node do not slow each other down",
            f"* all goes on as on {ranks[0]} to {ranks[-1]} ranks and {points[0]:.3g} to {points[-1]:.3g} points",
            f"* {like.sweeps} sweeps, each point moved {like.moved / like.points:.3g} times, as in the largest mesh",
            "* traffic as counted, and carried on by the forms of traffic_model.py",
            f"* the fullest rank has 1 + {traffic.granularity:.3g} P/N times the mean: ranks are made of tiles", ""]


def problem_text(rows, machine_cores):
    """All about one config, method and platform."""
    first = rows[0]
    platform = PLATFORMS[first["backend"]]
    samples = [sample_of(row, machine_cores) for row in rows]
    name = ", ".join(filter(None, (first["config"], first["method"], first["stop"], first["variant"])))
    lines = [f"## {name}: {platform.name}", ""]
    if len(rows) < LEAST_ROWS:
        return lines + [f"{len(rows)} rows are too few for a model.", ""]
    checked, model = check(rows, samples, platform)
    lines += [*checked, "", "Fitted to all rows:", "", *coefficient_table(model), ""]
    if max(sample.ranks for sample in samples) < MANY_RANKS:
        return lines
    traffic = fit_traffic(samples)
    largest = max(samples, key=lambda sample: sample.points)
    return lines + assumptions(samples, platform, largest, traffic) + prediction_tables(model, traffic, largest)


def report(rows, machine_cores):
    """The whole text. Raises RunError where scipy is not there."""
    try:
        import scipy.optimize  # noqa: F401
    except ImportError as error:
        raise RunError("--model needs the Python module scipy. Debian: apt-get install python3-scipy") from error
    usable = [row for row in rows if not row["oversubscribed"] and not row["output"]]
    lines = ["# A model of the time", "", "T = work + replicated work + latency x messages + bytes / bandwidth + "
             "collectives x log2 P, phase by phase; scripts/scaling/model.py says how.", ""]
    for group in group_by(usable, lambda row: key_of(row, PROBLEM)):
        lines += problem_text(group, machine_cores)
    return "\n".join(lines)
