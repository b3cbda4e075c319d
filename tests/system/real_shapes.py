#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes realistic boundaries from a seed: coasts, islands, walls, slits, needles, rings that touch.

Usage: real_shapes.py KIND SEED VERTICES [-o FILE.xy]     writes the contour, x y per line, a blank line between rings
       real_shapes.py --list                              lists the kinds, and the two sets of shapes

No two rings of a shape cross, and none crosses itself. TUNING is for work on the mesher. HELD_OUT is only for reports:
no decision may depend on it. `judge.py` meshes the sets and judges the meshes.
"""
import argparse
import inspect
import math
import pathlib
import sys

import numpy as np

import real_coasts
import real_walls
from real_walls import rough_ring, spread
from ring_tools import crossings, text_of

TURN = 2 * math.pi


def generator(seed):
    return np.random.Generator(np.random.PCG64(seed))


def log_uniform(rng, low, high, count=None):
    return low * (high / low) ** rng.random(count)


def contours(seed, vertices):
    """Contouring output: land of a fractal landscape, with islands by power law, lakes, straits."""
    return real_coasts.coast(seed, vertices)


def ocean(seed, vertices):
    """The water around such land, in a box: islands are holes, lakes are pieces."""
    rings = real_coasts.coast(seed, vertices - 4)
    low, high = np.concatenate(rings).min(axis=0), np.concatenate(rings).max(axis=0)
    margin = 0.1 * (high - low).max()
    (a, b), (c, d) = low - margin, high + margin
    return [np.array([(a, b), (c, b), (c, d), (a, d)])] + rings


def near_vertices(seed, vertices):
    """Contouring output where every second vertex is given twice, 1e-7 of the size apart."""
    rings = real_coasts.coast(seed, vertices // 2, nearest=0.02)
    rng = generator(seed)
    reach = 1e-7 * np.ptp(np.concatenate(rings), axis=0).max()
    result = []
    for ring in rings:
        along = np.roll(ring, -1, axis=0) - ring
        along *= (reach / np.hypot(*along.T))[:, None]
        aside = np.stack([-along[:, 1], along[:, 0]], axis=1)
        share = rng.random((2, len(ring), 1))
        twins = ring + (0.2 + 0.8 * share[0]) * along + 0.02 * (share[1] - 0.5) * aside
        result.append(np.stack([ring, twins], axis=1).reshape(-1, 2))
    return result


def spits(seed, vertices):
    """One rough coast with hooked spits and inlets, 1e-4 to 0.05 wide, twisted around its centre."""
    rng = generator(seed)
    count, per_side = max(3, vertices // 100), 20
    centres = (np.arange(count) + 0.25 + 0.5 * rng.random(count)) * TURN / count
    widths = np.minimum(log_uniform(rng, 1e-4, 5e-2, count), 0.4 * TURN / count)
    lengths = (0.05 + 0.4 * rng.random(count)) * np.where(rng.random(count) < 0.5, 1, -1)
    smooth = vertices - count * (2 * per_side + 1)
    rough = rough_ring(rng, smooth, roughness=0.55)
    free = np.ones(smooth, bool)
    angle = np.arange(smooth) * TURN / smooth
    for centre, width in zip(centres, widths):
        free &= np.abs(angle - centre) > 0.6 * width
    # The base keeps its number of vertices: those in the way of spits are spread over the rest.
    arcs = np.sort(np.concatenate([angle[free], spread(rng, angle[free], int((~free).sum()))]))
    base = np.interp(arcs, angle, rough, period=TURN)
    thetas, radii = [arcs], [base]
    for centre, width, length in zip(centres, widths, lengths):
        t = np.arange(1, per_side + 1) / per_side
        root = np.interp(centre, angle, rough, period=TURN)
        half = 0.5 * width * np.sort(1 - 0.8 * rng.random(per_side))[::-1]
        out = root + length * t
        thetas += [centre - half, [centre], (centre + half)]
        radii += [out, [root + 1.002 * length], out]
    theta, radius = np.concatenate(thetas), np.concatenate(radii)
    order = np.argsort(theta, kind="stable")
    theta, radius = theta[order], np.maximum(radius[order], 0.2)
    twist, phase = 0.6 + 0.4 * rng.random(), TURN * rng.random()
    while True:  # without twist the ring is a star, which cannot cross itself
        bent = theta + twist * np.sin(2.5 * radius + phase)
        ring = np.stack([radius * np.cos(bent), radius * np.sin(bent)], axis=1)
        if twist == 0 or not crossings([ring]):
            return [ring]
        twist = 0 if twist < 0.01 else twist / 2


def discs_apart(rng, radii, room):
    """Centres of discs within a disc of radius `room`, none nearer than 1 % of its radius; as many as find a place."""
    placed = np.empty((0, 3))
    for radius in radii:
        for _ in range(20):
            angle, distance = TURN * rng.random(), (room - radius) * math.sqrt(rng.random())
            x, y = distance * math.cos(angle), distance * math.sin(angle)
            if not (np.hypot(placed[:, 0] - x, placed[:, 1] - y) < placed[:, 2] + 1.01 * radius).any():
                placed = np.concatenate([placed, [(x, y, radius)]])
                break
    return placed


def islands(seed, vertices):
    """A main land and islands by power law, from a tenth of its size down to 2e-3; four in ten are smaller, to 1e-5."""
    rng = generator(seed)
    count = min(3000, vertices // 12)
    radii = np.minimum(0.3, 2e-3 * rng.random(count) ** -0.9)
    radii = np.where(rng.random(count) < 0.4, log_uniform(rng, 1e-5, 2e-3, count), radii)
    radii = np.concatenate([[1.0], np.sort(radii)[::-1]])
    discs = discs_apart(rng, radii, 1.7)
    weights = discs[:, 2] ** 0.7
    counts = 3 + np.floor((vertices - 3 * len(discs)) * weights / weights.sum()).astype(int)
    counts[0] += vertices - counts.sum()
    return [real_walls.rough_disc(rng, disc, number) for disc, number in zip(discs, counts)]


def sea(seed, vertices):
    """The same, the sea being the shape: islands are holes of a box."""
    return [2.0 * np.array([(-1.0, -1.0), (1, -1), (1, 1), (-1, 1)])] + islands(seed, vertices - 4)


def nested(seed, vertices):
    """Lakes in islands in lakes, down to where they are some 1e-6 wide; rims are 1e-4 to 0.3 of the radius wide."""
    rng, discs, front = generator(seed), [(0.0, 0.0, 1.0)], [(0.0, 0.0, 1.0)]
    while front and len(discs) < max(2, vertices // 30):
        x, y, radius = front.pop(0)
        inner = radius * 0.5  # a rough ring of 12 vertices or more stays outside
        sizes = [1 - log_uniform(rng, 1e-4, 0.3)] if rng.random() < 0.3 else 0.15 + 0.3 * rng.random(4)
        for u, v, r in discs_apart(rng, np.sort(np.asarray(sizes) * inner)[::-1], inner):
            discs.append((x + u, y + v, r))
            front.append(discs[-1])
    weights = np.array([disc[2] for disc in discs]) ** 0.5
    counts = 12 + np.floor((vertices - 12 * len(discs)) * weights / weights.sum()).astype(int)
    counts[0] += vertices - counts.sum()
    return [real_walls.rough_disc(rng, disc, number) for disc, number in zip(discs, counts)]


def carpet(seed, vertices):
    """Holes of a Sierpinski carpet, turned and stretched a little; the rest of the vertices subdivide their sides."""
    rng, depth = generator(seed), 1
    while 4 * (1 + sum(8**k for k in range(depth + 1))) <= vertices:
        depth += 1
    corners = np.array([(-1.0, -1), (1, -1), (1, 1), (-1, 1)])
    rings, squares = [corners * 0.52 + 0.5], [(0.5, 0.5, 1.0)]
    for _ in range(depth):
        for x, y, size in squares:
            turn, half = 0.3 * (rng.random() - 0.5), size / 6 * (0.55 + 0.3 * rng.random())
            rotation = np.array([(math.cos(turn), math.sin(turn)), (-math.sin(turn), math.cos(turn))])
            rings.append(half * corners @ rotation + (x, y))
        squares = [(x + a * size / 3, y + b * size / 3, size / 3) for x, y, size in squares
                   for a in (-1, 0, 1) for b in (-1, 0, 1) if (a, b) != (0, 0)]
    return real_walls.subdivided(rng, rings, vertices)


def touching(seed, vertices):
    """Rings that touch themselves (a necklace), each other (a pair of islands) and a hole that touches its ring."""
    rng = generator(seed)
    beads, share = 6, vertices // 4
    knots = np.arange(beads + 1) / beads
    upper, lower = [], []
    for left, right in zip(knots, knots[1:]):
        inner = left + (right - left) * np.sort(rng.random(max(1, share // (2 * beads))))
        bow = 0.08 * np.sin(math.pi * (inner - left) * beads) * (0.7 + 0.3 * rng.random(len(inner)))
        upper += [(left, 0.0)] + list(zip(inner, bow))
        lower += [(left, 0.0)] + list(zip(inner, -bow * (0.5 + 0.5 * rng.random(len(inner)))))
    necklace = np.array(upper + [(1.0, 0.0)] + lower[:0:-1])
    pair = [real_walls.rough_disc(rng, (0.25, 0.4, 0.2), share), real_walls.rough_disc(rng, (0.75, 0.4, 0.2), share)]
    east, west = pair[0][pair[0][:, 0].argmax()], pair[1][pair[1][:, 0].argmin()]
    pair[1] += east - west
    pair[1][pair[1][:, 0].argmin()] = east
    left = vertices - len(necklace) - 2 * share
    box = np.array([(0.0, -0.6), (0.5, -0.6), (1.0, -0.6), (1, -0.2), (0, -0.2)])
    hole = real_walls.rough_disc(rng, (0.5, -0.4, 0.15), left - len(box))
    lowest = hole[:, 1].argmin()
    hole += box[1] - hole[lowest]
    hole[lowest] = box[1]
    return [necklace, *pair, box, hole]


def twice(seed, vertices):
    """Contouring output whose second ring is given twice, the other way round and from another vertex."""
    rng, number = generator(seed), vertices - len(real_coasts.coast(seed, vertices)[1])
    while True:
        rings = real_coasts.coast(seed, number)
        copy = np.roll(rings[1][::-1], 2, axis=0)
        over = number + len(copy) - vertices
        if over <= 0:
            return real_walls.subdivided(rng, rings[:1], len(rings[0]) - over) + rings[1:] + [copy]
        number -= over


def crack(seed, vertices):
    """A square with a crack from its right side; seed 1: 1e-4 wide, straight; others 1e-2 to 1e-6 wide and kinked."""
    rng = generator(seed)
    if seed == 1:
        ring = np.array([(0, 0), (1, 0), (1, .5), (.5, .5), (.5, .5001), (1, .5001), (1, 1), (0, 1)])
    else:
        width, depth, kinks = log_uniform(rng, 1e-6, 1e-2), 0.3 + 0.5 * rng.random(), 1 + int(4 * rng.random())
        x = np.linspace(1, 1 - depth, kinks + 2)
        y = 0.5 + np.cumsum(0.12 * (rng.random(kinks + 2) - 0.5))
        low = np.stack([x, y], axis=1)
        high = np.stack([x, y + width], axis=1)[::-1]
        ring = np.array([(0.0, 0.0), (1, 0), *low, *high, (1, 1), (0, 1)])
    return real_walls.subdivided(rng, [ring], vertices)


def tip(seed, vertices):
    """A square with a long thin tip that is blunt; seed 1: that of 2e-6; others 1e-3 to 1e-7 blunt."""
    rng = generator(seed)
    blunt = 1e-6 if seed == 1 else log_uniform(rng, 1e-7, 1e-3)
    reach = 1.3 if seed == 1 else 1.1 + 0.5 * rng.random()
    ring = np.array([(0, 0), (1, 0), (1, .4), (reach, .5 - blunt), (reach + 0.4 * blunt, .5), (reach, .5 + blunt),
                     (1, .6),
                     (1, 1), (0, 1)])
    return real_walls.subdivided(rng, [ring], vertices)


def wave(seed, vertices):
    """The ring r = 1 + 0.1 sin 7t + 0.001 sin 3000t; other seeds than 1 shift the waves."""
    rng = generator(seed)
    first, second = (0.0, 0.0) if seed == 1 else TURN * rng.random(2)
    t = np.arange(vertices) * TURN / vertices
    r = 1 + 0.1 * np.sin(7 * t + first) + 0.001 * np.sin(3000 * t + second)
    return [np.stack([r * np.cos(t), r * np.sin(t)], axis=1)]


KINDS = {
    **{kind.__name__: kind for kind in (contours, ocean, near_vertices, spits, islands, sea, nested, carpet, touching,
                                        twice, crack, tip, wave)},
    **{kind.__name__: kind for kind in (real_walls.near_touch, real_walls.walls, real_walls.comb, real_walls.spiral,
                                        real_walls.breakwaters, real_walls.needles, real_walls.delta)},
}

# (kind, seed, vertices)
TUNING = [
    ("contours", 1, 1000), ("contours", 2, 4000), ("contours", 3, 10000), ("ocean", 4, 3000),
    ("near_vertices", 5, 2000),
    ("spits", 6, 2000), ("islands", 7, 3000), ("sea", 8, 3000), ("nested", 9, 2000), ("near_touch", 10, 2000),
    ("walls", 11, 2000), ("carpet", 12, 2500), ("touching", 13, 1000), ("twice", 14, 1500), ("crack", 1, 8),
    ("crack", 15, 100), ("tip", 1, 9), ("tip", 16, 100), ("wave", 1, 10000), ("comb", 17, 1000), ("spiral", 18, 1000),
    ("breakwaters", 19, 1000), ("needles", 20, 1000), ("delta", 21, 2000),
]
HELD_OUT = [
    ("contours", 1001, 1500), ("contours", 1002, 6000), ("contours", 1003, 10000), ("ocean", 1004, 4000),
    ("near_vertices", 1005, 3000), ("spits", 1006, 3000), ("islands", 1007, 2000), ("sea", 1008, 4000),
    ("nested", 1009, 3000), ("near_touch", 1010, 3000), ("walls", 1011, 3000), ("carpet", 1012, 3000),
    ("touching", 1013, 1500), ("twice", 1014, 2000), ("crack", 1015, 40), ("tip", 1016, 40), ("wave", 1017, 8000),
    ("comb", 1018, 2000), ("spiral", 1019, 2000), ("breakwaters", 1020, 2000), ("needles", 1021, 2000),
    ("delta", 1022, 3000),
]
SETS = {"tuning": TUNING, "held_out": HELD_OUT}


def shape(kind, seed, vertices):
    """The rings of a shape, each an array (n, 2)."""
    return KINDS[kind](seed, vertices)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("kind", nargs="?", choices=KINDS)
    parser.add_argument("seed", nargs="?", type=int)
    parser.add_argument("vertices", nargs="?", type=int)
    parser.add_argument("-o", "--output", type=pathlib.Path, help="contour file (default: standard output)")
    parser.add_argument("--list", action="store_true", help="the kinds, and the two sets of shapes")
    options = parser.parse_args()
    if options.list:
        for name, make in KINDS.items():
            print(f"{name:14} {inspect.getdoc(make)}")
        for name, shapes in SETS.items():
            print(f"\n{name}: " + ", ".join(f"{kind} {seed} {vertices}" for kind, seed, vertices in shapes))
        return
    if options.vertices is None:
        parser.error("KIND SEED VERTICES are needed")
    text = text_of(shape(options.kind, options.seed, options.vertices))
    if options.output:
        options.output.write_text(text, encoding="ascii")
    else:
        sys.stdout.write(text)


if __name__ == "__main__":
    main()
