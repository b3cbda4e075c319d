# SPDX-License-Identifier: BSD-3-Clause
"""Makes shapes with thin parts: honeycombs, slits, curved walls, needles, channels. See real_shapes.py."""
import math

import numpy as np

TURN = 2 * math.pi


def generator(seed):
    return np.random.Generator(np.random.PCG64(seed))


def spread(rng, ordered, count):
    """`count` new numbers in gaps between ordered numbers, by chance, no two in one place."""
    gap = np.floor(rng.random(count) * (len(ordered) - 1)).astype(int)
    return ordered[gap] + (ordered[gap + 1] - ordered[gap]) * (0.1 + 0.8 * rng.random(count))


def rough_ring(rng, count, roughness=0.55):
    """Radii around 1 of a rough closed curve at `count` equal angles: midpoint displacement, between 0.75 and 1.25."""
    size = 8
    radii = 2 * rng.random(size) - 1
    span = 1.0
    while size < count:
        span *= roughness
        middles = 0.5 * (radii + np.roll(radii, -1)) + span * (2 * rng.random(size) - 1)
        radii, size = np.stack([radii, middles], axis=1).ravel(), 2 * size
    radii = np.interp(np.arange(count) / count, np.arange(size + 1) / size, np.append(radii, radii[0]))
    return 1 + 0.25 * radii / max(1.0, float(np.abs(radii).max()))


def rough_disc(rng, disc, count):
    """A rough ring of `count` vertices, a star around the centre of the disc (x, y, radius), 0.56 to 1 of its
    radius."""
    x, y, radius = disc
    angle = (np.arange(count) + 0.5 * rng.random(count)) * TURN / count
    # A chord of three to five vertices comes nearer to the centre than its ends; only rings of more lie beyond 0.56.
    radii = radius * (0.78 + 0.88 * (rough_ring(rng, count) - 1))
    return np.stack([x + radii * np.cos(angle), y + radii * np.sin(angle)], axis=1)


def subdivided(rng, rings, vertices):
    """Returns the rings with more vertices on their sides, in line with them, and `vertices` in total."""
    starts = np.concatenate(rings)
    ends = np.concatenate([np.roll(ring, -1, axis=0) for ring in rings])
    weights = np.hypot(*(ends - starts).T)
    chosen = np.searchsorted(np.cumsum(weights), rng.random(max(0, vertices - len(starts))) * weights.sum())
    added = np.bincount(np.minimum(chosen, len(starts) - 1), minlength=len(starts))
    result, at = [], 0
    for ring in rings:
        points = []
        for k in range(at, at + len(ring)):
            share = np.arange(1 + added[k])[:, None] / (1 + added[k])
            points.append(starts[k] + share * (ends[k] - starts[k]))
        result.append(np.concatenate(points))
        at += len(ring)
    return result


def honeycomb(rng, vertices):
    """Hexagonal cells with rough common sides, shrunk apart by 1e-2 to 1e-6 of the cell, side by side differently."""
    per_side = 4
    columns = max(2, round(math.sqrt(vertices / (6 * per_side))))
    rows = max(2, vertices // (6 * per_side * columns))
    corners, sides, gaps = {}, {}, {}

    def corner(x, y):
        key = round(1000 * x), round(1000 * y)
        return corners.setdefault(key, (key, np.array([x, y]) + 0.15 * (2 * rng.random(2) - 1)))

    def points_along(a, b):
        """From a (with it) to b (without it), and how far both neighbours shrink from the side."""
        first, second = min(a, b, key=lambda c: c[0]), max(a, b, key=lambda c: c[0])
        key = first[0], second[0]
        if key not in sides:
            p, q = first[1], second[1]
            t = np.arange(1, per_side) / per_side
            normal = np.array([p[1] - q[1], q[0] - p[0]])
            bow = 0.12 * (2 * rng.random(per_side - 1) - 1) * 4 * t * (1 - t)
            sides[key] = p + t[:, None] * (q - p) + bow[:, None] * normal
            gaps[key] = 1e-6 * 1e4 ** rng.random()
        inner = sides[key] if a is first else sides[key][::-1]
        return np.concatenate([[a[1]], inner]), gaps[key]

    rings = []
    for row in range(rows):
        for column in range(columns):
            centre = np.array([math.sqrt(3) * (column + 0.5 * (row % 2)), 1.5 * row])
            around = [corner(centre[0] + math.sin(k * TURN / 6), centre[1] - math.cos(k * TURN / 6)) for k in range(6)]
            ring = []
            for a, b in zip(around, around[1:] + around[:1]):
                points, gap = points_along(a, b)
                ring.append(centre + (1 - gap) * (points - centre))
            rings.append(np.concatenate(ring))
    return rings


def near_touch(seed, vertices):
    """Honeycomb of meshed cells: islands that nearly touch, with gaps of 1e-2 to 1e-6 of their size."""
    rng = generator(seed)
    return subdivided(rng, honeycomb(rng, vertices), vertices)


def walls(seed, vertices):
    """Honeycomb of holes: meshed walls, 1e-2 to 1e-6 of a cell thick."""
    rng = generator(seed)
    cells = honeycomb(rng, vertices - 4)
    low, high = np.concatenate(cells).min(axis=0) - 0.3, np.concatenate(cells).max(axis=0) + 0.3
    return subdivided(rng, [np.array([low, (high[0], low[1]), high, (low[0], high[1])])] + cells, vertices)


def comb(seed, vertices):
    """A plate with slits from above and below, 1e-2 to 1e-6 of their distance wide; teeth remain between them."""
    rng = generator(seed)
    slits = max(3, min(40, vertices // 10))
    place = (np.arange(slits) + 0.3 + 0.4 * rng.random(slits)) / slits
    half = 0.5 / slits * 1e-6 * 1e4 ** rng.random(slits)
    depth = 0.2 + 0.6 * rng.random(slits)
    below, above = [(0.0, 0.0)], [(1.0, 1.0)]
    for k in range(slits):
        left, right = place[k] - half[k], place[k] + half[k]
        if k % 2 == 0:
            below += [(left, 0.0), (left, depth[k]), (right, depth[k]), (right, 0.0)]
    below.append((1.0, 0.0))
    for k in reversed(range(slits)):
        left, right = place[k] - half[k], place[k] + half[k]
        if k % 2 == 1:
            above += [(right, 1.0), (right, 1 - depth[k]), (left, 1 - depth[k]), (left, 1.0)]
    above.append((0.0, 1.0))
    return subdivided(rng, [np.array(below + above)], vertices)


def spiral(seed, vertices):
    """A meshed band that winds three times, 1e-5 to 1e-1 wide, with a round head at its end."""
    rng = generator(seed)
    head = max(6, vertices // 10)
    count = (vertices - head) // 2
    t = np.linspace(0, 1, count)
    angle, radius = 3 * TURN * t, 0.4 + 1.2 * t
    thick = 1e-3 * 100 ** np.sin(TURN * (2 * t + rng.random()))  # 1e-5 to 1e-1
    inner = np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=1)
    outer = np.stack([(radius + thick) * np.cos(angle), (radius + thick) * np.sin(angle)], axis=1)
    # The head lies beyond the end, between the two arms' last vertices.
    extra = vertices - 2 * count
    turn = (np.arange(extra) + 1) / (extra + 1) * math.pi
    middle, half = (inner[-1] + outer[-1]) / 2, thick[-1] / 2
    cap = middle + half * np.stack([np.cos(turn), np.sin(turn)], axis=1)
    return [np.concatenate([outer, cap, inner[::-1]])]


def breakwaters(seed, vertices):
    """A basin with curved thin walls in it, 1e-2 to 1e-5 thick."""
    rng = generator(seed)
    count = max(3, min(60, vertices // 40))
    columns = math.ceil(math.sqrt(count))
    per_side = max(3, (vertices - 4) // (2 * count))
    rings = [np.array([(-0.2, -0.2), (columns + 0.2, -0.2), (columns + 0.2, columns + 0.2), (-0.2, columns + 0.2)])]
    for k in range(count):
        centre = np.array([k % columns + 0.5, k // columns + 0.5])
        radius, thick = 0.15 + 0.3 * rng.random(), 1e-5 * 1e3 ** rng.random()
        angle = TURN * rng.random() + np.linspace(0, (0.3 + 0.6 * rng.random()) * TURN, per_side)
        arm = np.stack([np.cos(angle), np.sin(angle)], axis=1)
        rings.append(centre + np.concatenate([(radius + thick) * arm, radius * arm[::-1]]))
    return subdivided(rng, rings, vertices)


def needles(seed, vertices):
    """A round body with needles of 2, 5 and 15 degrees, outward and as notches; sides subdivided."""
    rng = generator(seed)
    count = 12
    ring = []
    for k in range(count):
        middle = (k + 0.2 * rng.random()) * TURN / count
        degrees, outward = (2, 5, 15)[k % 3], (k // 3) % 2 == 0
        length = (0.3 + 0.5 * rng.random()) * (1 if outward else 0.8)
        half = math.atan(length * math.tan(math.radians(degrees / 2)))  # at radius 1, up to the bend of the circle
        tip = math.cos(half) + (length if outward else -length)
        along = np.array([math.cos(middle), math.sin(middle)])
        ring += [(math.cos(middle - half), math.sin(middle - half)), tuple(tip * along),
                 (math.cos(middle + half), math.sin(middle + half))]
    return subdivided(rng, [np.array(ring)], vertices)


def delta(seed, vertices):
    """Channels of a river delta: a meshed tree on a warped grid, 0.3 to 1e-4 of a cell wide, narrower with each
    fork."""
    rng = generator(seed)
    side = max(3, int(math.sqrt(vertices / 6)))
    tree, width, parent = {(0, 0): []}, {(0, 0): 0.3}, {(0, 0): None}
    stack = [(0, 0)]
    while stack:  # a random tree by depth first search
        at = stack[-1]
        free = [(at[0] + a, at[1] + b) for a, b in ((1, 0), (0, 1), (-1, 0), (0, -1))]
        free = [p for p in free if 0 <= p[0] < side and 0 <= p[1] < side and p not in parent]
        if not free:
            stack.pop()
            continue
        child = free[int(rng.random() * len(free))]
        tree[at].append(child)
        tree[child], parent[child] = [], at
        width[child] = max(1e-4, width[at] * (1 - 0.15 * rng.random()))
        stack.append(child)
    tour = tour_of(tree, parent, (0, 0))
    lines = np.cumsum(0.7 + 0.6 * rng.random((2, side)), axis=1)
    ring = []
    for before, at, after in zip(tour[-1:] + tour[:-1], tour, tour[1:] + tour[:1]):
        come, go = np.subtract(at, before), np.subtract(after, at)
        right_come, right_go = np.array([come[1], -come[0]]), np.array([go[1], -go[0]])
        w_come = width[at if parent[at] == before else before] / 2
        w_go = width[at if parent[at] == after else after] / 2
        node = np.array([lines[0, at[0]], lines[1, at[1]]])
        if (come == -go).all():
            ring += [node + w_come * (right_come + come), node + w_come * (right_go + come)]
        elif (come == go).all():
            ring += [node + w_come * right_come, node + w_go * right_go] if w_come != w_go else [node + w_go * right_go]
        else:
            ring.append(node + w_go * right_go + w_come * right_come)
    (x, y), wave = np.array(ring).T, TURN / 6
    warped = np.stack([x + 0.4 * np.sin(wave * y), y + 0.4 * np.sin(wave * x + 1)], axis=1)
    return subdivided(rng, [warped], vertices)  # after warping, so that both sides of a channel stay side by side


def tour_of(tree, parent, root):
    """The nodes in the order of a walk around the tree that has it on the left, children counter-clockwise."""
    def turn(at, child):
        """Angle of the way on, counter-clockwise from the way back: a walk with the tree on its left takes the
        least."""
        back = parent[at] or (at[0] - 1, at[1])
        way, base = np.subtract(child, at), np.subtract(back, at)
        return math.atan2(base[0] * way[1] - base[1] * way[0], base @ way) % TURN

    tour, stack = [], [(root, iter(sorted(tree[root], key=lambda c: turn(root, c))))]
    tour.append(root)
    while stack:
        at, children = stack[-1]
        child = next(children, None)
        if child is None:
            stack.pop()
            if stack:
                tour.append(stack[-1][0])
        else:
            tour.append(child)
            stack.append((child, iter(sorted(tree[child], key=lambda c: turn(child, c)))))
    return tour[:-1] if len(tour) > 1 else tour
