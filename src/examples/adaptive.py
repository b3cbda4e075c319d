#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Mesh, solve, estimate, remesh: Laplace's equation around a corner, with dolfinx.  mpirun -n 2 python3 adaptive.py"""
import numpy as np
import ufl
from dolfinx import fem
from mpi4py import MPI
from petsc4py import PETSc
from scipy.spatial import cKDTree
from trime_mpi import parallel

comm, size = MPI.COMM_WORLD, None
corner = parallel.polygon("corner", [(-1, -1), (0, -1), (0, 0), (1, 0), (1, 1), (-1, 1)])
for points in (500, 1000, 2000, 4000):
    made = parallel.mesh(comm, corner, points=points, size=size)
    domain = made.to_dolfinx(ghost_mode="shared_facet")
    V, W = fem.FunctionSpace(domain.mesh, ("CG", 1)), fem.FunctionSpace(domain.mesh, ("DG", 0))
    u, v, w = ufl.TrialFunction(V), ufl.TestFunction(V), ufl.TestFunction(W)
    held = fem.Function(V)
    angle = lambda x: (np.arctan2(x[1], x[0]) + np.pi / 4) % (2 * np.pi) - np.pi / 4  # noqa: E731
    held.interpolate(lambda x: np.hypot(x[0], x[1])**(2 / 3) * np.sin(2 / 3 * angle(x)))
    rim = fem.locate_dofs_topological(V, 1, domain.find("corner"))
    zero = fem.Constant(domain.mesh, PETSc.ScalarType(0))
    solution = fem.petsc.LinearProblem(ufl.inner(ufl.grad(u), ufl.grad(v)) * ufl.dx, zero * v * ufl.dx,
                                       [fem.dirichletbc(held, rim)], petsc_options={"pc_type": "gamg"}).solve()
    h, jump = ufl.CellDiameter(domain.mesh), ufl.jump(ufl.grad(solution), ufl.FacetNormal(domain.mesh))
    squares = fem.petsc.assemble_vector(fem.form(ufl.avg(h) * jump**2 * ufl.avg(w) * ufl.dS))
    squares.ghostUpdate(PETSc.InsertMode.ADD, PETSc.ScatterMode.REVERSE)
    areas = fem.petsc.assemble_vector(fem.form(w * ufl.dx)).array
    energy = comm.allreduce(fem.assemble_scalar(fem.form(ufl.inner(ufl.grad(solution), ufl.grad(solution)) * ufl.dx)))
    estimate = np.sqrt(comm.allreduce(squares.array.sum()))
    if comm.rank == 0:
        print(f"{made.total_points} points: estimate {estimate:.5f}, energy {energy:.6f}, hash {made.hash}", flush=True)
    wanted = np.sqrt(areas) * (np.sqrt(squares.array) / estimate + 1e-4)**-0.5  # equal errors; only ratios count
    places = W.tabulate_dof_coordinates()[:len(areas), :2]
    tree, sizes = cKDTree(np.concatenate(comm.allgather(places))), np.concatenate(comm.allgather(wanted))
    size = lambda p: np.exp(np.log(sizes)[tree.query(p, 4)[1]].mean(axis=1))  # noqa: E731
