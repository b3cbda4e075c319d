#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes a coast from a seed that is rougher than a real one: bays within bays, narrow inlets, islands and lakes of all
sizes.

Usage: rough_coast.py SEED      prints the contour, x y per line and a blank line between rings

The coast is the line of height 0 of a random landscape: midpoint displacement of a square grid (diamonds and squares
alternately) on a mound. Islands and lakes of such a landscape follow a power law. The script uses only + - * / of
doubles, so one seed gives one text on every machine.
"""
import random
import sys

LEVELS = 8  # the grid has 2^LEVELS cells a side
ROUGH = 0.74  # displacements of a level over those of the level above; with 0.5 the coast is smooth
MOUND = 1.6  # height of the mound over the first displacement
SMALLEST = 12.0  # [cells] area of the smallest ring that is kept
NEAREST = 0.15  # [cells] least distance of a vertex of the coast from a vertex of the grid: no segment is very short


def landscape(seed):
    """Heights of the grid, by row; below 0 is water, and so is the whole border."""
    rng, n = random.Random(seed), 2**LEVELS
    height = [[0.0] * (n + 1) for _ in range(n + 1)]

    def displace(i, j, around, span):
        inside = [height[b][a] for a, b in around if 0 <= a <= n and 0 <= b <= n]
        height[j][i] = sum(inside) / len(inside) + span * rng.uniform(-1, 1)

    step, span = n, 1.0
    while step > 1:
        half = step // 2
        for j in range(half, n, step):
            for i in range(half, n, step):
                displace(i, j, [(i + a, j + b) for a in (-half, half) for b in (-half, half)], span)
        for j in range(0, n + 1, half):
            for i in range((j + half) % step, n + 1, step):
                displace(i, j, [(i - half, j), (i + half, j), (i, j - half), (i, j + half)], span)
        step, span = half, span * ROUGH
    for j in range(n + 1):
        for i in range(n + 1):
            x, y = 2 * i / n - 1, 2 * j / n - 1
            height[j][i] += MOUND * (0.35 - x * x - y * y)
            if i in (0, n) or j in (0, n):
                height[j][i] = -1.0
    return height


def segments_of(height):
    """The coast in each cell, land on the left: {crossed edge: next crossed edge}, an edge as its two grid vertices."""
    following = {}
    for j in range(len(height) - 1):
        for i in range(len(height) - 1):
            corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
            values = [height[b][a] for a, b in corners]
            land = [value >= 0 for value in values]
            leaves = [k for k in range(4) if land[k] and not land[(k + 1) % 4]]
            enters = [k for k in range(4) if not land[k] and land[(k + 1) % 4]]
            for k in leaves:
                if len(enters) == 2:  # a saddle: its middle is land or water
                    to = (k + 1) % 4 if sum(values) >= 0 else (k + 3) % 4
                else:
                    to = enters[0]
                following[corners[k], corners[(k + 1) % 4]] = (corners[(to + 1) % 4], corners[to])
    return following


def signed_area(ring):
    """Positive if counter-clockwise."""
    return sum(a * d - b * c for (a, b), (c, d) in zip(ring, ring[1:] + ring[:1])) / 2


def rough_coast(seed):
    """Rings of (x, y), the largest first: land counter-clockwise, lakes clockwise. No two touch."""
    height = landscape(seed)
    following, rings = segments_of(height), []

    def place(edge):
        """Where the coast crosses an edge, from land to water."""
        (i, j), (k, m) = edge
        share = height[j][i] / (height[j][i] - height[m][k])
        share = min(max(share, NEAREST), 1 - NEAREST)
        return round(i + share * (k - i), 4), round(j + share * (m - j), 4)

    while following:
        first = edge = next(iter(following))
        ring = []
        while True:
            ring.append(place(edge))
            edge = following.pop(edge)
            if edge == first:
                break
        rings.append(ring)
    # What lies within a ring is smaller: nothing is kept in a ring that is dropped.
    return sorted((ring for ring in rings if abs(signed_area(ring)) >= SMALLEST), key=lambda r: -abs(signed_area(r)))


def text_of(rings):
    """The contour file."""
    return "\n".join("".join(f"{x} {y}\n" for x, y in ring) for ring in rings)


if __name__ == "__main__":
    sys.stdout.write(text_of(rough_coast(int(sys.argv[1]))))
