# SPDX-License-Identifier: BSD-3-Clause
"""Makes coasts like those of contouring programs: the line of height 0 of a random landscape, with any number of
vertices.

It has islands and lakes of all sizes, straits and inlets, and no two rings meet. See real_shapes.py.
"""
import numpy as np

from ring_tools import signed_area

MOST_LEVELS = 12  # the finest grid has 2^12 cells a side: 128 MiB


def with_noise(heights, span, rng):
    return heights + span * (2 * rng.random(heights.shape) - 1)


def landscape(rng, levels, rough, mound):
    """Heights (n + 1, n + 1), n = 2^levels, by midpoint displacement on a mound; the border lies below 0."""
    n = 2**levels
    height, step, span = np.zeros((n + 1, n + 1)), n, 1.0
    while step > 1:
        half = step // 2
        corners = height[::step, ::step]
        middles = with_noise((corners[:-1, :-1] + corners[1:, :-1] + corners[:-1, 1:] + corners[1:, 1:]) / 4, span, rng)
        height[half::step, half::step] = middles
        for grid, inner in ((height, middles), (height.T, middles.T)):
            total = grid[::step, :-1:step] + grid[::step, step::step]
            count = np.full(total.shape, 4.0)
            count[[0, -1]] = 3.0
            total[1:] += inner
            total[:-1] += inner
            grid[::step, half::step] = with_noise(total / count, span, rng)
        step, span = half, span * rough
    x = np.linspace(-1, 1, n + 1)
    height += mound * (0.35 - x[None, :] ** 2 - x[:, None] ** 2)
    height[[0, -1]] = height[:, [0, -1]] = -1.0
    return height


def directed_crossings(height):
    """Two arrays of numbers of grid edges: the line enters a cell through the first, leaves it through the second."""
    n = len(height) - 1
    j, i = np.divmod(np.arange(n * n), n)
    corner = [height[:-1, :-1].ravel(), height[:-1, 1:].ravel(), height[1:, 1:].ravel(), height[1:, :-1].ravel()]
    land = [values >= 0 for values in corner]
    mixed = np.flatnonzero((land[0] != land[1]) | (land[1] != land[2]) | (land[2] != land[3]))
    i, j, land, corner = i[mixed], j[mixed], [v[mixed] for v in land], [v[mixed] for v in corner]
    vertical = (n + 1) ** 2
    edge = np.stack([j * (n + 1) + i, vertical + j * (n + 1) + i + 1, (j + 1) * (n + 1) + i,
                     vertical + j * (n + 1) + i])
    leaves = [land[k] & ~land[(k + 1) % 4] for k in range(4)]
    enters = [~land[k] & land[(k + 1) % 4] for k in range(4)]
    saddle = (land[0] == land[2]) & (land[1] == land[3])
    high = sum(corner) >= 0
    first, second = [], []
    for k in range(4):
        for m in range(4):
            turn = (m - k) % 4
            chosen = leaves[k] & enters[m] & (~saddle | ((turn == 1) & high) | ((turn == 3) & ~high))
            first.append(edge[k, chosen])
            second.append(edge[m, chosen])
    return np.concatenate(first), np.concatenate(second)


def zero_lines(height, nearest):
    """Rings of the line of height 0, land on the left; vertices stay `nearest` of a cell away from grid vertices."""
    n = len(height) - 1
    first, second = directed_crossings(height)
    order = np.argsort(first)
    first, following = first[order], np.searchsorted(first[order], second[order])
    upright = first >= (n + 1) ** 2
    j, i = np.divmod(first - upright * (n + 1) ** 2, n + 1)
    start, end = height[j, i], height[j + upright, i + ~upright]
    share = np.clip(start / (start - end), nearest, 1 - nearest)
    places = np.stack([i + share * ~upright, j + share * upright], axis=1)
    rings, used, following = [], np.zeros(len(first), bool), following.tolist()
    for k in range(len(first)):
        if not used[k]:
            cycle, at = [], k
            while not cycle or at != k:
                cycle.append(at)
                at = following[at]
            used[cycle] = True
            rings.append(places[cycle])
    return sorted(rings, key=lambda ring: -abs(signed_area(ring)))


def with_ripples(rings, extra, height, rng):
    """`extra` more vertices along the sides, moved sideways as far as the grid cell allows: nothing can cross."""
    counts = [len(ring) for ring in rings]
    starts = np.concatenate(rings)
    ends = np.concatenate([np.roll(ring, -1, axis=0) for ring in rings])
    i, j = np.floor((starts + ends) / 2).astype(int).T
    land = [height[j, i] >= 0, height[j, i + 1] >= 0, height[j + 1, i + 1] >= 0, height[j + 1, i] >= 0]
    free = np.flatnonzero((land[0] != land[2]) | (land[1] != land[3]))  # two lines share the cell of a saddle
    added = np.bincount(free[(rng.random(extra) * len(free)).astype(int)], minlength=len(starts))
    owner = np.repeat(np.arange(len(starts)), 1 + added)
    place = np.arange(len(owner)) - np.repeat(np.cumsum(1 + added) - 1 - added, 1 + added)
    span = ends - starts
    points = starts[owner] + span[owner] * (place / (1 + added[owner]))[:, None]
    within = points - np.stack([i, j], axis=1)[owner]
    room = np.minimum(within, 1 - within).min(axis=1) * (place > 0)
    length = np.maximum(np.hypot(*span.T), 1e-300)
    normal = np.stack([-span[:, 1], span[:, 0]], axis=1) / length[:, None]
    points += normal[owner] * (0.9 * room * (2 * rng.random(len(owner)) - 1))[:, None]
    last = np.cumsum(1 + added)[np.cumsum(counts) - 1]
    return np.split(points, last[:-1])


def coast(seed, vertices, nearest=1e-6):
    """Rings with `vertices` vertices in all, the largest first. Roughness, mound and so the islands depend on the
    seed."""
    def lines(levels):
        rng = np.random.Generator(np.random.PCG64(seed))
        rough, mound = 0.62 + 0.2 * rng.random(), 1.0 + 1.2 * rng.random()
        height = landscape(rng, levels, rough, mound)
        return height, zero_lines(height, nearest), rng

    levels = 4
    height, rings, rng = lines(levels)
    while levels < MOST_LEVELS and sum(map(len, rings)) < 0.7 * vertices:
        finer = lines(levels + 1)
        if len(finer[1][0]) > 0.9 * vertices:
            break
        levels, (height, rings, rng) = levels + 1, finer
    total = np.cumsum([len(ring) for ring in rings])
    kept = max(1, int(np.searchsorted(total, vertices, side="right")))  # what lies within a ring is smaller than it
    if total[kept - 1] > vertices:
        raise ValueError(f"a coast of {vertices} vertices: seed {seed} needs {total[0]}")
    return with_ripples(rings[:kept], int(vertices - total[kept - 1]), height, rng)
