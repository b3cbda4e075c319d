# SPDX-License-Identifier: BSD-3-Clause
"""Reads and writes rings of points, computes areas by even-odd nesting, and finds segments that cross.

A ring is an array (n, 2) that does not repeat its first point. The text is that of a contour file.
"""
import fractions

import numpy as np


def text_of(rings):
    """The contour file: x y per line, a blank line between rings; 13 digits, so that a seed gives one text
    everywhere."""
    return "\n".join("".join(f"{x:.13g} {y:.13g}\n" for x, y in ring) for ring in rings)


def rings_of(text):
    """The rings of a contour file; a closing point is dropped, as are points that repeat the one before."""
    rings, ring = [], []
    for line in text.splitlines() + [""]:
        words = line.split("#")[0].split()
        if words:
            ring.append((float(words[0]), float(words[1])))
        elif ring and not line.strip():
            rings.append(np.array(ring))
            ring = []
    return [ring[(ring != np.roll(ring, 1, axis=0)).any(axis=1)] for ring in rings]


def signed_area(ring):
    """Positive if counter-clockwise."""
    x, y = (ring - ring[0]).T
    return 0.5 * float(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1)))


def normalized(rings, low=(0.0, 0.0), high=(1.0, 1.0)):
    """Returns the rings as `normalize` of a contour places them: the bounding box is centred in the container, and its
    longer side is 0.8 of the container's shorter side."""
    low, high, points = np.array(low), np.array(high), np.concatenate(rings)
    box_low, box_high = points.min(axis=0), points.max(axis=0)
    scale = 0.8 * (high - low).min() / (box_high - box_low).max()
    return [(ring - (box_low + box_high) / 2) * scale + (low + high) / 2 for ring in rings]


def simple_rings(rings):
    """Rings that touch themselves in a vertex are taken apart there; a ring given twice counts once."""
    parts, seen = [], set()
    for ring in rings:
        stack, at = [], {}
        for point in map(tuple, ring):
            if point in at:
                start = at[point]
                parts.append(stack[start:])
                for gone in stack[start:]:
                    del at[gone]
                del stack[start:]
            at[point] = len(stack)
            stack.append(point)
        parts.append(stack)
    unique = []
    for part in parts:
        if len(part) >= 3 and frozenset(part) not in seen:
            seen.add(frozenset(part))
            unique.append(np.array(part))
    return unique


def inside(ring, point):
    """By even-odd."""
    (x, y), (u, v) = ring.T, point
    x2, y2 = np.roll(x, -1), np.roll(y, -1)
    over = np.flatnonzero((y > v) != (y2 > v))
    return int((u < x[over] + (v - y[over]) / (y2[over] - y[over]) * (x2[over] - x[over])).sum()) % 2 == 1


def depths(rings):
    """How many other rings each ring lies in; rings may touch in vertices, so the middle of a segment is asked."""
    low, high = np.array([r.min(axis=0) for r in rings]), np.array([r.max(axis=0) for r in rings])
    counts = []
    for k, ring in enumerate(rings):
        point = 0.5 * (ring[0] + ring[1])
        around = np.flatnonzero(((low <= point) & (point <= high)).all(axis=1))
        counts.append(sum(inside(rings[m], point) for m in around if m != k))
    return counts


def even_odd_area(rings):
    """The area of the shape that the rings bound."""
    rings = simple_rings(rings)
    return float(sum(abs(signed_area(ring)) * (-1) ** depth for ring, depth in zip(rings, depths(rings))))


def segments_of(rings):
    """Starts (n, 2) and ends (n, 2) of all sides."""
    return np.concatenate(rings), np.concatenate([np.roll(ring, -1, axis=0) for ring in rings])


def candidate_pairs(starts, ends):
    """Pairs of segments that come near each other: those that share a cell of a grid, each at least once."""
    span = ends - starts
    length = np.hypot(*span.T)
    cell = max(float(np.median(length)), float(length.sum()) / (4 * len(length)))
    pieces = np.ceil(length / cell).astype(np.int64) + 1  # points along a segment, less than a cell apart
    owner = np.repeat(np.arange(len(starts)), pieces + 1)
    place = np.arange(len(owner)) - np.repeat(np.cumsum(pieces + 1) - pieces - 1, pieces + 1)
    points = starts[owner] + span[owner] * (place / pieces[owner])[:, None]
    keys = []
    for dx in (-0.5, 0.5):  # the cells around a point, so that no piece slips through between two cells
        for dy in (-0.5, 0.5):
            i, j = np.floor(points / cell + (dx, dy)).astype(np.int64).T
            keys.append(np.stack([i * 2**31 + j, owner], axis=1))
    keys = np.unique(np.concatenate(keys), axis=0)
    first, ahead = np.arange(len(keys)), 0
    while True:
        ahead += 1
        first = first[first + ahead < len(keys)]
        first = first[keys[first, 0] == keys[first + ahead, 0]]
        if len(first) == 0:
            return
        yield keys[first, 1], keys[first + ahead, 1]


def side(a, b, c):
    """Sign of the area of the triangles a b c, 0 where rounding may have decided."""
    left, right = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]), (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])
    value = left - right
    return np.where(np.abs(value) > 4e-16 * (np.abs(left) + np.abs(right)), np.sign(value), 0)


def exact_side(a, b, c):
    """The sign for three points, exactly."""
    (ax, ay), (bx, by), (cx, cy) = ([fractions.Fraction(float(v)) for v in p] for p in (a, b, c))
    value = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    return (value > 0) - (value < 0)


def meet(a, b, c, d):
    """Do the closed segments ab and cd cross or overlap, common ends apart? Exact; ends on the other segment count."""
    signs = exact_side(a, b, c), exact_side(a, b, d), exact_side(c, d, a), exact_side(c, d, b)
    a, b, c, d = map(tuple, (a, b, c, d))
    if {a, b} == {c, d}:
        return True
    common = {a, b} & {c, d}
    if common:
        shared, = common
        p, q = (b if a == shared else a), (d if c == shared else c)
        return signs[0] == signs[1] == 0 and sum((p[k] - shared[k]) * (q[k] - shared[k]) for k in (0, 1)) > 0
    if signs == (0, 0, 0, 0):
        return all(min(a[k], b[k]) <= max(c[k], d[k]) and min(c[k], d[k]) <= max(a[k], b[k]) for k in (0, 1))
    return signs[0] * signs[1] <= 0 and signs[2] * signs[3] <= 0


def crossings(rings, most=10):
    """Pairs of numbers of segments (those of segments_of) that cross, overlap, or touch elsewhere than in common
    ends."""
    starts, ends = segments_of(rings)
    found = set()
    for m, n in candidate_pairs(starts, ends):
        a, b, c, d = starts[m], ends[m], starts[n], ends[n]
        near = ((np.minimum(a, b) <= np.maximum(c, d)) & (np.minimum(c, d) <= np.maximum(a, b))).all(axis=1)
        m, n, a, b, c, d = (v[near] for v in (m, n, a, b, c, d))
        signs = side(a, b, c), side(a, b, d), side(c, d, a), side(c, d, b)
        maybe = (signs[0] * signs[1] <= 0) & (signs[2] * signs[3] <= 0)
        common = (a == c).all(axis=1) | (a == d).all(axis=1) | (b == c).all(axis=1) | (b == d).all(axis=1)
        maybe &= ~common | ((signs[0] == 0) & (signs[1] == 0))  # with a common end only if in line
        for k in np.flatnonzero(maybe):
            if meet(a[k], b[k], c[k], d[k]):
                found.add((int(m[k]), int(n[k])))
                if len(found) >= most:
                    return sorted(found)
    return sorted(found)
