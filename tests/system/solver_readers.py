# SPDX-License-Identifier: BSD-3-Clause
"""Readers of .inp and .exo for tests: areas of regions and lengths of labels as these files have them."""
import re

import numpy as np
from scipy.io import netcdf_file

from region_meshes import areas_of, lengths_of


def edges_of(triangles, sides):
    """Returns the ends of the sides of triangles; side 1 joins the first two corners."""
    each = np.arange(len(sides))
    return np.column_stack([triangles[each, sides - 1], triangles[each, sides % 3]])


class Inp:
    """An input file of Abaqus, read without other programs."""

    def __init__(self, path):
        self.points, self.elements, self.blocks, self.surfaces, self.nsets, self.comments = [], {}, {}, {}, {}, {}
        rows = []
        for line in path.read_text().splitlines():
            if match := re.fullmatch(r"\*\* (region|label) (\d+): (.*): (?:ELSET|SURFACE and NSET) (\w+)", line):
                self.comments[match[1], int(match[2])] = (match[3], match[4])
            elif line.startswith("*"):
                word, *options = (part.strip() for part in line.split(","))
                options = dict(option.split("=") for option in options)
                rows = {"*NODE": lambda: self.points, "*HEADING": lambda: [],
                        "*ELEMENT": lambda: self.blocks.setdefault(options["ELSET"], []),
                        "*SURFACE": lambda: self.surfaces.setdefault(options["NAME"], []),
                        "*NSET": lambda: self.nsets.setdefault(options["NSET"], [])}[word]()
                self.elements[word] = options
            else:
                rows.append([entry.strip() for entry in line.split(",") if entry.strip()])
        self.longest = max(len(entry) for row in self.points for entry in row)

    def places(self):
        return np.array(self.points, dtype=float)[:, 1:]

    def triangles(self):
        """Returns the corners of all elements by the number of the element, from 0."""
        rows = np.array(sum(self.blocks.values(), []), dtype=int)
        return rows[np.argsort(rows[:, 0]), 1:] - 1

    def edges(self, name):
        """Returns the sides of a surface."""
        rows = self.surfaces[name]
        return edges_of(self.triangles()[[int(element) - 1 for element, _ in rows]],
                        np.array([int(side[1:]) for _, side in rows]))

    def sums(self):
        """Returns areas by region and lengths by label."""
        points, areas, lengths = self.places(), {}, {}
        for (what, number), (_, name) in self.comments.items():
            if what == "region":
                corners = np.array(self.blocks[name], dtype=int)[:, 1:] - 1
                areas[number] = areas_of(points, corners).sum()
            else:
                lengths[number] = lengths_of(points, self.edges(name)).sum()
        return areas, lengths


class Exo:
    """The arrays of an Exodus II file in the format CDF-2."""

    def __init__(self, path):
        with netcdf_file(path, mmap=False) as file:
            self.arrays = {name: array[...] for name, array in file.variables.items()}
            self.version, self.word_size = file.version_byte, file.floating_point_word_size
        self.names = {word: [b"".join(row).rstrip(b"\0").decode() for row in self.arrays[f"{word}_names"]]
                      for word in ("eb", "ss", "ns")}
        self.points = np.column_stack([self.arrays["coordx"], self.arrays["coordy"]])
        self.regions, self.labels = self.arrays["eb_prop1"].tolist(), self.arrays["ss_prop1"].tolist()
        self.blocks = [self.arrays[f"connect{k + 1}"] - 1 for k in range(len(self.regions))]
        self.triangles = np.vstack(self.blocks)
        self.edges = {label: edges_of(self.triangles[self.arrays[f"elem_ss{k}"] - 1], self.arrays[f"side_ss{k}"])
                      for k, label in enumerate(self.labels, 1)}
        self.nodes = {label: self.arrays[f"node_ns{k}"] - 1 for k, label in enumerate(self.labels, 1)}

    def sums(self):
        """Returns areas by region and lengths by label."""
        return ({region: areas_of(self.points, block).sum() for region, block in zip(self.regions, self.blocks)},
                {label: lengths_of(self.points, edges).sum() for label, edges in self.edges.items()})
