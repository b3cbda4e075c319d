# SPDX-License-Identifier: BSD-3-Clause
"""Computes the exact curves of a config's parts from the config alone: distance, corners, the area between a chord and
its curve.
"""
import configparser
import itertools
import math

import numpy as np


def cross(a, b):
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


class Circle:
    def __init__(self, center, radius, periods):
        self.center, self.radius, self.periods = np.array(center), radius, periods
        self.corners = np.empty((0, 2))

    def from_center(self, points):
        """Vectors from the centre to the nearest images of the points."""
        v = points - self.center
        return v - np.where(np.isfinite(self.periods), self.periods, 0) * np.round(v / self.periods)

    def distance(self, points):
        return np.abs(np.hypot(*self.from_center(points).T) - self.radius)

    def inside(self, point):
        return math.hypot(*(point - self.center)) < self.radius

    def between(self, p, q):
        """Signed area between the curve and the chord p -> q, positive where the curve is on its right."""
        a, b = self.from_center(p), self.from_center(q)
        turn = math.atan2(cross(a, b), a @ b)
        return 0.5 * self.radius ** 2 * (turn - math.sin(turn))

    def loop_area(self, _):
        return math.pi * self.radius ** 2


class Polygon:
    """Closed rings of straight sides."""

    def __init__(self, rings):
        self.rings = [np.array(ring) for ring in rings]
        self.starts = np.concatenate(self.rings)
        self.ends = np.concatenate([np.roll(ring, -1, axis=0) for ring in self.rings])
        self.ring_of = np.repeat(np.arange(len(self.rings)), [len(ring) for ring in self.rings])
        self.corners = self.starts
        self.found = {}

    def nearest(self, point):
        """Side, distance, and length from the side's start, of the nearest point."""
        key = tuple(point)
        if key not in self.found:
            self.found[key] = self.search(point)
        return self.found[key]

    def search(self, point):
        d = self.ends - self.starts
        length = np.hypot(*d.T)
        along = np.clip(((point - self.starts) * d).sum(axis=1) / length ** 2, 0, 1)
        distance = np.hypot(*(self.starts + along[:, None] * d - point).T)
        side = int(distance.argmin())
        return side, distance[side], along[side] * length[side]

    def distance(self, points):
        return np.array([self.nearest(point)[1] for point in points])

    def inside(self, point):
        a, b = self.starts, self.ends
        crosses = (a[:, 1] > point[1]) != (b[:, 1] > point[1])
        with np.errstate(divide="ignore", invalid="ignore"):
            x = a[:, 0] + (point[1] - a[:, 1]) * (b[:, 0] - a[:, 0]) / (b[:, 1] - a[:, 1])
        return np.count_nonzero(crosses & (point[0] < x)) % 2 == 1

    def ring_place(self, point):
        """Ring, and length along it from its first vertex."""
        side, _, along = self.nearest(point)
        ring = self.ring_of[side]
        mine = np.flatnonzero(self.ring_of == ring)
        lengths = np.hypot(*(self.ends[mine] - self.starts[mine]).T)
        return ring, lengths[:side - mine[0]].sum() + along, np.cumsum(lengths)

    def between(self, p, q):
        """As for circles; the curve is the shorter way from p to q."""
        ring, from_p, ends = self.ring_place(p)
        ring_q, from_q, _ = self.ring_place(q)
        if ring != ring_q:
            raise AssertionError(f"edge from {p} to {q} leads from ring to ring")
        total, vertices, reverse = ends[-1], np.roll(self.rings[ring], -1, axis=0), False
        if (from_q - from_p) % total > total / 2:
            from_p, from_q, reverse = from_q, from_p, True
        way = (from_q - from_p) % total
        after = (ends - from_p) % total
        order = [k for k in np.argsort(after, kind="stable") if after[k] < way]
        path = np.concatenate([[q if reverse else p], vertices[order], [p if reverse else q]]) - p
        return 0.5 * cross(path, np.roll(path, -1, axis=0)).sum() * (-1 if reverse else 1)

    def loop_area(self, point):
        """Area inside the ring on which the point lies."""
        ring = self.rings[self.ring_of[self.nearest(point)[0]]]
        v = ring - ring[0]
        return abs(0.5 * cross(v, np.roll(v, -1, axis=0)).sum())

    def turns(self):
        """Degrees by which the curve turns at each vertex, and the length of the shorter side there."""
        out = self.ends - self.starts
        into = np.concatenate([np.roll(out[self.ring_of == k], 1, axis=0) for k in range(len(self.rings))])
        angle = np.degrees(np.abs(np.arctan2(cross(into, out), (into * out).sum(axis=1))))
        return angle, np.minimum(np.hypot(*into.T), np.hypot(*out.T))


class Formula:
    """Zero line of a function."""

    def __init__(self, text):
        self.code = compile(text.replace("^", "**"), "sdf", "eval")
        self.corners = np.empty((0, 2))

    def distance(self, points):
        """Size of the function: the distance, or about that."""
        names = {"abs": np.abs, "sqrt": np.sqrt, "cos": np.cos, "sin": np.sin, "atan2": np.arctan2, "min": np.minimum,
                 "max": np.maximum, "x": points[:, 0], "y": points[:, 1]}
        return np.abs(eval(self.code, {"__builtins__": {}}, names))  # of a config of this source tree

    def inside(self, _):
        raise NotImplementedError


def read_rings(path):
    rings, ring = [], []
    for line in path.read_text(encoding="utf-8").splitlines() + [""]:
        fields = line.split("#")[0].split()
        if fields:
            ring.append([float(field) for field in fields])
        elif ring and not line.strip():
            rings.append(ring[:-1] if ring[0] == ring[-1] else ring)
            ring = []
    return rings


class Config:
    """Parts and container of a config file."""

    def __init__(self, path):
        self.ini = configparser.ConfigParser(inline_comment_prefixes=";", interpolation=None)
        self.ini.read_string(path.read_text(encoding="utf-8"))
        self.folder = path.parent
        domain = self.ini["domain"] if "domain" in self.ini else {}
        self.low = np.array([float(domain.get(f"{axis}_min", 0)) for axis in "xy"])
        self.high = np.array([float(domain.get(f"{axis}_max", 1)) for axis in "xy"])
        self.periods = np.where([domain.get(f"periodic_{axis}", "false") == "true" for axis in "xy"],
                                self.high - self.low, np.inf)
        self.side = (self.high - self.low).max()
        self.region = self.ini["shape"]["geometry"]
        self.parts = {name.removeprefix("shape."): self.part(section) for name, section in self.ini.items()
                      if name.startswith("shape.")}

    def part(self, section):
        numbers = {key: np.array(value.split(), float) for key, value in section.items()
                   if key in ("center", "p0", "p1", "p2")}
        if section["type"] == "circle":
            return Circle(numbers["center"], section.getfloat("radius"), self.periods)
        if section["type"] == "triangle":
            return Polygon([[numbers[key] for key in ("p0", "p1", "p2")]])
        if section["type"] == "rectangle":
            x0, x1, y0, y1 = (section.getfloat(key) for key in ("x_min", "x_max", "y_min", "y_max"))
            return Polygon([[(x0, y0), (x1, y0), (x1, y1), (x0, y1)]])
        if section["type"] == "expression":
            return Formula(section["sdf"])
        rings = [np.array(ring) for ring in read_rings(self.folder / section["file"])]
        return Polygon([self.normalised(ring, rings) for ring in rings] if section.getboolean("normalize") else rings)

    def normalised(self, points, rings):
        """Points as the contour's rings are normalised."""
        every = np.concatenate(rings)
        low, high = every.min(axis=0), every.max(axis=0)
        scale = 0.8 * (self.high - self.low).min() / (high - low).max()
        return 0.5 * (self.low + self.high) + scale * (np.asarray(points) - 0.5 * (low + high))

    def fixed_points(self):
        meshing = self.ini["meshing"]
        if "fixed_points" not in meshing:
            return np.empty((0, 2))
        points = np.concatenate([np.array(ring) for ring in read_rings(self.folder / meshing["fixed_points"])])
        contour = meshing.get("fixed_points_normalize_with")
        rings = read_rings(self.folder / self.ini[f"shape.{contour}"]["file"]) if contour else None
        return self.normalised(points, [np.array(ring) for ring in rings]) if contour else points

    def crossings(self):
        """Points where two circles cross and the region depends on both."""
        circles = [(name, part) for name, part in self.parts.items() if isinstance(part, Circle)]
        for (name_a, a), (name_b, b) in itertools.combinations(circles, 2):
            d = b.center - a.center
            length = math.hypot(*d)
            if not abs(a.radius - b.radius) < length < a.radius + b.radius:
                continue
            along = (length ** 2 + a.radius ** 2 - b.radius ** 2) / (2 * length)
            across = math.sqrt(a.radius ** 2 - along ** 2)
            for sign in (1, -1):
                point = a.center + (along * d + sign * across * np.array([-d[1], d[0]])) / length
                if self.depends_on_both(point, name_a, name_b):
                    yield point

    def depends_on_both(self, point, a, b):
        flags = {name: part.inside(point) for name, part in self.parts.items() if name not in (a, b)}
        operations = {"__builtins__": {}, "union": lambda *s: any(s), "intersection": lambda *s: all(s),
                      "difference": lambda first, *s: first and not any(s)}
        value = {(i, j): eval(self.region, operations, {**flags, a: i, b: j}) for i in (0, 1) for j in (0, 1)}
        return any(value[0, j] != value[1, j] for j in (0, 1)) and any(value[i, 0] != value[i, 1] for i in (0, 1))

    def lattice_step(self):
        """Spacing of the lattice on which all coordinates lie, see geometry::Lattice."""
        extent = max(np.abs(self.low).max(), np.abs(self.high).max())
        return 2.0 ** math.frexp(max(self.side * 2.0 ** -44, extent * 2.0 ** -51))[1]
