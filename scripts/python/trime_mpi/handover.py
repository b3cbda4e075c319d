# SPDX-License-Identifier: BSD-3-Clause
"""Gives a distributed mesh of trime_mpi.parallel to other packages in memory."""
import dataclasses
import typing

import numpy as np


@dataclasses.dataclass(frozen=True)
class Dolfinx:
    """A mesh for dolfinx.

    cell_tags holds the number of the region of each cell, from 1. facet_tags holds a number for each named edge: first
    come the parts of the boundary, then curves inside, then interfaces. regions and facets say which name has which
    number.
    """
    mesh: typing.Any
    cell_tags: typing.Any
    facet_tags: typing.Any
    regions: dict
    facets: dict

    def find(self, name):
        """Returns the facets of dolfinx with this name on this rank."""
        return self.facet_tags.find(self.facets[name])


def global_triangles(mesh):
    """Returns the triangles of this rank by global ids of their vertices."""
    return mesh.global_ids[mesh.triangles[:mesh.owned_triangles]]


def named_edges(mesh):
    """Returns the named edges that this rank owns: pairs of local points, numbers of the names, and a dict of these
    numbers. An edge on a curve that is also an interface has the number of the curve."""
    names = [*mesh.facet_names, *mesh.curve_names, *mesh.interface_names]
    numbers = {name: number for number, name in reversed(list(enumerate(names, 1)))}
    first_curve = 1 + len(mesh.facet_names)
    curves, ties = mesh.owned_curve_edges, mesh.owned_interfaces
    edges = np.concatenate([mesh.facets[:mesh.owned_facets], mesh.curve_edges[:curves], mesh.interfaces[:ties]])
    tags = np.concatenate([1 + mesh.facet_parts[:mesh.owned_facets], first_curve + mesh.curve_numbers[:curves],
                           first_curve + len(mesh.curve_names) + mesh.interface_pairs[:ties]]).astype(np.int32)
    _, rows = np.unique(np.sort(edges, axis=1), axis=0, return_index=True)  # the first of equal edges
    return edges[rows], tags[rows], numbers


def distributed_tags(domain, dim, entities, values):
    """Returns the tags of dolfinx for entities that are given by global ids of their vertices, on any rank."""
    import dolfinx
    local, found = dolfinx.cpp.io.distribute_entity_data(domain._mesh, dim, entities.astype(np.int64), values)
    domain.topology.create_connectivity(dim, 0)
    domain.topology.create_connectivity(dim, domain.topology.dim)
    lists = dolfinx.cpp.graph.AdjacencyList_int32(local)
    return dolfinx.mesh.meshtags_from_entities(domain, dim, lists, found.astype(np.int32))


def dolfinx_of(mesh, ghost_mode):
    """Returns the Dolfinx of a trime_mpi.parallel.Mesh. Collective."""
    import dolfinx
    import ufl
    triangles = global_triangles(mesh)
    mode = dolfinx.mesh.GhostMode.__members__[ghost_mode]
    here = np.full(len(triangles), mesh.comm.rank, np.int32)

    def keep(*_):  # dolfinx asks for the rank of each cell
        return dolfinx.cpp.graph.AdjacencyList_int32(here)

    partitioner = keep if ghost_mode == "none" else dolfinx.mesh.create_cell_partitioner()
    kind = ufl.Mesh(ufl.VectorElement("Lagrange", ufl.Cell("triangle", geometric_dimension=2), 1))
    domain = dolfinx.mesh.create_mesh(mesh.comm, triangles, np.array(mesh.points[:mesh.owned_points]), kind, mode,
                                      partitioner)
    regions = mesh.regions[:mesh.owned_triangles] if len(mesh.regions) else np.ones(len(triangles))
    edges, tags, numbers = named_edges(mesh)
    return Dolfinx(domain, distributed_tags(domain, 2, triangles, regions.astype(np.int32)),
                   distributed_tags(domain, 1, mesh.global_ids[edges], tags),
                   {name: number for number, name in enumerate(mesh.region_names, 1)}, numbers)


def meshio_of(mesh):
    """Returns the meshio.Mesh of a trime_mpi.parallel.Mesh: the triangles and named edges that the rank owns."""
    import meshio
    edges, tags, numbers = named_edges(mesh)
    regions = mesh.regions[:mesh.owned_triangles] if len(mesh.regions) else np.ones(mesh.owned_triangles)
    kinds = {name: np.array([number, 1]) for name, number in numbers.items()}
    kinds |= {name: np.array([number, 2]) for number, name in enumerate(mesh.region_names, 1)}
    return meshio.Mesh(mesh.points, [("triangle", mesh.triangles[:mesh.owned_triangles]), ("line", edges)],
                       point_data={"global_id": mesh.global_ids},
                       cell_data={"gmsh:physical": [regions.astype(np.int32), tags]}, field_data=kinds)
