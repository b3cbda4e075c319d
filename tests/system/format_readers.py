# SPDX-License-Identifier: BSD-3-Clause
"""The scripts by which other programs read our files, and what they must find there, for formats_test.py."""
import re

import h5py
import numpy as np

BY_DOLFINX = """
import sys
import gmsh
import numpy as np
from mpi4py import MPI
from dolfinx.io import XDMFFile, gmshio
from dolfinx.mesh import compute_midpoints
world = MPI.COMM_WORLD
gmsh.initialize()
gmsh.option.setNumber("General.Terminal", 0)

def save(mesh, tags, cells, path):
    def own(dimension):
        return np.arange(mesh.topology.index_map(dimension).size_local, dtype=np.int32)
    def middles(dimension, tags):
        kept = tags.indices < len(own(dimension))
        return np.column_stack([compute_midpoints(mesh, dimension, tags.indices[kept])[:, :2], tags.values[kept]])
    parts = {"points": mesh.geometry.x[:mesh.geometry.index_map().size_local, :2],
             "triangles": compute_midpoints(mesh, 2, own(2))[:, :2], "edges": middles(1, tags)}
    if cells is not None:
        parts["regions"] = middles(2, cells)
    whole = {name: world.gather(part) for name, part in parts.items()}
    if world.rank == 0:
        np.savez(path, **{name: np.vstack(part) for name, part in whole.items()})

for stem in sys.argv[1:]:
    if world.rank == 0:
        gmsh.open(stem + ".msh")
    mesh, cells, facets = gmshio.model_to_mesh(gmsh.model, world, 0, gdim=2)
    save(mesh, facets, cells, stem + ".msh.npz")
    with XDMFFile(world, stem + ".xdmf", "r") as file:
        mesh = file.read_mesh(name="mesh")
        cells = file.read_meshtags(mesh, name="mesh") if stem.endswith("layers") else None
    mesh.topology.create_connectivity(1, 2)
    with XDMFFile(world, stem + ".xmf", "r") as file:
        save(mesh, file.read_meshtags(mesh, name="facets"), cells, stem + ".xdmf.npz")
"""
BY_QGIS = """
import os
import sys
import numpy as np
from qgis.core import QgsApplication, QgsMesh, QgsMeshLayer
application = QgsApplication([], False)
application.initQgis()
for path in sys.argv[1:]:
    layer, mesh = QgsMeshLayer(path, "mesh", "mdal"), QgsMesh()
    assert layer.isValid(), path
    layer.dataProvider().populateMesh(mesh)
    points = [mesh.vertex(k) for k in range(mesh.vertexCount())]
    np.savez(path + ".npz", points=[(p.x(), p.y()) for p in points],
             triangles=[mesh.face(k) for k in range(mesh.faceCount())])
os._exit(0)  # without taking Qt down
"""
BY_FREEFEM = """
{
  mesh Th READ;
  cout << "file FILE" << endl;
  for (int i = 0; i < Th.nv; ++i) cout << "vertex " << Th(i).x << " " << Th(i).y << " " << Th(i).label << endl;
  for (int t = 0; t < Th.nt; ++t)
    cout << "triangle " << Th[t][0] << " " << Th[t][1] << " " << Th[t][2] << " " << Th[t].region << endl;
  for (int e = 0; e < Th.nbe; ++e)
    cout << "edge " << Th.be(e)[0] << " " << Th.be(e)[1] << " " << Th.be(e).label << endl;
  int[int] labels = LABELS;
  for (int k = 0; k < labels.n; ++k) cout << "length " << int1d(Th, labels[k])(1.) << endl;
  cout << "end" << endl;
}
"""


class Expected:
    """The content of the HDF5 file. `edges` and `parts` are those of the boundary, of curves and of interfaces."""

    def __init__(self, path):
        with h5py.File(path) as file:
            self.points = file["/Mesh/mesh/geometry"][:]
            self.triangles = file["/Mesh/mesh/topology"][:]
            self.edges = file["/Mesh/facets/topology"][:]
            self.labels = file["/Mesh/facets/labels"][:]
            if not np.array_equal(self.labels, file["/Mesh/facets/parts"][:] + 1):
                raise AssertionError("labels are numbers of parts, from 1")
            tags = file["/trime_mpi/tags"]
            self.parts = {name.decode(): int(number) + 1 for name, number in zip(tags["part_name"], tags["part_id"])}
            self.holes = list(tags["edge_kind"]).count(b"hole")
            self.regions = {name.decode(): int(number) for name, number in zip(tags["region_name"], tags["region_id"])}
            self.region = file["/VTKHDF/CellData/region"][:]
            self.rim, self.rim_labels, self.rim_parts = self.edges, self.labels, dict(self.parts)
            if "interfaces" in file["Mesh"]:
                self.add_inner_edges(file)

    def add_inner_edges(self, file):
        """Adds curves and interfaces, with the labels of their own arrays."""
        for group, name in (("curves", "curve_name"), ("interfaces", "pair_name")):
            arrays, table = file["Mesh"][group], file["trime_mpi"][group]
            kept = arrays["curves"][:] < 0 if group == "interfaces" else slice(None)
            self.edges = np.vstack([self.edges, arrays["topology"][:][kept]])
            self.labels = np.concatenate([self.labels, arrays["labels"][:][kept]])
            self.parts |= {name.decode(): int(label) for name, label in zip(table[name], table["label"])}

    def regions_with_triangles(self):
        """Returns the regions that MSH files have."""
        return {name: number for name, number in self.regions.items() if number in self.region}

    def rim_rows(self):
        """Boundary edges with their label, in one order."""
        return rows(self.rim, self.rim_labels)

    def edge_rows(self):
        """Edges with their label, in one order."""
        return rows(self.edges, self.labels)

    def parts_with_edges(self):
        """Those that MSH files have: dolfinx and meshio do not read a group without elements."""
        return {name: number for name, number in self.parts.items() if number in self.labels}

    def point_labels(self):
        """The lowest label of the edges at each point; 0 inside."""
        labels = np.full(len(self.points), 1 << 30)
        for end in (0, 1):
            np.minimum.at(labels, self.edges[:, end], self.labels)
        return np.where(labels < 1 << 30, labels, 0)

    def length(self, label):
        """Returns the length of the boundary with a label."""
        ends = self.points[self.edges[self.labels == label]]
        return np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).sum()


def rows(edges, labels):
    """Edges with their label as sorted rows."""
    return sorted(map(tuple, np.column_stack([edges, labels]).tolist()))


def in_order(table):
    """Its rows, sorted by what they round to."""
    return table[np.lexsort(np.round(table, 9).T)]


def with_name(numbers, lines):
    """{name: number} of comments such as `# marker 2: hole`."""
    found = {}
    for line in lines:
        if match := re.match(rf"# {numbers} (\d+): (.*)", line):
            found[match[2]] = int(match[1])
    return found
