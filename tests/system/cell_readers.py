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
        """Whether no corner of a polygon is reflex, but for rounding."""
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
