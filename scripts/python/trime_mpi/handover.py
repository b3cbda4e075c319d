# SPDX-License-Identifier: BSD-3-Clause
"""Gives a distributed mesh of trime_mpi.parallel to other packages in memory."""
import dataclasses
import typing

import numpy as np

from .errors import ConfigError

TAG = 7411  # of the messages of this file


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


def refuse_periods(mesh, package):
    """Other packages take the coordinates as they are. All ranks find the same."""
    if any(mesh.periods):
        raise ConfigError([f"{package} cannot hold a periodic mesh, found one with the periods {mesh.periods}; use the "
                           "arrays, or write `vtkhdf` or `xdmf`"])


def global_triangles(mesh):
    """Returns the triangles of this rank by global ids of their vertices."""
    return mesh.global_ids[mesh.triangles[:mesh.owned_triangles]]


def named_edges(mesh):
    """Returns the named edges that this rank owns: pairs of local points, numbers of the names, and a dict of these
    numbers. An edge on a curve that is also an interface has the number of the curve."""
    names = [*mesh.facet_names, *mesh.curve_names, *mesh.interface_names]
    numbers = {name: number for number, name in reversed(list(enumerate(names, 1)))}
    first_curve = 1 + len(mesh.facet_names)
    curves = mesh.owned_curve_edges
    # The curve lists its edges, too. Another rank may own them there, where they run in the direction of the curve.
    ties = np.flatnonzero(mesh.interface_curves[:mesh.owned_interfaces] < 0)
    edges = np.concatenate([mesh.facets[:mesh.owned_facets], mesh.curve_edges[:curves], mesh.interfaces[ties]])
    tags = np.concatenate([1 + mesh.facet_parts[:mesh.owned_facets], first_curve + mesh.curve_numbers[:curves],
                           first_curve + len(mesh.curve_names) + mesh.interface_pairs[ties]]).astype(np.int32)
    return edges, tags, numbers


def distributed_tags(domain, dim, entities, values):
    """Returns the tags of dolfinx for entities that are given by global ids of their vertices, on any rank."""
    import dolfinx
    local, found = dolfinx.cpp.io.distribute_entity_data(domain._mesh, dim, entities.astype(np.int64), values)
    domain.topology.create_connectivity(dim, 0)
    domain.topology.create_connectivity(dim, domain.topology.dim)
    lists = dolfinx.cpp.graph.AdjacencyList_int32(local)
    return dolfinx.mesh.meshtags_from_entities(domain, dim, lists, found.astype(np.int32))


def facet_neighbours(mesh):
    """Returns pairs of an owned triangle and a rank that owns a triangle on the other side of one of its edges.
    Collective.

    This rank may not know both triangles of an edge whose ends are ghosts. The rank that owns an end of it does.
    """
    rank, owned = mesh.comm.rank, mesh.owned_points
    owner = np.concatenate([np.full(owned, rank), mesh.ghost_owners])[mesh.triangles[:, 0]]  # that of the lowest vertex
    edges = np.sort(np.concatenate([mesh.triangles[:, [k, (k + 1) % 3]] for k in range(3)]), axis=1)
    order = np.lexsort(edges.T)
    same = np.flatnonzero((edges[order[1:]] == edges[order[:-1]]).all(axis=1))
    first, second = (order[same + side] % len(owner) for side in (0, 1))
    found = np.stack([np.concatenate([first, second]), np.concatenate([second, first])], axis=1)
    found = found[owner[found[:, 0]] != owner[found[:, 1]]]
    rows = np.stack([mesh.triangle_ids[found[:, 0]], owner[found[:, 1]]], axis=1)
    others = np.unique(mesh.ghost_owners)  # if this rank has ghosts of another, so has that one of this rank
    sent = [mesh.comm.isend(rows[owner[found[:, 0]] == other], int(other), TAG) for other in others]
    here = [rows[owner[found[:, 0]] == rank], *(mesh.comm.recv(None, int(other), TAG) for other in others)]
    for request in sent:
        request.wait()
    rows = np.unique(np.concatenate(here), axis=0)
    return np.searchsorted(mesh.triangle_ids[:mesh.owned_triangles], rows[:, 0]), rows[:, 1]


def ranks_of_cells(mesh):
    """Returns the ranks that get each owned triangle, as dolfinx lists them: its owner, then those with a neighbour of
    it. Collective."""
    import dolfinx
    triangles, ranks = facet_neighbours(mesh)
    cells = np.concatenate([np.arange(mesh.owned_triangles), triangles])
    data = np.concatenate([np.full(mesh.owned_triangles, mesh.comm.rank), ranks]).astype(np.int32)
    offsets = np.concatenate([[0], np.cumsum(np.bincount(cells, minlength=mesh.owned_triangles))]).astype(np.int32)
    return dolfinx.cpp.graph.AdjacencyList_int32(data[np.argsort(cells, kind="stable")], offsets)


def dolfinx_of(mesh, ghost_mode):
    """Returns the Dolfinx of a trime_mpi.parallel.Mesh. Collective."""
    import dolfinx
    import ufl
    refuse_periods(mesh, "dolfinx")
    triangles = global_triangles(mesh)
    mode = dolfinx.mesh.GhostMode.__members__[ghost_mode]
    ranks = ranks_of_cells(mesh)  # dolfinx finds shared vertices by the cells that several ranks get
    kind = ufl.Mesh(ufl.VectorElement("Lagrange", ufl.Cell("triangle", geometric_dimension=2), 1))
    domain = dolfinx.mesh.create_mesh(mesh.comm, triangles, np.array(mesh.points[:mesh.owned_points]), kind, mode,
                                      lambda *_: ranks)
    regions = mesh.regions[:mesh.owned_triangles] if len(mesh.regions) else np.ones(len(triangles))
    edges, tags, numbers = named_edges(mesh)
    return Dolfinx(domain, distributed_tags(domain, 2, triangles, regions.astype(np.int32)),
                   distributed_tags(domain, 1, mesh.global_ids[edges], tags),
                   {name: number for number, name in enumerate(mesh.region_names, 1)}, numbers)


def meshio_of(mesh):
    """Returns the meshio.Mesh of a trime_mpi.parallel.Mesh: the triangles and named edges that the rank owns."""
    import meshio
    refuse_periods(mesh, "meshio")
    edges, tags, numbers = named_edges(mesh)
    regions = mesh.regions[:mesh.owned_triangles] if len(mesh.regions) else np.ones(mesh.owned_triangles)
    kinds = {name: np.array([number, 1]) for name, number in numbers.items()}
    kinds |= {f"region {name}" if name in kinds else name: np.array([number, 2])  # as the formats of Gmsh name it
              for number, name in enumerate(mesh.region_names, 1)}
    return meshio.Mesh(mesh.points, [("triangle", mesh.triangles[:mesh.owned_triangles]), ("line", edges)],
                       point_data={"global_id": mesh.global_ids},
                       cell_data={"gmsh:physical": [regions.astype(np.int32), tags]}, field_data=kinds)
