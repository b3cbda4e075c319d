# SPDX-License-Identifier: BSD-3-Clause
"""Reads files of coastal and flow models, and refuses what is not of the format."""
import struct

import numpy as np


class Gr3:
    """hgrid.gr3 of SCHISM. Strings are (name, type, points) with points from 0; open ones have no type."""

    def __init__(self, path):
        lines = path.read_text().splitlines()
        triangles, points = map(int, lines[1].split())
        table = np.array([line.split() for line in lines[2:2 + points]], float)
        if not np.array_equal(table[:, 0], np.arange(points) + 1):
            raise AssertionError("points are numbered from 1")
        self.points, self.depth = table[:, 1:3], table[:, 3]
        table = np.array([line.split() for line in lines[2 + points:2 + points + triangles]], int)
        if not np.array_equal(table[:, :2], np.column_stack([np.arange(triangles) + 1, np.full(triangles, 3)])):
            raise AssertionError("triangles are numbered from 1, and have 3 points")
        self.triangles = table[:, 2:] - 1
        self.lines = iter(lines[2 + points + triangles:])
        self.open, self.land = self.strings(1), self.strings(2)
        if next(self.lines, None) is not None:
            raise AssertionError("lines behind the end")

    def strings(self, words):
        count, total = (int(next(self.lines).split()[0]) for _ in range(2))
        strings = []
        for _ in range(count):
            head, name = next(self.lines).split(" = ")
            numbers = [int(word) for word in head.split()]
            if len(numbers) != words:
                raise AssertionError(f"expected {words} numbers: {head}")
            strings.append((name, numbers[1] if words == 2 else None,
                            [int(next(self.lines)) - 1 for _ in range(numbers[0])]))
        if total != sum(len(points) for _, _, points in strings):
            raise AssertionError("wrong sum of points")
        return strings


class Fvcom:
    """CASE_grd.dat of FVCOM with its other files, read as FVCOM does: counts by their names, then rows in order.

    obc are the points of the open boundary from 0, and latitudes those of _cor.dat, None without this file.
    """

    def __init__(self, path):
        points, triangles, table = self.table(path, "Node Number", "Cell Number")
        cells, nodes = np.array(table[:triangles], int), np.array(table[triangles:], float)
        if cells.shape != (triangles, 4) or nodes.shape != (points, 3):
            raise AssertionError("numbers of triangles and points")
        if not (np.array_equal(cells[:, 0], np.arange(triangles) + 1) and
                np.array_equal(nodes[:, 0], np.arange(points) + 1)):
            raise AssertionError("triangles and points are numbered from 1")
        self.points, self.triangles = nodes[:, 1:], cells[:, 1:] - 1
        self.depth = self.values(self.beside(path, "dep"), points)
        cor = self.beside(path, "cor")
        self.latitudes = self.values(cor, points) if cor.exists() else None
        count, rows = self.table(self.beside(path, "obc"), "OBC Node Number")
        table = np.array(rows, int).reshape(count, 3)
        if not (np.array_equal(table[:, 0], np.arange(count) + 1) and (table[:, 2] == 1).all()):
            raise AssertionError("rows of the open boundary: number, point, type 1")
        self.obc = table[:, 1] - 1
        if len(set(self.obc)) != count or not np.isin(self.obc, np.arange(points)).all():
            raise AssertionError("points of the open boundary, each once")

    @staticmethod
    def beside(path, kind):
        return path.with_name(path.name.replace("_grd.dat", f"_{kind}.dat"))

    @staticmethod
    def table(path, *names):
        """The counts with these names, and the rows behind them as words."""
        lines = path.read_text().splitlines()
        counts = []
        for name, line in zip(names, lines):
            found, count = line.split(" = ")
            if found != name:
                raise AssertionError(f"expected {name}: {line}")
            counts.append(int(count))
        return *counts, [line.split() for line in lines[len(names):]]

    def values(self, path, points):
        """The third column of a file that repeats the coordinates."""
        count, table = self.table(path, "Node Number")
        table = np.array(table, float)
        if count != points or table.shape != (points, 3) or not np.array_equal(table[:, :2], self.points):
            raise AssertionError(f"{path}: x, y and a value for each point")
        return table[:, 2]


class Slf:
    """Selafin of TELEMAC with double precision and one time, and its boundary conditions."""

    def __init__(self, path):
        self.bytes, self.at = path.read_bytes(), 0
        title = self.record()
        if len(title) != 80 or not title.endswith(b"SERAFIND"):
            raise AssertionError(title)
        linear, quadratic = self.integers()
        if quadratic != 0:
            raise AssertionError("quadratic variables")
        self.variables = [self.record() for _ in range(linear)]
        if any(len(name) != 32 for name in self.variables):
            raise AssertionError("names of variables have 32 characters")
        if list(self.integers()) != [1] + 9 * [0]:
            raise AssertionError("parameters")
        triangles, points, corners, one = self.integers()
        self.triangles = self.integers().reshape(triangles, corners) - 1
        self.number = self.integers()
        self.points = np.column_stack([self.reals(), self.reals()])
        if len(self.number) != points or len(self.points) != points or corners != 3 or one != 1:
            raise AssertionError("lengths of records")
        self.time = self.reals()
        self.values = [self.reals() for _ in range(linear)]
        if self.at != len(self.bytes):
            raise AssertionError("bytes behind the end")
        table = np.array([line.split() for line in path.with_suffix(".cli").read_text().splitlines()], float)
        if table.shape[1] != 13 or not np.array_equal(table[:, 12], np.arange(len(table)) + 1):
            raise AssertionError("13 columns, the last one the number")
        self.codes, self.rim = table[:, [0, 1, 2, 7]].astype(int), table[:, 11].astype(int) - 1

    def record(self):
        (length,) = struct.unpack_from(">i", self.bytes, self.at)
        if struct.unpack_from(">i", self.bytes, self.at + 4 + length) != (length,):
            raise AssertionError("marks of a record")
        self.at += length + 8
        return self.bytes[self.at - 4 - length:self.at - 4]

    def integers(self):
        return np.frombuffer(self.record(), ">i4").astype(int)

    def reals(self):
        return np.frombuffer(self.record(), ">f8").astype(float)


class Su2:
    """A mesh of SU2. Markers are pairs of points from 0."""

    def __init__(self, path):
        self.lines = iter(path.read_text().splitlines())
        if self.value("NDIME") != "2":
            raise AssertionError("two dimensions")
        table = self.table("NELEM")
        if not np.array_equal(table[:, [0, 4]], np.column_stack([np.full(len(table), 5), np.arange(len(table))])):
            raise AssertionError("triangles are of type 5, numbered from 0")
        self.triangles = table[:, 1:4].astype(int)
        table = self.table("NPOIN")
        if not np.array_equal(table[:, 2], np.arange(len(table))):
            raise AssertionError("points are numbered from 0")
        self.points, self.markers = table[:, :2], {}
        for _ in range(int(self.value("NMARK"))):
            name, table = self.value("MARKER_TAG"), self.table("MARKER_ELEMS")
            if name in self.markers or " " in name or not (table[:, 0] == 3).all():
                raise AssertionError(f"marker {name}")
            self.markers[name] = table[:, 1:].astype(int)
        if next(self.lines, None) is not None:
            raise AssertionError("lines behind the end")

    def value(self, key):
        found, value = next(self.lines).split("= ")
        if found != key:
            raise AssertionError(f"expected {key}, found {found}")
        return value

    def table(self, key):
        return np.array([next(self.lines).split() for _ in range(int(self.value(key)))], float)
