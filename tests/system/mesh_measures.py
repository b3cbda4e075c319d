# SPDX-License-Identifier: BSD-3-Clause
"""Measures of a triangle mesh and of the curve that it should follow: quality, sharp corners, deviation, loops.

All data are arrays: points (n, 2), triangles (m, 3) counter-clockwise, local sizes (n), and rings of the curve.
"""
import numpy as np
from scipy.spatial import cKDTree

from ring_tools import segments_of

SHARP = 56.0  # [degrees] inside angle of a boundary vertex below which bad triangles next to it are forced
EDGES_AWAY = 3.0  # [local edges] how far from such a vertex a triangle is still at it
NARROW = 1.2  # [local size] two arms that meet are nearer than this up to NARROW h / sin(angle)
SLACK = 2.0  # [degrees] by which the middle of a triangle may miss its wedge, whose arms may bend
SAMPLES = 9  # points along a facet, ends included
SAME = 1e-9  # [longer side of the curve's box] two vertices are one
GOOD, BAD = 1.2, 1.5  # alpha


def qualities(corners):
    """Alpha and the smallest angle [degrees] of triangles (m, 3, 2)."""
    a, b, c = (np.hypot(*(corners[:, (k + 1) % 3] - corners[:, (k + 2) % 3]).T) for k in range(3))
    twice_area = np.abs(cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]))
    shortest, middle, longest = np.sort(np.stack([a, b, c]), axis=0)
    with np.errstate(divide="ignore"):
        # R/2r with R = abc/(4 area) and r = 2 area/(a+b+c): no difference of nearly equal lengths.
        alpha = a * b * c * (a + b + c) / (4 * twice_area**2)
    return alpha, np.degrees(np.arcsin(np.clip(twice_area / (middle * longest), 0, 1)))


def cross(p, q):
    return p[..., 0] * q[..., 1] - p[..., 1] * q[..., 0]


def distance_to_segments(points, starts, ends):
    """Of each point from its own segment; all arrays (n, 2)."""
    span = ends - starts
    square = np.maximum((span**2).sum(axis=-1), 1e-300)
    share = np.clip(((points - starts) * span).sum(axis=-1) / square, 0, 1)
    return np.hypot(*np.moveaxis(points - starts - share[..., None] * span, -1, 0))


class Curve:
    """Exact distances from many segments: a k-d tree of the middles of pieces of them, all of nearly one length."""

    def __init__(self, starts, ends):
        length = np.hypot(*(ends - starts).T)
        self.piece = max(float(length.sum()) / (4 * len(length)), 1e-300)
        counts = np.maximum(1, np.ceil(length / self.piece)).astype(np.int64)
        self.owner = np.repeat(np.arange(len(starts)), counts)
        place = np.arange(len(self.owner)) - np.repeat(np.cumsum(counts) - counts, counts)
        share = (place + 0.5) / counts[self.owner]
        self.starts, self.ends = starts, ends
        self.tree = cKDTree(starts[self.owner] + share[:, None] * (ends - starts)[self.owner])

    def distance(self, points):
        """Distance and the number of the nearest segment, for points (n, 2)."""
        best, which = np.full(len(points), np.inf), np.zeros(len(points), np.int64)
        left, neighbours = np.arange(len(points)), 4
        while len(left) > 0:
            neighbours = min(neighbours, len(self.owner))
            away, near = self.tree.query(points[left], k=neighbours)
            away, near = away.reshape(len(left), -1), near.reshape(len(left), -1)
            owner = self.owner[near]
            exact = distance_to_segments(points[left][:, None], self.starts[owner], self.ends[owner])
            first = exact.argmin(axis=1)
            rows = np.arange(len(left))
            best[left], which[left] = exact[rows, first], owner[rows, first]
            # A piece whose middle is farther away than this cannot be nearer than the best.
            open_ = away[:, -1] <= best[left] + 0.5 * self.piece
            left = left[open_] if neighbours < len(self.owner) else left[:0]
            neighbours *= 4
        return best, which


class MeshMeasures:
    """All measures of a mesh, from its arrays and the rings of its input."""

    def __init__(self, points, triangles, size, rings):
        self.points, self.size, self.rings = points, size.astype(float), rings
        self.triangles = triangles.astype(np.int64)  # products of ids need 64 bits, and the file has 32
        self.corners = points[triangles]
        self.alpha, self.angle = qualities(self.corners)
        self.area = float(0.5 * cross(self.corners[:, 1] - self.corners[:, 0],
                                      self.corners[:, 2] - self.corners[:, 0]).sum())
        self.facets = self.rim()
        self.asked = None  # per facet, see set_asked_sizes

    def rim(self):
        """Directed edges (b, 2) of one triangle only; the mesh lies on their left."""
        edges = np.concatenate([self.triangles[:, [k, (k + 1) % 3]] for k in range(3)])
        keys = edges[:, 0] * len(self.points) + edges[:, 1]
        back = edges[:, 1] * len(self.points) + edges[:, 0]
        return edges[~np.isin(keys, back)]

    def wedges(self):
        """(vertex, next boundary vertex, the one before, inside angle [degrees]), one for each fan at a boundary
        vertex."""
        coming = {}
        for a, b in self.facets.tolist():
            coming.setdefault(b, []).append(a)
        for vertex, after in self.facets.tolist():
            out = self.points[after] - self.points[vertex]
            found = []
            for before in coming[vertex]:
                back = self.points[before] - self.points[vertex]
                turn = np.degrees(np.arctan2(cross(out, back), (out * back).sum())) % 360
                found.append((turn, before))
            turn, before = min(found)
            yield vertex, after, before, turn

    def loops(self):
        """How many closed loops the boundary has; at a vertex of several fans each loop keeps to its fan."""
        following = {(before, vertex): (vertex, after) for vertex, after, before, _ in self.wedges()}
        count = 0
        while following:
            count += 1
            _, at = following.popitem()
            while at in following:
                at = following.pop(at)
        return count

    def at_sharp_corners(self, counts):
        """True for triangles in the wedge of a sharp boundary vertex; counts: which vertices (n) may be such."""
        marked = np.zeros(len(self.triangles), bool)
        by_vertex, neighbours, middles = {}, {}, self.corners.mean(axis=1)
        sharp = [wedge for wedge in self.wedges() if wedge[3] < SHARP and counts[wedge[0]]]
        if not sharp:
            return marked
        for number, triangle in enumerate(self.triangles.tolist()):
            for k in range(3):
                by_vertex.setdefault(triangle[k], []).append(number)
                edge = triangle[k], triangle[(k + 1) % 3]
                neighbours.setdefault((min(edge), max(edge)), []).append(number)
        for vertex, after, before, turn in sharp:
            origin = self.points[vertex]
            out, back = self.points[after] - origin, self.points[before] - origin
            edge = 0.5 * (np.hypot(*out) + np.hypot(*back))
            reach = max(EDGES_AWAY * edge, NARROW * self.size[vertex] / np.sin(np.radians(turn)))

            def lies_in(number):
                way = middles[number] - origin
                bearing = np.degrees(np.arctan2(cross(out, way), (out * way).sum()))
                return -SLACK <= bearing <= turn + SLACK and np.hypot(*way) <= reach

            front = [number for number in by_vertex[vertex] if lies_in(number)]
            seen = set(front)
            while front:  # from triangle to triangle, so that nothing on the other side of a wall is reached
                triangle = self.triangles[front.pop()].tolist()
                for k in range(3):
                    edge_key = triangle[k], triangle[(k + 1) % 3]
                    for number in neighbours[min(edge_key), max(edge_key)]:
                        if number not in seen and lies_in(number):
                            seen.add(number)
                            front.append(number)
            marked[list(seen)] = True
        return marked

    def set_asked_sizes(self, facets, sizes):
        """The size asked for at each of these facets, which are all, in any order."""
        n = len(self.points)
        keys, given = (f[:, 0] * n + f[:, 1] for f in (self.facets, np.asarray(facets)))
        order = np.argsort(given)
        found = order[np.minimum(np.searchsorted(given[order], keys), len(order) - 1)]
        if not np.array_equal(given[found], keys):
            raise ValueError("the facets of the table are not the boundary edges of the triangles")
        self.asked = np.asarray(sizes, float)[found]

    def is_input_vertex(self):
        """Returns True for the points that are vertices of the rings."""
        vertices = np.concatenate(self.rings)
        away, _ = cKDTree(vertices).query(self.points)
        return away <= SAME * np.ptp(vertices, axis=0).max()

    def deviation(self):
        """Largest distance of the facets from the curve over the size, and its place: the size that was asked for at
        the middle of the facet if that is known, else the local one."""
        share = np.linspace(0, 1, SAMPLES)[None, :, None]
        start, end = (self.points[self.facets[:, k]][:, None] for k in (0, 1))
        places = (start + share * (end - start)).reshape(-1, 2)
        size = (1 - share[..., 0]) * self.size[self.facets[:, :1]] + share[..., 0] * self.size[self.facets[:, 1:]]
        if self.asked is not None:
            size = np.broadcast_to(self.asked[:, None], size.shape)
        away = Curve(*segments_of(self.rings)).distance(places)[0] / size.ravel()
        worst = int(away.argmax())
        return float(away[worst]), places[worst]

    def lost(self):
        """Returns the largest distance from the curve (its vertices and points between them) to the facets, over the
        size of the facets, and the place of it."""
        starts, ends = segments_of(self.rings)
        count = np.maximum(1, np.ceil(np.hypot(*(ends - starts).T) / (0.25 * self.size.min()))).astype(int)
        count = np.minimum(count, 64)
        owner = np.repeat(np.arange(len(starts)), count)
        share = (np.arange(len(owner)) - np.repeat(np.cumsum(count) - count, count)) / count[owner]
        places = starts[owner] + share[:, None] * (ends - starts)[owner]
        away, which = Curve(*(self.points[self.facets[:, k]] for k in (0, 1))).distance(places)
        away /= 0.5 * self.size[self.facets[which]].sum(axis=1)
        worst = int(away.argmax())
        return float(away[worst]), places[worst]

    def columns(self):
        """What judge.py shows; places as [x, y]."""
        free = ~self.at_sharp_corners(np.ones(len(self.points), bool))
        kept = ~self.at_sharp_corners(self.is_input_vertex())
        deviation, deviation_at = self.deviation()
        lost, lost_at = self.lost()
        row = {"points": len(self.points), "triangles": len(self.triangles), "mean": float(self.alpha.mean()),
               "max": float(self.alpha.max()), "max_at": self.place(self.alpha.argmax()),
               "good": 100 * float((self.alpha <= GOOD).mean()), "angle": float(self.angle.min()),
               "bad": int((self.alpha[free] > BAD).sum()), "deviation": deviation,
               "deviation_at": deviation_at.tolist(),
               "lost": lost, "lost_at": lost_at.tolist(), "loops": self.loops(), "forced": int((~free).sum())}
        for name, chosen in (("free", free), ("kept", kept)):
            row[name] = float(self.alpha[chosen].max(initial=1.0))
            row[f"{name}_mean"] = float(self.alpha[chosen].mean()) if chosen.any() else 1.0
            row[f"{name}_good"] = 100 * float((self.alpha[chosen] <= GOOD).mean()) if chosen.any() else 100.0
            row[f"{name}_angle"] = float(self.angle[chosen].min(initial=60.0))
        worst = np.flatnonzero(free)[self.alpha[free].argmax()] if free.any() else self.alpha.argmax()
        return {**row, "at": self.place(worst)}

    def place(self, number):
        """Middle of a triangle."""
        return self.corners[number].mean(axis=0).tolist()
