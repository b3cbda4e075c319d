# SPDX-License-Identifier: BSD-3-Clause
"""Strict readers of the files with Voronoi cells, for cells_test.py."""
from collections import defaultdict
from xml.etree import ElementTree

import numpy as np

TYPES = {"Float64": "f8", "Int64": "i8", "Int32": "i4", "UInt8": "u1"}


class CellFile:
    """The polygons of NAME_cells.vtu: arrays by name, and corners of each polygon."""

    def __init__(self, path):
        text = path.read_bytes()
        start = text.index(b'<AppendedData encoding="raw">\n_')
        self.root = ElementTree.fromstring(text[:start] + b"</VTKFile>")
        self.data, self.end = text[start + len(b'<AppendedData encoding="raw">\n_'):], 0
        piece = self.root.find("UnstructuredGrid/Piece")
        self.arrays = {array.get("Name"): self.array(array) for array in piece.iter("DataArray")}
        assert self.data[self.end:] == b"\n</AppendedData>\n</VTKFile>\n"
        self.vertices = self.arrays["Points"][:, :2]
        assert len(self.vertices) == int(piece.get("NumberOfPoints"))
        assert np.array_equal(self.arrays["Points"][:, 2], np.zeros(len(self.vertices)))
        ends = self.arrays["offsets"]
        assert len(ends) == int(piece.get("NumberOfCells")) and ends[-1] == len(self.arrays["connectivity"])
        assert (self.arrays["types"] == 7).all()
        self.polygons = np.split(self.arrays["connectivity"], ends[:-1])
        self.site, self.region, self.area = (self.arrays[name] for name in ("site", "region", "area"))
        self.places = self.arrays["site_place"][:, :2]
        self.regions = {array.get("Name").removeprefix("region "): int(array.text)
                        for array in self.root.find("UnstructuredGrid/FieldData")}

    def array(self, description):
        """The arrays follow each other without gaps."""
        assert int(description.get("offset")) == self.end
        size = int(np.frombuffer(self.data, "u8", 1, self.end)[0])
        values = np.frombuffer(self.data[self.end + 8:self.end + 8 + size], TYPES[description.get("type")])
        self.end += 8 + size
        columns = int(description.get("NumberOfComponents", 1))
        return values.reshape(-1, columns) if columns > 1 else values

    def polygon_areas(self):
        """Areas by the vertices, as the file has them."""
        areas = np.empty(len(self.polygons))
        for k, polygon in enumerate(self.polygons):
            x, y = (self.vertices[polygon] - self.vertices[polygon[0]]).T
            areas[k] = 0.5 * (x @ np.roll(y, -1) - y @ np.roll(x, -1))
        return areas

    def is_convex(self):
        """Returns for each polygon whether no corner is reflex, except by rounding."""
        convex = np.empty(len(self.polygons), bool)
        for k, polygon in enumerate(self.polygons):
            to = np.roll(self.vertices[polygon], -1, axis=0) - self.vertices[polygon]
            turns = to[:, 0] * np.roll(to[:, 1], -1) - to[:, 1] * np.roll(to[:, 0], -1)
            convex[k] = turns.min() > -1e-9 * self.area[k]
        return convex

    def sides(self):
        """Polygons by the ends of their sides, the lower number first."""
        found = defaultdict(list)
        for k, polygon in enumerate(self.polygons):
            for a, b in zip(polygon, np.roll(polygon, -1)):
                found[min(a, b), max(a, b)].append((k, a < b))
        return found


def flux_terms(file, conductivity):
    """Coefficients of a two-point flux by pairs of sites: the sum over regions of conductivity * dual length / length.

    @param conductivity: by number of the region
    """
    place = dict(zip(file.site.tolist(), file.places))
    terms = defaultdict(float)
    for (a, b), owners in file.sides().items():
        assert len(owners) in (1, 2), (a, b)
        if len(owners) == 1:
            continue
        (k, forward), (other, backward) = owners
        assert forward != backward, "neighbours run along their side in opposite directions"
        sites = sorted((int(file.site[k]), int(file.site[other])))
        if sites[0] == sites[1]:
            assert file.region[k] != file.region[other]
            continue
        assert file.region[k] == file.region[other]
        side, arm = file.vertices[b] - file.vertices[a], place[sites[1]] - place[sites[0]]
        length = np.hypot(*arm)
        assert abs(side @ arm) <= 1e-12 * length, "a side is perpendicular to the line between its sites"
        terms[sites[0], sites[1]] += conductivity[int(file.region[k])] * np.hypot(*side) / length
    return terms


class Disv:
    """A grid of MODFLOW 6, read as strictly as MODFLOW does; numbers from 0."""

    def __init__(self, path):
        lines = path.read_text().splitlines()
        self.zones = {int(words[2]): words[5] for words in (line.split(maxsplit=5) for line in lines)
                      if words[:2] == ["#", "zone"]}
        self.lines = iter([line.split() for line in lines if line.strip() and not line.startswith("#")])
        assert self.block("OPTIONS") == []
        sizes = {word: int(number) for word, number in self.block("DIMENSIONS")}
        assert set(sizes) == {"NLAY", "NCPL", "NVERT"} and sizes["NLAY"] == 1
        assert self.block("GRIDDATA") == [["TOP"], ["CONSTANT", "1.0"], ["BOTM", "LAYERED"], ["CONSTANT", "0.0"]]
        rows = self.block("VERTICES")
        assert [int(row[0]) for row in rows] == list(range(1, sizes["NVERT"] + 1))
        self.vertices = np.array([[float(word) for word in row[1:]] for row in rows])
        rows = self.block("CELL2D")
        assert [int(row[0]) for row in rows] == list(range(1, sizes["NCPL"] + 1))
        assert all(int(row[3]) == len(row) - 4 and len(row) - 4 <= 30 for row in rows)
        assert next(self.lines, None) is None
        self.places = np.array([[float(word) for word in row[1:3]] for row in rows])
        self.cells = [np.array([int(word) for word in row[4:]]) - 1 for row in rows]

    def block(self, name):
        """The rows of a block."""
        assert next(self.lines) == ["BEGIN", name]
        rows = []
        while (row := next(self.lines)) != ["END", name]:
            rows.append(row)
        return rows

    def areas(self):
        """Areas, which must be those of clockwise polygons without edges of length 0."""
        areas = np.empty(len(self.cells))
        for k, cell in enumerate(self.cells):
            x, y = (self.vertices[cell] - self.places[k]).T
            steps = np.hypot(np.roll(x, -1) - x, np.roll(y, -1) - y)
            assert steps.min() > 1e-10 * steps.max(), (k, steps)
            areas[k] = -0.5 * (x @ np.roll(y, -1) - y @ np.roll(x, -1))
        return areas

    def faces(self):
        """Pairs of cells that share two vertices, as MODFLOW finds them."""
        owners = defaultdict(list)
        for k, cell in enumerate(self.cells):
            for a, b in zip(cell.tolist(), np.roll(cell, -1).tolist()):
                owners[min(a, b), max(a, b)].append(k)
        assert max(map(len, owners.values())) == 2
        return sorted(tuple(pair) for pair in owners.values() if len(pair) == 2)


def read_uge(path):
    """Cells (x, y, z, volume), ends of connections from 0, and their faces (x, y, z, area)."""
    rows = [line.split() for line in path.read_text().splitlines()]
    count = int(rows[0][1])
    assert rows[0][0] == "CELLS" and rows[count + 1] == ["CONNECTIONS", str(len(rows) - count - 2)]
    cells, faces = np.array(rows[1:count + 1], float), np.array(rows[count + 2:], float)
    assert np.array_equal(cells[:, 0], np.arange(1, count + 1)) and cells.shape[1] == 5 and faces.shape[1] == 6
    assert (cells[:, 3] == 0).all() and (faces[:, 4] == 0).all()
    return cells[:, 1:], faces[:, :2].astype(int) - 1, faces[:, 2:]


def fortran_number(text):
    """A number in ten columns, which must have a decimal point: Fortran's E10.4 would put one into it."""
    assert len(text) == 10 and "." in text, text
    return float(text)


def read_tough(path):
    """A file MESH of TOUGH2: names, materials, volumes and centres of elements, ends of connections from 0, and
    direction, both distances, area and cosine of connections."""
    text = path.read_text(encoding="ascii")
    blocks = text.split("\n\n")
    assert len(blocks) == 3 and blocks[2] == ""
    elements, connections = (block.split("\n") for block in blocks[:2])
    assert elements.pop(0) == "ELEME" and connections.pop(0) == "CONNE"
    names = [row[:5] for row in elements]
    number_of = {name: k for k, name in enumerate(names)}
    assert len(number_of) == len(names)
    assert all(len(row) == 80 and row[5:15] == " " * 10 and row[30:50] == " " * 20 for row in elements)
    assert all(name.isascii() and name[0].isalpha() and name[:3].isalnum() and name[3:].isdigit() for name in names)
    values = np.array([[fortran_number(row[k:k + 10]) for k in (20, 50, 60, 70)] for row in elements])
    assert (values[:, 3] == 0).all()
    assert all(len(row) == 70 and row[10:25] == " " * 15 for row in connections)
    ends = np.array([[number_of[row[:5]], number_of[row[5:10]]] for row in connections])
    numbers = [[int(row[25:30])] + [fortran_number(row[k:k + 10]) for k in (30, 40, 50, 60)] for row in connections]
    return names, [row[15:20].strip() for row in elements], values[:, 0], values[:, 1:3], ends, np.array(numbers)
