#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes a map of districts that tile a country, as offices and statisticians publish them: ragged common borders, a
ragged coast, and coordinates rounded to 7 digits.

Usage: tiled_country.py SEED DISTRICTS [APART]      prints GeoJSON

The districts are cells of a Voronoi diagram around random places. Each border is displaced at its middle, again and
again, and stays within the two triangles between the border and the places of its cells, so no two borders cross.
Without APART, neighbours have exactly the same vertices along their border. With APART, which is a number of degrees,
they have different vertices, as if each district were digitised alone: gaps and overlaps of about this width.
"""
import cmath
import json
import math
import random
import sys

import numpy
import scipy.spatial

WEST, SOUTH = 6.0, 47.5  # of a box around the country [degrees]
EXTENT = 7.0  # [degrees]
LEVELS = 5  # a border has at most 2^LEVELS edges
SHORTEST = 3e-5  # [EXTENT] shorter edges are not divided
DISPLACED = 0.15  # displacement of the middle of a border over its length
SHRINKING = 0.7  # displacement of a level over that of the level above
SPREAD = math.radians(55)  # directions of all pieces of a border turn from its straight line by less
DIGITS = 7  # of a coordinate behind the point


class Country:
    """Rings of all districts, closed, each as a list of [longitude, latitude]."""

    def __init__(self, seed, districts, apart=0.0):
        self.random = random.Random(seed)
        self.apart = apart
        self.borders = {}  # vertices along each border, by the numbers of its ends in the diagram, the lower one first
        places = [(self.random.random(), self.random.random()) for _ in range(3 * districts)]
        self.diagram = scipy.spatial.Voronoi(numpy.array(places))
        self.cells = {(min(ends), max(ends)): cells
                      for ends, cells in zip(self.diagram.ridge_vertices, self.diagram.ridge_points)}
        self.rings = [self.ring(cell) for cell in self.members(places, districts)]

    def members(self, places, districts):
        """The cells nearest to a few middles, so that the coast has capes and bays."""
        middles = [(0.3 + 0.4 * self.random.random(), 0.3 + 0.4 * self.random.random(), 0.7 + self.random.random())
                   for _ in range(4)]

        def outside(k):
            return min(math.dist(places[k], middle[:2]) / middle[2] for middle in middles)
        return [k for k in sorted(range(len(places)), key=outside) if self.is_inside(k)][:districts]

    def is_inside(self, cell):
        """Does the whole cell lie in the box?"""
        ends = self.diagram.regions[self.diagram.point_region[cell]]
        return -1 not in ends and bool(numpy.all(abs(self.diagram.vertices[ends] - 0.5) < 0.5))

    def ring(self, cell):
        ends = self.diagram.regions[self.diagram.point_region[cell]]
        ring = []
        for a, b in zip(ends, ends[1:] + ends[:1]):
            path = self.border(min(a, b), max(a, b))
            path = path[:-1] if a < b else path[:0:-1]
            ring += path[:1] + [self.digitised(p) for p in path[1:]]
        ring = [in_degrees(p) for p in ring]
        ring = [p for p, before in zip(ring, ring[-1:] + ring) if p != before]
        return ring + ring[:1]

    def border(self, a, b):
        """Vertices from one vertex of the diagram to another."""
        if (a, b) not in self.borders:
            start, end = complex(*self.diagram.vertices[a]), complex(*self.diagram.vertices[b])
            places = [complex(*self.diagram.points[cell]) for cell in self.cells[a, b]]
            corners = [abs(cmath.phase((end - start) / (place - start))) for place in places]
            corners += [abs(cmath.phase((start - end) / (place - end))) for place in places]
            share = DISPLACED * min(1, 0.9 * min(corners) / SPREAD)
            self.borders[a, b] = displaced(start, end, share, LEVELS, self.random) + [end]
        return self.borders[a, b]

    def digitised(self, p):
        step = self.apart / EXTENT
        return p + complex(self.random.uniform(-step, step), self.random.uniform(-step, step)) if step else p


def displaced(a, b, share, levels, rng):
    """A ragged path from a to b, without b."""
    if levels == 0 or abs(b - a) < SHORTEST:
        return [a]
    middle = (a + b) / 2 + 1j * (b - a) * share * rng.choice((-1, 1)) * rng.uniform(0.5, 1)
    return (displaced(a, middle, SHRINKING * share, levels - 1, rng)
            + displaced(middle, b, SHRINKING * share, levels - 1, rng))


def in_degrees(p):
    return [round(WEST + EXTENT * p.real, DIGITS), round(SOUTH + EXTENT * p.imag, DIGITS)]


def name_of(number):
    """The districts have seven names."""
    return f"district {number % 7}"


def as_geojson(country):
    """A feature for each district."""
    features = [{"type": "Feature", "properties": {"code": 100 + k, "name": name_of(k)},
                 "geometry": {"type": "Polygon", "coordinates": [ring]}} for k, ring in enumerate(country.rings)]
    return json.dumps({"type": "FeatureCollection", "features": features})


if __name__ == "__main__":
    print(as_geojson(Country(int(sys.argv[1]), int(sys.argv[2]), *map(float, sys.argv[3:]))))
