# SPDX-License-Identifier: BSD-3-Clause
"""Generates maps whose waters are joined by channels, or parted by dams, far narrower than their triangles.

A map is made of rough discs and thin bars, which the set operations of the program join. So it is known which waters
are connected, and which lands are islands. `topology_maps.py DIRECTORY` writes all of them.
"""
import math
import pathlib
import random
import sys


class Map:
    """The parts of a map, and what must stay connected or separate."""

    def __init__(self, seed):
        self.draw = random.Random(seed)
        self.parts = {}      # rings by name
        self.geometry = ""
        self.bodies = []     # (x, y, radius, number of the component)
        self.islands = []    # (x, y, radius)

    def disc(self, name, x, y, radius, vertices=60):
        ring = []
        for k in range(vertices):
            r = radius * (1 + 0.06 * self.draw.uniform(-1, 1))
            ring.append((x + r * math.cos(2 * math.pi * k / vertices), y + r * math.sin(2 * math.pi * k / vertices)))
        self.parts[name] = ring
        return name

    def water(self, name, x, y, radius, component=0):
        self.bodies.append((x, y, radius, component))
        return self.disc(name, x, y, radius)

    def island(self, name, x, y, radius, vertices=30):
        self.islands.append((x, y, radius))
        return self.disc(name, x, y, radius, vertices)

    def bar(self, name, start, end, width, steps=6):
        """A winding strip from one place to another."""
        (ax, ay), (bx, by) = start, end
        length = math.hypot(bx - ax, by - ay)
        nx, ny = (ay - by) / length, (bx - ax) / length
        middle = [(ax + (bx - ax) * k / steps, ay + (by - ay) * k / steps) for k in range(steps + 1)]
        bend = [0 if k in (0, steps) else 0.02 * length * self.draw.uniform(-1, 1) for k in range(steps + 1)]
        left = [(x + nx * (b + width / 2), y + ny * (b + width / 2)) for (x, y), b in zip(middle, bend)]
        right = [(x + nx * (b - width / 2), y + ny * (b - width / 2)) for (x, y), b in zip(middle, bend)]
        self.parts[name] = right + left[::-1]
        return name

    def rectangle(self, name, x0, y0, x1, y1):
        self.parts[name] = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]
        return name

    @property
    def vertices(self):
        return sum(len(ring) for ring in self.parts.values())

    def write(self, directory, name):
        lines = [f"[shape]\ngeometry = {self.geometry}\n"]
        for part, ring in self.parts.items():
            (directory / f"{part}.xy").write_text("".join(f"{x:.9g} {y:.9g}\n" for x, y in ring), "ascii")
            lines.append(f"[shape.{part}]\ntype = contour\nfile = {part}.xy\n")
        config = directory / f"{name}.ini"
        config.write_text("".join(lines), "ascii")
        return config


def union(*names):
    return f"union({', '.join(names)})" if len(names) > 1 else names[0]


def canal(m):
    m.geometry = union(m.water("a", 0, 0, 1), m.water("b", 3, 0.3, 0.9), m.bar("c", (0.8, 0), (2.3, 0.3), 0.004))


def lakes(m):
    names = [m.water(f"l{k}", 2.2 * k, 0.5 * (k % 2), 0.8 - 0.1 * k) for k in range(4)]
    names += [m.bar(f"r{k}", (2.2 * k + 0.4, 0.5 * (k % 2)), (2.2 * k + 1.9, 0.5 * ((k + 1) % 2)), 0.01)
              for k in range(3)]
    m.geometry = union(*names)


def two_ways(m):
    """Two basins and two channels: the land between these is an island."""
    m.geometry = union(m.water("a", 0, 0, 1), m.water("b", 4, 0, 1), m.bar("n", (0.3, 0.8), (3.7, 0.8), 0.01),
                       m.bar("s", (0.3, -0.8), (3.7, -0.8), 0.02))
    m.islands.append((2, 0, 0.7))


def river(m):
    m.geometry = union(m.water("sea", 0, 0, 2), m.water("lake", 4, 1, 0.5), m.bar("up", (1.5, 0), (3, 0.2), 0.006),
                       m.bar("on", (2.9, 0.18), (3.8, 1), 0.006))


def dam(m):
    """A thin dam across a lake: two waters."""
    m.geometry = f"difference({m.disc('lake', 0, 0, 1)}, {m.rectangle('dam', -0.003, -1.2, 0.003, 1.2)})"
    m.bodies = [(-0.5, 0, 0.42, 0), (0.5, 0, 0.42, 1)]


def lagoon(m):
    """A spit with an inlet lies before a lagoon."""
    m.geometry = (f"union(difference({m.rectangle('sea', 0, 0, 3, 2)}, {m.rectangle('spit', 0.4, 1.2, 4, 1.215)}, "
                  f"{m.rectangle('shore', -1, 1.2, 0.4, 1.25)}), {m.rectangle('inlet', 0.2, 1.1, 0.206, 1.3)})")
    m.bodies = [(1.5, 0.6, 0.55, 0), (1.5, 1.6, 0.35, 0)]


def strait(m):
    """An island close to the coast."""
    m.geometry = f"difference({m.disc('sea', 0, 0, 2, 90)}, {m.island('island', 1.2, 0, 0.6)})"
    m.bodies = [(-0.8, 0, 0.9, 0)]


def archipelago(m):
    names = [m.island(f"i{k}", 0.955 * math.cos(1.2566 * k), 0.955 * math.sin(1.2566 * k), 0.525) for k in range(5)]
    m.geometry = f"difference({m.disc('sea', 0, 0, 2, 90)}, {', '.join(names)})"
    m.bodies = [(0, 0, 0.38, 0), (-1.75, 0.2, 0.2, 0)]


def barrage(m):
    """A dam with a gap."""
    m.geometry = (f"difference({m.disc('lake', 0, 0, 1)}, {m.rectangle('south', -0.02, -1.2, 0.02, 0.1)}, "
                  f"{m.rectangle('north', -0.02, 0.108, 0.02, 1.2)})")
    m.bodies = [(-0.5, 0, 0.42, 0), (0.5, 0, 0.42, 0)]


def fjords(m):
    names = [m.water("sea", 0, 0, 1.5)]
    for k in range(5):
        c, s = math.cos(0.6 * k), math.sin(0.6 * k)
        names.append(m.bar(f"f{k}", (1.2 * c, 1.2 * s), (2.6 * c, 2.6 * s), 0.02))
    names.append(m.water("end", 3.1, 0, 0.6))
    m.geometry = union(*names)


def delta(m):
    names = [m.water("sea", 0, 0, 1.5), m.water("lake", 4, 0, 0.8)]
    names += [m.bar(f"d{k}", (1.2, 0.25 * k - 0.375), (3.5, 0.1 * k - 0.15), 0.008) for k in range(4)]
    m.geometry = union(*names)


def pools(m):
    """Pools that no triangle fits into lie on the way between two lakes."""
    names = [m.water("a", 0, 0, 1), m.water("b", 5, 0, 1), m.bar("way", (0.8, 0), (4.2, 0), 0.01)]
    names += [m.disc(f"p{k}", 1.5 + 0.65 * k, 0, 0.05, 12) for k in range(4)]
    m.geometry = union(*names)


MAKERS = (canal, lakes, two_ways, river, dam, lagoon, strait, archipelago, barrage, fjords, delta, pools)


def make_map(maker, seed=1):
    m = Map(seed)
    maker(m)
    return m


if __name__ == "__main__":
    for make in MAKERS:
        target = pathlib.Path(sys.argv[1]) / make.__name__
        target.mkdir(parents=True, exist_ok=True)
        make_map(make).write(target, make.__name__)
