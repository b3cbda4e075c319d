# SPDX-License-Identifier: BSD-3-Clause
"""Runs Gmsh's Frontal-Delaunay algorithm on the shapes of benchmark.py. This is a module, not a program.

Gmsh makes about as many vertices as our mesh has. For the square it gets one size at the corners. For every other
shape, a contour with or without lakes and round holes, it gets the sizes of our mesh file as a background field on a
grid. The script multiplies this field by a scale, and finds by a few runs the scale for which the numbers of vertices
agree within 3 %. The seconds do not include this search.
"""
import configparser
import pathlib
import re
import statistics
import subprocess
import sys
import time

GRID = 1001        # values a side of the size field, over the container, which is the unit square
NORMALIZED = 0.8   # longer side of a normalised contour in it
NEAR = 0.03        # as many vertices, to this share of them


def read_rings(path):
    """Rings of complex numbers, the longest first, normalised into the container as `normalize = true` does."""
    rings = [[]]
    for line in path.read_text(encoding="ascii").splitlines():
        text = line.split("#")[0].split()
        if text:
            rings[-1].append(complex(float(text[0]), float(text[1])))
        elif rings[-1] and not line.strip():
            rings.append([])
    # Neither the vertex that closes a ring nor one that repeats the vertex before it.
    rings = [[p for p, before in zip(ring, [ring[-1], *ring]) if p != before] for ring in rings if ring]
    x, y = [p.real for ring in rings for p in ring], [p.imag for ring in rings for p in ring]
    middle = complex(min(x) + max(x), min(y) + max(y)) / 2
    scale = NORMALIZED / max(max(x) - min(x), max(y) - min(y))
    return sorted([[0.5 + 0.5j + scale * (p - middle) for p in ring] for ring in rings], key=len, reverse=True)


class Geometry:
    """The lines of a .geo file: one plane surface, its first loop outside."""

    def __init__(self):
        self.lines, self.points, self.curves, self.loops = [], 0, 0, 0

    def point(self, p):
        self.points += 1
        self.lines.append(f"Point({self.points}) = {{{p.real!r}, {p.imag!r}, 0}};")
        return self.points

    def curve(self, kind, *points):
        self.curves += 1
        self.lines.append(f"{kind}({self.curves}) = {{{', '.join(map(str, points))}}};")
        return self.curves

    def loop(self, curves):
        self.loops += 1
        self.lines.append(f"Curve Loop({self.loops}) = {{{', '.join(map(str, curves))}}};")

    def ring(self, corners):
        names = [self.point(p) for p in corners]
        self.loop([self.curve("Line", a, b) for a, b in zip(names, names[1:] + names[:1])])

    def circle(self, centre, radius):
        middle, *rim = [self.point(centre + radius * turn) for turn in (0, 1, 1j, -1, -1j)]
        self.loop([self.curve("Circle", a, middle, b) for a, b in zip(rim, rim[1:] + rim[:1])])

    def text(self):
        surface = f"Plane Surface(1) = {{{', '.join(str(k + 1) for k in range(self.loops))}}};"
        return "\n".join([*self.lines, surface]) + "\n"


def geometry_of(config):
    """The .geo of a config of benchmark.py: a square, or contours, circles being cut out of them."""
    shape = configparser.ConfigParser()
    shape.read_string(config)
    geometry = Geometry()
    if shape["shape"]["geometry"] == "domain":
        geometry.ring([0j, 1 + 0j, 1 + 1j, 1j])
    for part in (shape[name] for name in shape.sections() if name.startswith("shape.")):
        if part["type"] == "contour":
            for ring in read_rings(pathlib.Path(part["file"])):
                geometry.ring(ring)
        elif part["type"] == "circle":
            geometry.circle(complex(*map(float, part["center"].split())), float(part["radius"]))
        else:
            sys.exit(f"gmsh_rival.py: no part of type {part['type']}")
    return geometry.text()


def write_size_field(mesh_file, path):
    """Our size, linear between the points of our mesh and that of the nearest one outside, as a Structured field."""
    import h5py
    import numpy
    from scipy.interpolate import LinearNDInterpolator, NearestNDInterpolator
    with h5py.File(mesh_file) as file:
        points, size = file["Mesh/mesh/geometry"][:], file["VTKHDF/PointData/size"][:]
    sides = numpy.linspace(0, 1, GRID)
    places = numpy.stack(numpy.meshgrid(sides, sides, indexing="ij"), axis=-1).reshape(-1, 2)
    values = LinearNDInterpolator(points, size)(places)
    outside = numpy.isnan(values)
    values[outside] = NearestNDInterpolator(points, size)(places[outside])
    with open(path, "w", encoding="ascii") as file:
        file.write(f"0 0 0\n{1 / (GRID - 1)!r} {1 / (GRID - 1)!r} 1\n{GRID} {GRID} 1\n")
        numpy.savetxt(file, values.reshape(GRID, GRID), fmt="%.6g")


class Rival:
    """Gmsh on one shape; `ours`: our mesh file, `points`: its number of points."""

    def __init__(self, config, ours, points, directory):
        self.directory = directory
        self.geometry = geometry_of(config)
        self.uniform = "geometry = domain" in config
        self.scale = 1.0
        if self.uniform:
            self.scale = (1 / (0.8660254 * points)) ** 0.5
        else:
            write_size_field(ours, directory / "g.size")
            self.find_scale(points)

    def find_scale(self, points):
        for _ in range(6):
            made = self.run()["points"]
            if abs(made - points) < NEAR * points:
                return
            self.scale *= (made / points) ** 0.5
        sys.exit(f"gmsh_rival.py: no scale found at which Gmsh makes {points} vertices")

    def size_text(self):
        if self.uniform:
            return f"MeshSize{{:}} = {self.scale!r};\n"
        return (f'Field[1] = Structured;\nField[1].FileName = "{self.directory}/g.size";\nField[1].TextFormat = 1;\n'
                f"Background Field = 1;\nMesh.MeshSizeFactor = {self.scale!r};\n"
                "Mesh.MeshSizeExtendFromBoundary = 0;\nMesh.MeshSizeFromPoints = 0;\n"
                "Mesh.MeshSizeFromCurvature = 0;\n")

    def run(self):
        """Returns the seconds that Gmsh prints for the meshing of the boundary and the inside (without its start and
        its files), the seconds of the whole command, and the quality."""
        geo, msh = self.directory / "g.geo", self.directory / "g.msh"
        geo.write_text(self.geometry + self.size_text(), encoding="ascii")
        begun = time.perf_counter()
        done = subprocess.run(["gmsh", "-2", "-v", "4", "-algo", "front2d", "-format", "msh22", "-o", msh, geo],
                              capture_output=True, text=True, check=True)
        command = time.perf_counter() - begun
        seconds = re.findall(r"Done meshing [12]D \(Wall ([\d.e-]+)s", done.stdout)
        if len(seconds) != 2:
            sys.exit(f"gmsh_rival.py: Gmsh printed no times:\n{done.stdout}{done.stderr}")
        return {"seconds": sum(map(float, seconds)), "command": command} | quality(msh)


def quality(path):
    lines = path.read_text(encoding="ascii").split("\n")
    start = lines.index("$Nodes") + 2
    place = {}
    for line in lines[start:start + int(lines[start - 1])]:
        tag, x, y, _ = line.split()
        place[tag] = complex(float(x), float(y))
    start = lines.index("$Elements") + 2
    alphas, used = [], set()
    for line in lines[start:start + int(lines[start - 1])]:
        entry = line.split()
        if entry[1] != "2":
            continue
        used.update(entry[-3:])
        p, q, r = (place[tag] for tag in entry[-3:])
        a, b, c = abs(p - q), abs(q - r), abs(r - p)
        twice_area = ((q - p).conjugate() * (r - p)).imag
        alphas.append(a * b * c * (a + b + c) / (4 * twice_area * twice_area))
    return {"points": len(used), "mean": statistics.fmean(alphas), "worst": max(alphas)}
