# SPDX-License-Identifier: BSD-3-Clause
"""Makes the regions and curves of random configs, for random_shapes.py."""
import math


class RandomInsides:
    """The sections of regions and curves of one config, in `sections`, and their files by name in `files`. `place`
    moves a place of the unit square into the container."""

    def __init__(self, rng, place, scale):
        self.rng, self.place, self.scale = rng, place, scale
        self.sections, self.files, self.rest = [], {}, {}
        self.nodes = []  # places that later lines may share
        for k in range(rng.choice([0, 0, 1, 2, 3])):
            self.region(f"r{k}")
        for k in range(rng.choice([0, 0, 1, 1, 2])):
            self.curve(f"c{k}")
        if self.sections and rng.random() < 0.3:
            self.rest["rest"] = "matrix"

    def part(self, name):
        """A separate part for a region, which may reach beyond the shape."""
        rng = self.rng
        kind = rng.choice(["circle", "rectangle", "triangle", "layer"])
        low, high = self.place(rng.uniform(-0.1, 0.6), rng.uniform(-0.1, 0.6)), self.place(1, 1)
        if kind == "circle":
            return {"type": kind, "center": self.pair(rng.random(), rng.random()),
                    "radius": repr(self.scale * 10 ** rng.uniform(-2, -0.3))}
        if kind == "triangle":
            corners = [(rng.random(), rng.random()) for _ in range(3)]
            self.nodes += corners
            return {"type": kind} | {f"p{k}": self.pair(*corner) for k, corner in enumerate(corners)}
        if kind == "layer":
            thick = 10 ** rng.uniform(-2.5, -0.5)
            middle = rng.uniform(0.2, 0.8)
            low, high = self.place(-0.1, middle - thick / 2), self.place(1.1, middle + thick / 2)
        return {"type": "rectangle", "x_min": repr(low[0]), "x_max": repr(high[0]), "y_min": repr(low[1]),
                "y_max": repr(high[1])}

    def pair(self, x, y):
        return "{!r} {!r}".format(*self.place(x, y))

    def region(self, name):
        rng = self.rng
        self.sections.append((f"shape.{name}_part", self.part(name)))
        values = {"geometry": f"{name}_part"}
        if len(self.sections) > 2 and rng.random() < 0.3:
            values["geometry"] = f"difference({name}_part, r0_part)"
        if rng.random() < 0.2:
            values["size"] = repr(rng.choice([0.3, 0.5, 0.7, 1]))
        self.sections.append((f"region.{name}", values))

    def line(self):
        """An open or closed line. It may begin or end at, or near to, a node of another one."""
        rng = self.rng
        n = rng.choice([2, 2, 3, 5, 20, 60])
        x, y, angle = rng.random(), rng.random(), rng.uniform(0, 2 * math.pi)
        step, bend = 10 ** rng.uniform(-2, -0.5), rng.choice([0, 0.1, 0.5, 2])
        places = []
        for _ in range(n):
            places.append((x, y))
            x, y = x + step * math.cos(angle), y + step * math.sin(angle)
            angle += rng.uniform(-bend, bend)
        if self.nodes and rng.random() < 0.4:
            near = rng.choice(self.nodes)
            off = rng.choice([0, 0, 1e-9, 1e-4, 1e-3, 1e-2])
            places[0] = (near[0] + off * rng.uniform(-1, 1), near[1] + off * rng.uniform(-1, 1))
        if n > 2 and rng.random() < 0.2:
            places.append(places[0])
        self.nodes += [places[0], places[len(places) // 2], places[-1]]
        return places

    def curve(self, name):
        rng = self.rng
        lines = [self.line() for _ in range(rng.choice([1, 1, 2, 5, 20]))]
        self.files[f"{name}.xy"] = "\n".join("".join(f"{self.pair(*p)}\n" for p in line) for line in lines)
        values = {"file": f"{name}.xy"}
        if rng.random() < 0.85:
            values["clip"] = "true"
        if rng.random() < 0.2:
            values["split"] = "true"
        self.sections.append((f"curve.{name}", values))
