# SPDX-License-Identifier: BSD-3-Clause
"""Makes random configs for random_runs.py: shapes of all kinds of parts, regions, curves, sizes, methods, periods,
fixed points, and sometimes a value that nobody would write.
"""
import math
import random

from random_insides import RandomInsides

EXTREME = ["0", "-1", "1", "3", "0.5", "1e-9", "1e-30", "1e-300", "1e9", "1e30", "1e300", "nan", "inf", "-1e15", "90"]
SIZES = ["1+3*{x}+3*{y}", "max(0.02,sqrt(({x}-0.5)^2+({y}-0.5)^2))", "0.1+{x}*{x}", "exp(-4*{x})", "{x}>0.5 ? 1 : 3",
         "1+0.9*sin(9*{x})*cos(7*{y})", "max(1e-6,abs({x}-{y}))", "1", "{x}-0.4", "1/(0.05+({x}-0.3)^2)",
         "abs(sin(50*{x}))+1e-7"]
PERIODIC_SIZES = ["2+sin(2*pi*{x})", "1+0.8*sin(2*pi*{x})*sin(2*pi*{y})", "1.1+cos(4*pi*({x}+{y}))", "1+{x}"]
CURVES = ["sqrt(({x}-{a})^2+({y}-{b})^2)-{r}", "max(abs({x}-{a}),abs({y}-{b}))-{r}",
          "abs(sqrt(({x}-{a})^2+({y}-{b})^2)-{r})-{r}/3",
          "sqrt(({x}-{a})^2+({y}-{b})^2)-{r}*(1+0.3*cos(5*atan2({y}-{b},{x}-{a})))",
          "min(sqrt(({x}-{a})^2+({y}-{b})^2),abs({x}-{b})+abs({y}-{a}))-{r}", "sin(2*pi*{x})*sin(2*pi*{y})-{a}",
          "({x}-{a})*({y}-{b})-{r}/4", "sin(60*{x})*sin(60*{y})-{a}", "sin(1/({x}-{a}+1e-9))*{r}-({y}-{b})^2"]
FORMATS = ["vtkhdf", "xdmf", "text", "gmsh", "gmsh2", "medit", "freefem", "triangle", "vtu", "2dm", "fort14", "gr3",
           "slf", "su2", "geojson", "abaqus", "exodus"]


class RandomConfig:
    """One config: `text`, and `files` by name. Lengths are those of a container [0, 1] x [0, 1], which is moved and
    scaled at the end."""

    def __init__(self, rng):
        self.rng, self.files, self.parts = rng, {}, []
        self.scale = 1.0 if rng.random() < 0.6 else 10 ** rng.uniform(-4, 4)
        self.shift = (0.0, 0.0)
        if rng.random() < 0.4:
            self.shift = (rng.uniform(-5, 5) * self.scale, rng.uniform(-5, 5) * self.scale)
        self.periodic = [rng.random() < 0.2 for _ in range(2)]
        self.vertices = []
        shape = self.shape()
        # Their own random numbers, so that the rest of a config does not depend on them.
        insides = RandomInsides(random.Random(repr(rng.getstate())), self.place, self.scale)
        self.files |= insides.files
        sections = [("shape", shape | insides.rest)] + self.parts + insides.sections + [
            ("domain", self.domain()), ("sizing", self.sizing()), ("meshing", self.meshing()),
            ("parallel", {"mesh_threads": rng.choice([1, 2, 7, 4096])} if rng.random() < 0.1 else {}),
            ("output", self.output())]
        if rng.random() < 0.12:
            self.spoil(sections)
        self.text = "".join(f"[{name}]\n" + "".join(f"{key} = {value}\n" for key, value in values.items())
                            for name, values in sections if values)

    def place(self, x, y):
        return self.shift[0] + self.scale * x, self.shift[1] + self.scale * y

    def pair(self, x, y):
        return "{!r} {!r}".format(*self.place(x, y))

    def formula(self, text, **more):
        """With x and y of the unit square in place of those of the container."""
        x, y = (f"((({name})-({shift!r}))/{self.scale!r})" if (shift, self.scale) != (0.0, 1.0) else name
                for name, shift in zip("xy", self.shift))
        return text.format(x=x, y=y, **more)

    def domain(self):
        rng = self.rng
        values = {}
        if (self.shift, self.scale) != ((0.0, 0.0), 1.0) and (rng.random() < 0.6 or any(self.periodic)):
            low, high = self.place(0, 0), self.place(1, 1)
            values = {"x_min": repr(low[0]), "x_max": repr(high[0]), "y_min": repr(low[1]), "y_max": repr(high[1])}
        values |= {f"periodic_{axis}": "true" for axis, is_on in zip("xy", self.periodic) if is_on}
        if rng.random() < 0.1:
            values |= {"cells_x": rng.choice([1, 3, 40, 10**6]), "cells_y": rng.choice([1, 7, 40, 10**6])}
        return values

    def shape(self):
        names = []
        for k in range(self.rng.choice([1, 1, 2, 2, 3, 4])):
            names.append(f"p{k}")
            kind = self.rng.choice(["rectangle", "circle", "triangle", "contour", "contour", "expression"])
            self.parts.append((f"shape.p{k}", {"type": kind} | getattr(self, kind)(f"p{k}")))
        return {"geometry": self.geometry(names)}

    def geometry(self, names):
        """The first part holds most of what there is."""
        rng, text = self.rng, names[0]
        if any(self.periodic) and rng.random() < 0.5:
            text = f"difference(domain, {text})"
        for name in names[1:]:
            text = f"{rng.choice(['union', 'difference', 'difference', 'intersection'])}({text}, {name})"
        return text

    def middle(self):
        return self.rng.uniform(0.3, 0.7), self.rng.uniform(0.3, 0.7)

    def rectangle(self, _):
        (x, y), w, h = self.middle(), self.rng.uniform(0.01, 0.3), self.rng.uniform(0.01, 0.3)
        low, high = self.place(x - w, y - h), self.place(x + w, y + h)
        return {"x_min": repr(low[0]), "x_max": repr(high[0]), "y_min": repr(low[1]), "y_max": repr(high[1])}

    def circle(self, _):
        return {"center": self.pair(*self.middle()), "radius": repr(self.scale * 10 ** self.rng.uniform(-2, -0.53))}

    def triangle(self, _):
        return {f"p{k}": self.pair(self.rng.uniform(0.02, 0.98), self.rng.uniform(0.02, 0.98)) for k in range(3)}

    def expression(self, _):
        a, b = self.middle()
        return {"sdf": self.formula(self.rng.choice(CURVES), a=round(a, 3), b=round(b, 3),
                                    r=round(self.rng.uniform(0.05, 0.29), 3))}

    def ring(self, x, y, radius):
        """Star-shaped around (x, y), rough, in either orientation."""
        rng, n = self.rng, self.rng.choice([3, 4, 5, 8, 20, 60, 150])
        rough = rng.choice([0.02, 0.3, 0.7, 0.95])
        angles = sorted(rng.uniform(0, 2 * math.pi) for _ in range(n)) if rng.random() < 0.3 else \
            [2 * math.pi * k / n for k in range(n)]
        ring = [(x + r * math.cos(a), y + r * math.sin(a)) for a in angles
                for r in [radius * (1 - rough * rng.random())]]
        return ring if rng.random() < 0.5 else ring[::-1]

    def contour(self, name):
        rng = self.rng
        x, y = self.middle()
        radius = rng.uniform(0.1, 0.3)
        rings = [self.ring(x, y, radius)]
        for _ in range(rng.choice([0, 0, 0, 1, 4])):  # lakes and islands
            angle, far = rng.uniform(0, 2 * math.pi), radius * rng.uniform(0, 1.2)
            rings.append(self.ring(x + far * math.cos(angle), y + far * math.sin(angle),
                                   radius * rng.uniform(0.003, 0.25)))
        if rng.random() < 0.1:  # touching in a vertex
            rings.append([rings[0][0]] + self.ring(*rings[0][0], radius / 10)[1:])
        digits = rng.choice([4, 17, 17, 17])
        places = [[self.place(*p) for p in ring] for ring in rings]
        self.vertices += [p for ring in places for p in ring]
        self.files[f"{name}.xy"] = "\n".join("".join(f"{px:.{digits}g} {py:.{digits}g}\n" for px, py in ring)
                                             for ring in places)
        return {"file": f"{name}.xy"} | ({"normalize": "true"} if rng.random() < 0.2 else {})

    def sizing(self):
        rng = self.rng
        kind = rng.choice(["uniform", "automatic", "automatic", "expression"])
        values = {"type": kind}
        if kind == "automatic":
            values["gradation"] = rng.choice([0, 0.02, 0.1, 0.2, 0.3, 0.5, 1, 2])
        elif kind == "expression":
            values["expression"] = self.formula(rng.choice(PERIODIC_SIZES if any(self.periodic) else SIZES))
        if rng.random() < 0.1:
            values["min_size"] = repr(self.scale * 10 ** rng.uniform(-3, -1.3))
        if rng.random() < 0.1:
            values["max_size"] = repr(self.scale * 10 ** rng.uniform(-1.5, -0.5))
        return values

    def meshing(self):
        rng = self.rng
        values = {"method": rng.choice(["hybrid", "hybrid", "distmesh", "cvd"])}
        if rng.random() < 0.8:
            values["points"] = round(10 ** rng.uniform(0.7, 3.48))
        else:
            values["edge_length"] = repr(self.scale * 10 ** rng.uniform(-1.7, -0.4))
        choices = {"initial_fraction": [0.05, 0.2, 0.7, 1], "corner_angle": [1, 20, 60, 180], "keep_features": ["true"],
                   "simplify_within": [0, 0.1, 0.25, 1], "narrow": ["close"], "refine_narrow": ["false"],
                   "connect": ["cut"], "components": ["largest"], "max_loss": [0.5],
                   "feature_tolerance": [0, 0.02, 0.3], "seed": [0, 7, 2**53], "max_sweeps": [0, 1, 7, 40],
                   "stop_tolerance": [1e-3, 0.3], "cleanup": ["false"], "worst_alpha": [1.05, 1000]}
        values |= {key: rng.choice(some) for key, some in choices.items() if rng.random() < 0.12}
        if rng.random() < 0.12:
            self.fix_points(values)
        return values

    def output(self):
        rng, values = self.rng, {}
        if rng.random() < 0.15:
            values["formats"] = " ".join(rng.sample(FORMATS, rng.randint(1, 4)))
        if rng.random() < 0.1:
            values["interval"] = rng.choice([-2, 0, 7])
        return values

    def fix_points(self, values):
        """Some may lie outside, on the boundary, or on each other."""
        rng = self.rng
        places = [self.place(*self.middle()) for _ in range(rng.choice([1, 2, 10, 60]))]
        if self.vertices and rng.random() < 0.5:
            places = [rng.choice(self.vertices) for _ in places]
        if rng.random() < 0.2:
            places += places[:1]
        self.files["points.xy"] = "".join(f"{x!r} {y!r}\n" for x, y in places)
        values["fixed_points"] = "points.xy"

    def spoil(self, sections):
        """One number becomes another one; what decides how large the mesh is stays."""
        stay = ("points", "edge_length", "type", "geometry", "file", "fixed_points", "method", "sdf", "expression",
                "narrow")
        numbers = [(values, key) for _, values in sections for key in values if key not in stay]
        if numbers:
            values, key = self.rng.choice(numbers)
            words = str(values[key]).split()
            words[self.rng.randrange(len(words))] = self.rng.choice(EXTREME)
            values[key] = " ".join(words)
