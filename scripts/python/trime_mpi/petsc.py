# SPDX-License-Identifier: BSD-3-Clause
"""Gives a distributed mesh of trime_mpi.parallel to PETSc in memory, as a DMPlex with labels."""
import dataclasses
import typing

import numpy as np

from .handover import named_edges, refuse_periods

TAG = 7412  # of the messages of this file
REGIONS, FACETS = "Cell Sets", "Face Sets"  # PETSc's own names for labels of cells and edges


@dataclasses.dataclass(frozen=True)
class Petsc:
    """A mesh for PETSc.

    dm is the DMPlex. Each triangle is on the rank that owns it in the mesh, without overlap. The label "Cell Sets"
    holds the number of the region of each cell, from 1. The label "Face Sets" holds a number for each named edge: first
    come the parts of the boundary, then curves inside, then interfaces. Edges that several ranks share have their label
    on all of them. The dicts regions and facets say which name has which number. The array vertex_ids has the global
    ids, in the mesh, of the vertices of this rank, in the order of the DMPlex.
    """
    dm: typing.Any
    regions: dict
    facets: dict
    vertex_ids: np.ndarray

    def find(self, name):
        """Returns the points of the DMPlex that are edges with this name on this rank."""
        points = self._points(FACETS, self.facets[name])
        first, end = self.dm.getDepthStratum(1)
        return points[(points >= first) & (points < end)]  # no vertices, which labelComplete adds

    def find_region(self, name):
        """Returns the points of the DMPlex that are cells of the region with this name on this rank."""
        return self._points(REGIONS, self.regions[name])

    def _points(self, label, number):
        if not self.dm.getStratumSize(label, number):
            return np.zeros(0, np.int32)
        return np.sort(self.dm.getStratumIS(label, number).getIndices())


def exchanged(comm, rows, others):
    """Sends rows[rank] to each of the other ranks, and returns the rows that came from each, by the rank. Collective
    over ranks that are neighbours of each other."""
    sent = [comm.isend(rows[other], int(other), TAG) for other in others]
    received = {other: comm.recv(None, int(other), TAG) for other in others}
    for request in sent:
        request.wait()
    return received


def owners_of_vertices(mesh, vertices):
    """Returns the rank that owns each of these local points in the DMPlex, and its number there. Collective.

    PETSc wants an owner that has a cell at the vertex. This is the owner in the mesh if it has one, otherwise the
    lowest rank that has one. The owner in the mesh decides, since all ranks with a cell at the point know it.
    """
    owned, ids, rank = mesh.owned_points, mesh.global_ids, mesh.comm.rank
    others = [int(other) for other in np.unique(mesh.ghost_owners)]  # each of them has ghosts of this rank, too
    here = mesh.owned_triangles + np.arange(len(vertices))  # in the DMPlex vertices come behind the cells
    owner_in_mesh = np.where(vertices < owned, rank, 0)
    owner_in_mesh[vertices >= owned] = mesh.ghost_owners[vertices[vertices >= owned] - owned]
    asked = {other: np.stack([ids[vertices], here], axis=1)[owner_in_mesh == other] for other in (*others, rank)}
    claims = [np.insert(rows, 2, other, axis=1) for other, rows in (exchanged(mesh.comm, asked, others) | {
        rank: asked[rank]}).items()]
    claims = np.concatenate(claims)  # id, number and rank of all vertices whose owner this rank chooses
    order = np.lexsort([claims[:, 2], claims[:, 2] != rank, claims[:, 0]])
    known, first = np.unique(claims[order, 0], return_index=True)
    chosen = claims[order][first]
    answers = {other: chosen[np.searchsorted(known, claims[claims[:, 2] == other][:, 0])][:, [2, 1]]
               for other in (*others, rank)}
    answers = exchanged(mesh.comm, answers, others) | {rank: answers[rank]}
    found = np.empty((len(vertices), 2), np.int64)
    for other, rows in answers.items():
        found[owner_in_mesh == other] = rows
    return found


def plain_plex(mesh, triangles, vertices):
    """Returns a DMPlex of the cells of this rank with their vertices and without edges. Collective.

    @param triangles: rows of vertices
    @param vertices: local points of the mesh
    """
    from petsc4py import PETSc
    cells, end = len(triangles), len(triangles) + len(vertices)
    dm = PETSc.DMPlex().create(mesh.comm)
    dm.setDimension(2)
    dm.setChart(0, end)
    for cell in range(cells):
        dm.setConeSize(cell, 3)
    dm.setUp()
    for cell, cone in enumerate((triangles + cells).astype(PETSc.IntType)):
        dm.setCone(cell, cone)
    dm.symmetrize()
    dm.stratify()
    dm.setCoordinateDim(2)
    section = dm.getCoordinateSection()
    section.setNumFields(1)
    section.setFieldComponents(0, 2)
    section.setChart(cells, end)
    for vertex in range(cells, end):
        section.setDof(vertex, 2)
        section.setFieldDof(vertex, 0, 2)
    section.setUp()
    dm.setCoordinatesLocal(PETSc.Vec().createWithArray(np.array(mesh.points[vertices]), comm=PETSc.COMM_SELF))
    return dm


def share_vertices(dm, mesh, vertices):
    """Gives the DMPlex the owners of those vertices that other ranks own. Collective."""
    from petsc4py import PETSc
    owners = owners_of_vertices(mesh, vertices)
    away = np.flatnonzero(owners[:, 0] != mesh.comm.rank)
    sf = PETSc.SF().create(mesh.comm)
    sf.setGraph(mesh.owned_triangles + len(vertices), (away + mesh.owned_triangles).astype(PETSc.IntType),
                owners[away].astype(PETSc.IntType))
    dm.setPointSF(sf)


def agreed_numbers(dm, numbers):
    """Gives the points of several ranks the number that one of them has, others 0, in place. Collective."""
    from mpi4py import MPI
    if dm.comm.size == 1:
        return
    sf = dm.getPointSF()
    copy = numbers.copy()
    sf.reduceBegin(MPI.INT32_T, copy, numbers, MPI.MAX)
    sf.reduceEnd(MPI.INT32_T, copy, numbers, MPI.MAX)
    copy = numbers.copy()
    sf.bcastBegin(MPI.INT32_T, copy, numbers, MPI.REPLACE)
    sf.bcastEnd(MPI.INT32_T, copy, numbers, MPI.REPLACE)


def label_edges(dm, mesh, vertices):
    """Labels the named edges, and returns the numbers of the names. Collective."""
    edges, tags, names = named_edges(mesh)
    first_vertex, _ = dm.getDepthStratum(0)
    numbers = np.zeros(dm.getChart()[1], np.int32)
    ends = np.searchsorted(vertices, edges) + first_vertex
    for pair, tag in zip(ends.tolist(), tags.tolist()):
        numbers[dm.getJoin(pair)[0]] = tag  # this rank owns a triangle of an edge that it owns
    agreed_numbers(dm, numbers)
    dm.createLabel(FACETS)
    for point in np.flatnonzero(numbers).tolist():
        dm.setLabelValue(FACETS, point, int(numbers[point]))
    return names


def label_cells(dm, mesh):
    """Labels the cells by their regions."""
    regions = mesh.regions[:mesh.owned_triangles] if len(mesh.regions) else np.ones(mesh.owned_triangles, np.int32)
    dm.createLabel(REGIONS)
    for cell, region in enumerate(regions.tolist()):
        dm.setLabelValue(REGIONS, cell, region)


def petsc_of(mesh):
    """Returns the Petsc of a trime_mpi.parallel.Mesh. Collective."""
    refuse_periods(mesh, "a DMPlex")
    triangles = mesh.triangles[:mesh.owned_triangles]
    vertices = np.unique(triangles)  # local points, ascending
    dm = plain_plex(mesh, np.searchsorted(vertices, triangles), vertices)
    share_vertices(dm, mesh, vertices)
    dm.interpolate()
    label_cells(dm, mesh)
    names = label_edges(dm, mesh, vertices)
    return Petsc(dm, {name: number for number, name in enumerate(mesh.region_names, 1)}, names,
                 mesh.global_ids[vertices])
