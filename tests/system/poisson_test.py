#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Solves -Laplace u = f with linear elements on meshes from the HDF5 file, on the disc and the L-shape.

The error in L2 is of second order, and not larger than on meshes of Gmsh (Frontal-Delaunay, its best algorithm) with as
many vertices. The exact solution is sin(3x) cos(2y), which is smooth at the corner of the L; f and the boundary values
follow from it. The script prints a table if it is started by hand.
"""
import math
import subprocess
import unittest

import h5py
import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import splu

from trime_run import Workspace, run

POINTS = (500, 2000, 8000, 32000)

DISC = """[shape]
geometry = disc
[shape.disc]
type = circle
center = 0.5 0.5
radius = 0.4
"""
DISC_GEO = """SetFactory("Built-in");
Point(1) = {0.5, 0.5, 0, h}; Point(2) = {0.9, 0.5, 0, h}; Point(3) = {0.1, 0.5, 0, h};
Circle(1) = {2, 1, 3}; Circle(2) = {3, 1, 2};
Curve Loop(1) = {1, 2}; Plane Surface(1) = {1};
"""
L_SHAPE = """[shape]
geometry = difference(square, quarter)
[shape.square]
type = rectangle
x_min = 0.1
x_max = 0.9
y_min = 0.1
y_max = 0.9
[shape.quarter]
type = rectangle
x_min = 0.5
x_max = 0.9
y_min = 0.5
y_max = 0.9
"""
L_SHAPE_GEO = """Point(1) = {0.1, 0.1, 0, h}; Point(2) = {0.9, 0.1, 0, h}; Point(3) = {0.9, 0.5, 0, h};
Point(4) = {0.5, 0.5, 0, h}; Point(5) = {0.5, 0.9, 0, h}; Point(6) = {0.1, 0.9, 0, h};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 6}; Line(6) = {6, 1};
Curve Loop(1) = {1, 2, 3, 4, 5, 6}; Plane Surface(1) = {1};
"""
SHAPES = {"disc": (DISC, DISC_GEO, math.pi * 0.16), "L-shape": (L_SHAPE, L_SHAPE_GEO, 0.48)}

# Six points of degree 4 on a triangle (Strang and Fix 1973; Dunavant 1985): barycentric coordinates and weights.
A, B, WEIGHT_A, WEIGHT_B = 0.445948490915965, 0.091576213509771, 0.223381589678011, 0.109951743655322
QUADRATURE = [(weight, np.roll([1 - 2 * a, a, a], k)) for a, weight in ((A, WEIGHT_A), (B, WEIGHT_B)) for k in range(3)]


def exact(p):
    """u at points [..., 2]."""
    return np.sin(3 * p[..., 0]) * np.cos(2 * p[..., 1])


def load(p):
    """f = -Laplace u."""
    return 13 * exact(p)


def error_in_l2(points, triangles, boundary):
    """Solves with the exact values on the vertices `boundary`; the L2 norm of the error over the mesh."""
    corners = points[triangles]
    edges = corners[:, [2, 0, 1]] - corners[:, [1, 2, 0]]  # each opposite to its vertex
    area = 0.5 * (edges[:, 0, 0] * edges[:, 1, 1] - edges[:, 0, 1] * edges[:, 1, 0])
    stiffness = np.einsum("tik,tjk->tij", edges, edges) / (4 * area[:, None, None])
    rows, columns = np.repeat(triangles, 3, axis=1), np.tile(triangles, (1, 3))
    n = len(points)
    matrix = coo_matrix((stiffness.ravel(), (rows.ravel(), columns.ravel())), shape=(n, n)).tocsr()
    shares = sum(weight * area[:, None] * load(np.einsum("i,tik->tk", place, corners))[:, None] * place
                 for weight, place in QUADRATURE)
    right = np.bincount(triangles.ravel(), weights=shares.ravel(), minlength=n)
    u = np.where(boundary, exact(points), 0.0)
    free = np.flatnonzero(~boundary)
    factors = splu(matrix[free][:, free].tocsc(), permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0,
                   options={"SymmetricMode": True})
    u[free] = factors.solve((right - matrix @ u)[free])
    squared = sum(weight * area * (u[triangles] @ place - exact(np.einsum("i,tik->tk", place, corners))) ** 2
                  for weight, place in QUADRATURE)
    return math.sqrt(squared.sum())


def our_mesh(work, config, points):
    """Points, triangles and which points lie on the boundary, from the file."""
    (work / "p.ini").write_text(config, encoding="utf-8")
    done = run(work / "p.ini", f"meshing.points={points}", f"output.directory={work}", "output.overwrite=true",
               threads=2)
    if done.returncode != 0:
        raise AssertionError(done.stdout + done.stderr)
    with h5py.File(work / "p.h5", "r") as file:
        mesh = file["Mesh/mesh/geometry"][:], file["Mesh/mesh/topology"][:]
        on_boundary = np.zeros(len(mesh[0]), bool)
        on_boundary[file["Mesh/facets/topology"][:].ravel()] = True
    return *mesh, on_boundary


def run_gmsh(work, geometry, size):
    """Gmsh's mesh in the same form."""
    (work / "p.geo").write_text(f"h = {size!r};\n{geometry}", encoding="utf-8")
    subprocess.run(["gmsh", "-2", "-v", "1", "-algo", "front2d", "-format", "msh22", "-o", work / "p.msh",
                    work / "p.geo"],
                   check=True, capture_output=True, timeout=60)
    lines = (work / "p.msh").read_text(encoding="ascii").split("\n")
    start = lines.index("$Nodes") + 2
    nodes = np.array([line.split()[1:3] for line in lines[start:start + int(lines[start - 1])]], float)
    start = lines.index("$Elements") + 2
    elements = [line.split() for line in lines[start:start + int(lines[start - 1])]]
    triangles = np.array([e[-3:] for e in elements if e[1] == "2"], int) - 1
    segments = np.array([e[-2:] for e in elements if e[1] == "1"], int) - 1
    used, triangles = np.unique(triangles, return_inverse=True)  # centres of circles are nodes, too
    return nodes[used], triangles.reshape(-1, 3), np.isin(used, segments)


def gmsh_mesh(work, geometry, area, points):
    """The mesh of Gmsh whose number of vertices is nearest to `points`, of a few tries: the number jumps with the
    size."""
    size, best = math.sqrt(area / (0.866 * points)), None
    for detour in (1, 1, 1, 0.99, 1.01, 0.98, 1.02):
        mesh = run_gmsh(work, geometry, size * detour)
        if best is None or abs(len(mesh[0]) - points) < abs(len(best[0]) - points):
            best = mesh
        if abs(len(best[0]) - points) < 0.015 * points:
            break
        if detour == 1:
            size *= math.sqrt(len(mesh[0]) / points)
    return best


class Poisson(unittest.TestCase):
    def compare(self, name):
        config, geometry, area = SHAPES[name]
        ours = []
        with Workspace() as work:
            for points in POINTS:
                mesh = our_mesh(work, config, points)
                n = len(mesh[0])
                ours.append((n, error_in_l2(*mesh)))
                line = f"{name:8} {n:6} vertices, error {ours[-1][1]:.4e}"
                if len(ours) > 1:
                    order = 2 * math.log(ours[-2][1] / ours[-1][1]) / math.log(n / ours[-2][0])
                    line += f", order {order:.3f}"
                    self.assertGreaterEqual(order, 1.9, name)
                theirs = gmsh_mesh(work, geometry, area, n)
                m = len(theirs[0])
                self.assertLess(abs(m - n), 0.03 * n)
                normalised = error_in_l2(*theirs) * m / n  # second order: the error is proportional to 1/n
                line += f"; Gmsh {m:6} vertices, error {normalised:.4e}, ours is {ours[-1][1] / normalised:.4f} of it"
                print(line)
                self.assertLessEqual(ours[-1][1], normalised, name)

    def test_disc(self):
        self.compare("disc")

    def test_l_shape(self):
        self.compare("L-shape")


if __name__ == "__main__":
    unittest.main()
