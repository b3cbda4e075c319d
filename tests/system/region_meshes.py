# SPDX-License-Identifier: BSD-3-Clause
"""Meshes with regions for regions_test.py: parts of configs, arrays of a file, and what other formats hold."""
import math
from collections import Counter

import h5py
import meshio
import numpy as np

DIGITS = 12  # coordinates are rounded to the lattice of the container


def rounded(point):
    return tuple(round(float(v), DIGITS) for v in point)


def rectangle(name, low, high):
    return (f"[shape.{name}]\ntype = rectangle\nx_min = {low[0]}\ny_min = {low[1]}\nx_max = {high[0]}\n"
            f"y_max = {high[1]}\n")


def circle(name, radius, center="0.5 0.5"):
    return f"[shape.{name}]\ntype = circle\ncenter = {center}\nradius = {radius}\n"


def triangle(name, *corners):
    return f"[shape.{name}]\ntype = triangle\n" + "".join(f"p{k} = {x!r} {y!r}\n" for k, (x, y) in enumerate(corners))


def region(name, geometry):
    return f"[region.{name}]\ngeometry = {geometry}\n"


def shoelace(points, edges):
    """The signed area on the left of closed paths."""
    a, b = points[edges[:, 0]], points[edges[:, 1]]
    return 0.5 * math.fsum(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])


def lengths_of(points, edges):
    return np.hypot(*(points[edges[:, 1]] - points[edges[:, 0]]).T)


def areas_of(points, triangles):
    a, b, c = (points[triangles[:, k]] for k in range(3))
    return 0.5 * ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0])


def by_number(numbers, values):
    """Sums of the values of each number."""
    return {int(number): math.fsum(values[numbers == number]) for number in np.unique(numbers)}


class Mesh:
    """The arrays of a mesh file, with regions by name."""

    def __init__(self, path):
        with h5py.File(path) as file:
            self.points, self.triangles = file["/Mesh/mesh/geometry"][:], file["/Mesh/mesh/topology"][:]
            self.region = file["/VTKHDF/CellData/region"][:]
            self.fixed, self.size = file["/VTKHDF/PointData/fixed"][:], file["/VTKHDF/PointData/size"][:]
            self.facets, self.facet_labels = file["/Mesh/facets/topology"][:], file["/Mesh/facets/labels"][:]
            tags = file["/trime_mpi/tags"]
            self.parts = [name.decode() for name in tags["part_name"]]
            self.names = {int(number): name.decode() for number, name in zip(tags["region_id"], tags["region_name"])}
            self.numbers = {name: number for number, name in self.names.items()}
            self.interfaces = {name: array[:] for name, array in file["/Mesh/interfaces"].items()} \
                if "interfaces" in file["/Mesh"] else {}
            table = file.get("/trime_mpi/interfaces")
            self.pairs = {} if table is None else {int(number): name.decode() for number, name in
                                                   zip(table["pair_id"], table["pair_name"])}
            self.sharp = file.get("/trime_mpi/sharp_corners")
            self.sharp = {} if self.sharp is None else {name: column[:] for name, column in self.sharp.items()}
            table = file.get("/trime_mpi/regions")
            self.table = {} if table is None else {name: column[:] for name, column in table.items()}
            self.curve_lengths = self.by_curve(file) if "curves" in file["/Mesh"] else {}
        self.edges = self.interfaces.get("topology", np.zeros((0, 2), int))
        self.areas = areas_of(self.points, self.triangles)

    def by_curve(self, file):
        """The length of the edges on each curve, by its name."""
        names = [name.decode() for name in file["/trime_mpi/curves/curve_name"][:]]
        lengths = by_number(file["/Mesh/curves/values"][:], lengths_of(self.points, file["/Mesh/curves/topology"][:]))
        return {names[number]: length for number, length in lengths.items()}

    def arrays(self):
        return {"points": self.points, "triangles": self.triangles, "region": self.region, **self.interfaces}

    def area(self, name):
        return math.fsum(self.areas[self.region == self.numbers[name]])

    def pair_edges(self, name=None):
        """The edges of the pair `A|B`, or of all pairs."""
        if name is None:
            return self.edges
        wanted = [number for number, pair in self.pairs.items() if pair == name]
        return self.edges[np.isin(self.interfaces["values"], wanted)]

    def length(self, name=None):
        return math.fsum(lengths_of(self.points, self.pair_edges(name)))

    def pair_names(self):
        """Names of the pairs that have edges."""
        return {self.pairs[int(number)] for number in np.unique(self.interfaces["values"])}

    def junctions(self):
        """Returns how many chords meet in each point that has three or more."""
        chords = np.unique(np.sort(np.vstack([self.facets, self.edges])), axis=0)
        degrees = Counter(chords.ravel().tolist())
        return {rounded(self.points[k]): n for k, n in degrees.items() if n > 2}

    def meeting_point(self, *names):
        """Returns the only point at which triangles of all these regions meet."""
        around = [np.unique(self.triangles[self.region == self.numbers[name]]) for name in names]
        (point,) = set.intersection(*(set(points.tolist()) for points in around))
        return self.points[point]

    def euler(self, name):
        own = self.triangles[self.region == self.numbers[name]]
        sides = np.unique(np.sort(own[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)), axis=0)
        return len(np.unique(own)) - len(sides) + len(own)

    def largest_angle(self):
        """The largest angle opposite to a facet or an interface edge, in degrees."""
        chords = {tuple(sorted(edge)) for edge in np.vstack([self.facets, self.edges]).tolist()}
        largest = 0.0
        for k in range(3):
            a, b, apex = (self.triangles[:, (k + shift) % 3] for shift in (1, 2, 0))
            on_chord = np.array([edge in chords for edge in map(tuple, np.sort(np.column_stack([a, b])).tolist())])
            u, v = ((self.points[end] - self.points[apex])[on_chord] for end in (a, b))
            cosine = (u * v).sum(axis=1) / np.hypot(*u.T) / np.hypot(*v.T)
            largest = max(largest, math.degrees(math.acos(cosine.min())) if len(cosine) else 0.0)
        return largest

    def alpha(self):
        a, b, c = (self.points[self.triangles[:, k]] for k in range(3))
        sides = [np.hypot(*(p - q).T) for p, q in ((a, b), (b, c), (c, a))]
        return (sides[0] * sides[1] * sides[2] * sum(sides) / (16 * self.areas**2)).max()

    def segment_areas(self, edges, radius):
        """The area between chords of a circle and the circle."""
        half = np.arcsin(lengths_of(self.points, edges) / (2 * radius))
        return math.fsum(radius * radius * (half - np.sin(half) * np.cos(half)))


def read_by_meshio(path, label, number):
    """Areas of each region and lengths of each label."""
    mesh = meshio.read(path, **({"file_format": "gmsh"} if path.suffix == ".msh" else {}))
    points, areas, lengths = mesh.points[:, :2], Counter(), Counter()
    for k, block in enumerate(mesh.cells):
        if block.type == "triangle":
            areas.update(by_number(mesh.cell_data[number][k], areas_of(points, block.data)))
        elif block.type == "line":
            lengths.update(by_number(mesh.cell_data[label][k], lengths_of(points, block.data)))
    return areas, lengths


def read_freefem(path):
    numbers = path.read_text().split()
    n, m, b = map(int, numbers[:3])
    at = 3 + 3 * n
    points = np.array(numbers[3:at], float).reshape(-1, 3)[:, :2]
    triangles = np.array(numbers[at:at + 4 * m], int).reshape(-1, 4)
    edges = np.array(numbers[at + 4 * m:at + 4 * m + 3 * b], int).reshape(-1, 3)
    return (by_number(triangles[:, 3], areas_of(points, triangles[:, :3] - 1)),
            by_number(edges[:, 2], lengths_of(points, edges[:, :2] - 1)))


def read_triangle(stem):
    points = np.loadtxt(stem.with_suffix(".node"), skiprows=1)[:, 1:3]
    triangles = np.loadtxt(stem.with_suffix(".ele"), skiprows=1, dtype=int)
    edges = np.loadtxt(stem.with_suffix(".edge"), skiprows=1, dtype=int)
    edges = edges[edges[:, 3] > 0]
    return (by_number(triangles[:, 4], areas_of(points, triangles[:, 1:4] - 1)),
            by_number(edges[:, 3], lengths_of(points, edges[:, 1:3] - 1)))
