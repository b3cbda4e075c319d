#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs on the ranks of python_parallel_test.py: makes meshes in place, and prints what rank 0 has found as JSON."""
import gc
import json
import pathlib
import sys

import h5py
import numpy as np
from mpi4py import MPI
from trime_mpi import ConfigError, GeometryError, parallel

comm = MPI.COMM_WORLD
PLATE = parallel.rectangle("plate", (0, 0), (2, 1)) - parallel.circle("hole", (1, 0.5), 0.2)
SIZES = {"a": "1 + 3*x", "b": "3 - x"}
MOVED = parallel.rectangle("plate", (0, 0), (2, 1)) - parallel.circle("hole", (1.03, 0.5), 0.2)


def holes(p):
    """A size that NumPy computes with the bits of the formula of the config."""
    return 1 + 3 * p[:, 0] * p[:, 0] + p[:, 1]


def smooth_size(calls):
    """A size of exponentials and roots, whose calls are listed: NumPy computes them by vector instructions."""
    def size(p):
        calls.append(len(p))
        return 0.2 + np.exp(-np.hypot(p[:, 0] - 0.3, p[:, 1])) + 0.1 * np.sin(3 * p[:, 0])**2
    return size


def agreed(condition):
    """Is it true on all ranks?"""
    return bool(comm.allreduce(bool(condition), MPI.LAND))


def check_arrays(mesh):
    """What must hold of the arrays, by name."""
    points, triangles, owned = mesh.points, mesh.triangles, mesh.owned_points
    a, b, c = (points[triangles[:mesh.owned_triangles, k]] for k in range(3))
    areas = 0.5 * ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0])
    values = np.stack([np.sin(points[:, 0]), points[:, 1]], axis=1)
    expected = values.copy()
    values[owned:] = -7
    mesh.update_ghosts(values)
    ones = np.ones(len(points))
    mesh.add_to_owners(ones)
    hole = mesh.facets[mesh.facets_of("hole")]
    return {
        "area": abs(comm.allreduce(areas.sum()) - (2 - np.pi * 0.04)) < 1e-3,
        "counts": comm.allreduce(owned) == mesh.total_points and comm.allreduce(mesh.owned_triangles) ==
        mesh.total_triangles,
        "ids": list(mesh.global_ids[:owned]) == list(range(mesh.first_point, mesh.first_point + owned)) and
        list(mesh.global_ids[owned:]) == list(mesh.ghost_ids),
        "owners": len(mesh.ghost_owners) == len(mesh.ghost_ids) and comm.rank not in mesh.ghost_owners,
        "views": not (points.flags.owndata or points.flags.writeable) and triangles.dtype == np.int32,
        "ghosts": np.array_equal(values, expected),
        "sums": comm.allreduce(ones[:owned].sum()) == comm.allreduce(len(points)),
        "hole": np.allclose(np.hypot(*(points[hole] - [1, 0.5]).reshape(-1, 2).T), 0.2, atol=1e-3),
    }


def check_cells(mesh):
    """What must hold of the Voronoi cells, by name."""
    cells, owned = mesh.cells(), mesh.owned_points
    triangles = mesh.triangles[:mesh.owned_triangles]
    sides = mesh.points[triangles[:, 1:]] - mesh.points[triangles[:, :1]]
    area = comm.allreduce(0.5 * np.cross(sides[:, 0], sides[:, 1]).sum())
    areas = cells.areas.copy()
    areas[owned:] = -1
    mesh.update_ghosts(areas)
    x, y = cells.polygon(0).T
    first = 0.5 * (x @ np.roll(y, -1) - y @ np.roll(x, -1))
    edges = comm.allreduce(cells.owned_faces)
    rows = np.repeat(np.arange(owned), np.diff(cells.neighbour_first))
    pairs = np.sort(mesh.global_ids[cells.faces[cells.neighbour_faces]], axis=1)
    return {
        "cell areas": abs(comm.allreduce(cells.areas[:owned].sum()) - area) < 1e-12 * area,
        "cell ghosts": np.array_equal(areas, cells.areas),
        "cell polygon": abs(first - cells.areas[0]) < 1e-9 * first,
        "cell Euler": mesh.total_points - edges + mesh.total_triangles == 0,  # one hole
        "cell faces": np.array_equal(pairs, np.sort(mesh.global_ids[np.stack([rows, cells.neighbours], 1)], axis=1)),
        "cell lengths": cells.face_lengths.min() > -1e-15 and cells.face_lengths.shape == cells.faces.shape,
        "cell views": not (cells.areas.flags.owndata or cells.areas.flags.writeable) and cells.owned_cells == owned,
        "cell chords": len(cells.chord_cells) == 2 * (mesh.boundary[:owned] != 0).sum(),
    }


def area_of(mesh):
    """The area of all triangles."""
    a, b, c = (mesh.points[mesh.triangles[:mesh.owned_triangles, k]] for k in range(3))
    return comm.allreduce(0.5 * ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]).sum())


def check_petsc(mesh):
    """What must hold of the DMPlex, by name: counts, area, labels on all ranks."""
    handed = mesh.to_petsc()
    dm = handed.dm
    away = np.zeros(0, int)
    if comm.size > 1:
        _, local, remote = dm.getPointSF().getGraph()
        away = np.arange(len(remote)) if local is None else local

    def count(points):
        return comm.allreduce(len(np.setdiff1d(points, away)))

    vertices, edges, cells = (np.arange(*dm.getDepthStratum(depth)) for depth in (0, 1, 2))
    section, places = dm.getCoordinateSection(), dm.getCoordinatesLocal().getArray().reshape(-1, 2)
    rows = [section.getOffset(vertex) // 2 for vertex in vertices]
    order = np.argsort(mesh.global_ids)
    given = mesh.points[order[np.searchsorted(mesh.global_ids[order], handed.vertex_ids)]]
    area = comm.allreduce(sum(dm.computeCellGeometryFVM(cell)[0] for cell in cells))
    found = {"PETSc counts": (count(vertices), count(cells)) == (mesh.total_points, mesh.total_triangles),
             "PETSc Euler": count(vertices) - count(edges) + count(cells) == 0,  # one hole
             "PETSc places": np.array_equal(places[rows], given),
             "PETSc area": abs(area - area_of(mesh)) < 1e-12}
    for name in ("plate", "hole"):
        number, owned = mesh.facet_names.index(name), mesh.facet_parts[:mesh.owned_facets]
        found[f"PETSc {name}"] = count(handed.find(name)) == comm.allreduce((owned == number).sum())
    regions = mesh.regions[:mesh.owned_triangles]
    found["PETSc region"] = len(handed.find_region("west")) == (regions == mesh.region_names.index("west") + 1).sum()
    interface = mesh.interface_names[0]
    found["PETSc interface"] = count(handed.find(interface)) == comm.allreduce(mesh.owned_interfaces)
    sides = comm.allreduce(sum(dm.getSupportSize(edge) for edge in handed.find(interface)))
    found["PETSc sides"] = sides == 2 * comm.allreduce(mesh.owned_interfaces)  # both sides, on one rank or on two
    edges_before = handed.find("hole")
    dm.labelComplete(dm.getLabel("Face Sets"))
    found["PETSc complete"] = np.array_equal(handed.find("hole"), edges_before)
    cells = dm.getHeightStratum(0)[1]
    if comm.size > 1:  # petsc4py crashes on one rank, where PETSc has nothing to do
        dm.distributeOverlap(1)
        found["PETSc overlap"] = dm.getHeightStratum(0)[1] > cells
    return found


def named_counts(line):
    """The number of edges with each name in each package, if a curve runs along a part of an interface."""
    west = parallel.Region("west", parallel.rectangle("west", (0, 0), (0.5, 1)))
    square = parallel.rectangle("square", (0, 0), (1, 1))
    mesh = parallel.mesh(comm, square, points=600, regions=[west], curves=[parallel.curve("wall", line)])
    handed = mesh.to_petsc()
    away = np.zeros(0, int)
    if comm.size > 1:
        _, local, remote = handed.dm.getPointSF().getGraph()
        away = np.arange(len(remote)) if local is None else local
    by_meshio = mesh.to_meshio().cell_data_dict["gmsh:physical"]["line"]
    by_dolfinx = mesh.to_dolfinx()
    owned = by_dolfinx.mesh.topology.index_map(1).size_local
    return {name: [comm.allreduce(int(count)) for count in
                   (len(np.setdiff1d(handed.find(name), away)), (by_meshio == handed.facets[name]).sum(),
                    (by_dolfinx.find(name) < owned).sum())] for name in handed.facets}


def check_lifetime():
    """Do arrays keep the memory that they show?"""
    points = parallel.mesh(comm, PLATE, points=300).points
    before = points.copy()
    gc.collect()
    parallel.mesh(comm, PLATE, points=310)
    return np.array_equal(points, before)


def failing(last):
    """A size that fails on the last rank, or everywhere."""
    def size(p):
        if not last or comm.rank == comm.size - 1:
            raise ZeroDivisionError("a fault of the user")
        return holes(p)
    return size


def error_of(**options):
    """The exception of a mesh: its type and text on rank 0, and the type of the cause on the last rank."""
    try:
        parallel.mesh(comm, PLATE, **{"points": 300, **options})
    except (ConfigError, GeometryError) as error:
        kinds = comm.allgather((type(error).__name__, str(error), type(error.__cause__).__name__))
        return [*kinds[0][:2], kinds[-1][2], len({kind[0] for kind in kinds})]
    return None


def alone(**options):
    """The kinds of exceptions on all ranks if the last one is given other options."""
    try:
        parallel.mesh(comm, PLATE, points=300, **(options if comm.rank == comm.size - 1 else {}))
    except (ConfigError, TypeError) as error:
        return comm.allgather(type(error).__name__)
    return None


def poisson(points):
    """The L2 error of a solution with sources and a value on a part of the boundary, and what the tags say."""
    import ufl
    from dolfinx import fem
    from petsc4py import PETSc
    copper = parallel.Region("copper", parallel.rectangle("end", (0.5, 0), (1, 1)))
    square = parallel.rectangle("square", (0, 0), (1, 1))
    domain = parallel.mesh(comm, square, points=points, regions=[copper], rest="iron").to_dolfinx()
    space = fem.FunctionSpace(domain.mesh, ("CG", 1))
    x = ufl.SpatialCoordinate(domain.mesh)
    exact = ufl.sin(np.pi * x[0]) * ufl.sin(np.pi * x[1])
    u, v = ufl.TrialFunction(space), ufl.TestFunction(space)
    held = fem.dirichletbc(PETSc.ScalarType(0), fem.locate_dofs_topological(space, 1, domain.find("square")), space)
    found = fem.petsc.LinearProblem(ufl.inner(ufl.grad(u), ufl.grad(v)) * ufl.dx, 2 * np.pi**2 * exact * v * ufl.dx,
                                    [held], petsc_options={"ksp_type": "cg", "ksp_rtol": 1e-10}).solve()

    def total(form):
        return comm.allreduce(fem.assemble_scalar(fem.form(form)))

    one, names = fem.Constant(domain.mesh, PETSc.ScalarType(1)), domain.facets
    cells = ufl.Measure("dx", domain.mesh, subdomain_data=domain.cell_tags)
    outer = ufl.Measure("ds", domain.mesh, subdomain_data=domain.facet_tags)
    owned = domain.mesh.topology.index_map(1).size_local
    return {"error": np.sqrt(total((found - exact)**2 * ufl.dx)),
            "copper": total(one * cells(domain.regions["copper"])), "rim": total(one * outer(names["square"])),
            "between": comm.allreduce(int((domain.find("iron|copper") < owned).sum()))}


def check_cells_in_files(mesh, directory):
    """What must hold of files with cells, by name; the file NAME.h5 remains."""
    path = directory / f"plain{comm.size}.h5"
    mesh.write(path, voronoi=True)
    mesh.write(directory / f"plain{comm.size}.uge", cells="triangles")
    cells = mesh.cells()
    with h5py.File(path) as file:
        first = mesh.first_point
        areas = file["Cells/areas"][first:first + mesh.owned_points]
    head = (directory / f"plain{comm.size}.uge").read_text().splitlines()[0]
    return {"cells_in_file": np.array_equal(areas, cells.areas[:mesh.owned_points]),
            "triangles_as_cells": head == f"CELLS {mesh.total_triangles}"}


def main(directory):
    """Prints all findings."""
    found = {"ranks": comm.size}
    plain = parallel.mesh(comm, PLATE, points=2000)
    found["uniform"] = plain.hash
    found["arrays"] = {name: agreed(holds) for name, holds in check_arrays(plain).items()}
    found["arrays"] |= {name: agreed(holds) for name, holds in check_cells(plain).items()}
    found["arrays"]["lifetime"] = agreed(check_lifetime())
    found["arrays"] |= {name: agreed(holds) for name, holds in check_cells_in_files(plain, directory).items()}
    moved = [parallel.mesh(comm, MOVED, points=2000, start=old) for old in (plain, directory / f"plain{comm.size}.h5")]
    found["start"] = [mesh.hash for mesh in moved]
    found["start_alpha"] = moved[0].quality["alpha_max"]
    west = parallel.Region("west", parallel.rectangle("west", (0, 0), (0.7, 1)))
    divided = parallel.mesh(comm, PLATE, points=600, regions=[west])
    found["arrays"] |= {name: agreed(holds) for name, holds in check_petsc(divided).items()}
    wall = [(0.5, 0.3), (0.5, 1)]
    found["named"] = [named_counts(line) for line in (wall, wall[::-1])]
    smallest = parallel.mesh(comm, PLATE, points=2000, accept=["fvcom", "mpas"], split_ears=True,
                             size={"wave": "1 + 3*x", "coast": lambda p: 5 - 2 * p[:, 0]})
    found["smallest"], found["shares"] = smallest.hash, smallest.size_shares
    found["verdicts"] = [(v.solver, v.rule, v.limit, v.worst, v.broken, v.measured, v.refuses) for v in
                         smallest.verdicts]
    smallest.write(directory / f"smallest{comm.size}.h5")
    found["read_verdicts"] = parallel.read(comm, directory / f"smallest{comm.size}.h5").verdicts == smallest.verdicts
    found["formula"] = parallel.mesh(comm, PLATE, points=2000, size="1 + 3*x*x + y").hash
    graded = parallel.mesh(comm, PLATE, points=2000, size=holes)
    found["callable"] = graded.hash
    calls = []
    found["smooth"] = parallel.mesh(comm, PLATE, points=20000, size=smooth_size(calls)).hash
    found["calls"], found["places"] = comm.allreduce(len(calls)), comm.allreduce(sum(calls))
    found["checks"] = all(check.passed for check in graded.checks) and graded.quality["alpha_median"] < 1.1
    found["automatic"] = parallel.mesh(comm, PLATE, points=2000, size=parallel.automatic(0.1)).hash
    graded.write(directory / f"graded{comm.size}.h5")
    found["read"] = parallel.read(comm, directory / f"graded{comm.size}.h5").hash
    found["failed"] = error_of(size=failing(last=True))
    found["wrong"] = error_of(size=lambda p: np.ones(len(p) + 1))
    found["negative"] = error_of(size=lambda p: p[:, 0] - 1)
    found["formula_error"] = error_of(size="1 + z")
    found["no_count"] = error_of(points=None)
    found["no_model"] = error_of(accept=["fvcon"])
    found["one_size_fails"] = error_of(size={"a": "1 + x", "b": failing(last=True)})
    found["other_order"] = error_of(size=dict(reversed(SIZES.items()) if comm.rank else SIZES.items()))
    found["other_name"] = error_of(size={"a a" if comm.rank else "a": "1 + x"})
    found["alone"] = [alone(nonsense=1), alone(size=3), alone(regions=5)]
    found["unknown_part"] = error_of(open_boundary=["hol"])
    lines = plain.to_meshio().cells_dict["line"]
    found["meshio"] = comm.allreduce(len(lines)) == comm.allreduce(plain.owned_facets)
    if comm.size == 2:
        found["poisson"] = [poisson(points) for points in (1000, 4000)]
    if comm.rank == 0:
        print(json.dumps(found, default=str))


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]))
