# SPDX-License-Identifier: BSD-3-Clause
"""Compares the rows of today with rows of before: lists what became slower by more than the spread of the runs."""
import math

from .summary import CASE, key_of
from .tables import ROW_HEAD, markdown_table, number, percent, row_head

LEAST = 0.05         # smaller changes do not count: times of equal builds differ by as much
SPREADS = 2          # how many times the spread of both a change must exceed
UNKNOWN_SPREAD = 0.3  # of a row with fewer than three runs

HEAD = ["sweep", *ROW_HEAD, "before", "now", "ratio", "threshold", "mesh", "verdict"]
BETTER, SAME, WORSE = "faster", "same", "SLOWER"


def threshold(old, new):
    """The share by which a row must have changed to count."""
    spreads = [UNKNOWN_SPREAD if row["spread"] is None else row["spread"] for row in (old, new)]
    return max(LEAST, SPREADS * math.hypot(*spreads))


def verdict(old, new):
    """Ratio of the seconds, and what it means."""
    ratio, limit = new["seconds"] / max(old["seconds"], 1e-12), 1 + threshold(old, new)
    return ratio, WORSE if ratio > limit else BETTER if ratio < 1 / limit else SAME


def compare(old_rows, new_rows):
    """Lines of Markdown, and the number of rows that got slower. Rows of one side only are counted, not compared."""
    before = {key_of(row, CASE): row for row in old_rows}
    body, slower, compared = [], 0, 0
    for row in new_rows:
        old = before.get(key_of(row, CASE))
        if old is None:
            continue
        compared += 1
        ratio, word = verdict(old, row)
        slower += word == WORSE
        body.append([row["sweep"], *row_head(row), number(old["seconds"], ".3g"), number(row["seconds"], ".3g"),
                     number(ratio, ".2f"), percent(threshold(old, row)),
                     "same" if old["mesh_hash"] == row["mesh_hash"] else "another", word])
    lines = ["## Compared with before", "",
             f"{compared} rows have a row of before; {len(new_rows) - compared} are new, {len(old_rows) - compared} "
             f"are gone. A change counts above {100 * LEAST:.0f} % and {SPREADS} times the spread of both. "
             f"{slower} got slower.", "", *markdown_table(HEAD, body), ""]
    return lines, slower
