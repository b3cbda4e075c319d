# SPDX-License-Identifier: BSD-3-Clause
"""Tests that waters which are connected stay connected, and that lands which are separate stay separate, however narrow
the channels and dams between them are; and that the first line of a warning says what did change.
"""
import re
import unittest

import h5py
import numpy

from topology_maps import MAKERS, make_map
from trime_run import Workspace, run

SIZES = {"uniform": [], "automatic": ["sizing.type=automatic", "sizing.gradation=0.2"],
         "expression": ["sizing.type=expression", "sizing.expression=1+0.1*abs(x)"]}
RESOLUTION = 1.3  # a body with a smaller radius, in units of h, is below the resolution


class Mesh:
    """The triangles of a file, and the connected components of these."""

    def __init__(self, path):
        with h5py.File(path, "r") as file:
            self.points = file["Mesh/mesh/geometry"][:]
            self.triangles = file["Mesh/mesh/topology"][:]
            self.attributes = dict(file["trime_mpi"].attrs)
            self.facets, self.asked = file["Mesh/facets/topology"][:], file["Mesh/facets/asked_size"][:]
        self.points = self.points[:, :2]
        self.component = self.components()

    def components(self):
        parent = list(range(len(self.points)))

        def root(k):
            while parent[k] != k:
                parent[k] = parent[parent[k]]
                k = parent[k]
            return k

        for a, b, c in self.triangles:
            parent[root(a)] = root(b)
            parent[root(b)] = root(c)
        return numpy.array([root(a) for a, _, _ in self.triangles])

    def at(self, x, y):
        """The triangle that holds a place, or None."""
        a, b, c = (self.points[self.triangles[:, k]] for k in range(3))
        p = numpy.array([x, y])

        def side(u, v):
            return (v[:, 0] - u[:, 0]) * (p[1] - u[:, 1]) - (v[:, 1] - u[:, 1]) * (p[0] - u[:, 0])

        found = numpy.nonzero((side(a, b) >= 0) & (side(b, c) >= 0) & (side(c, a) >= 0))[0]
        return found[0] if len(found) else None

    def h_near(self, x, y, radius):
        """The h for which the boundary around a body was simplified."""
        centers = self.points[self.facets].mean(axis=1)
        near = numpy.hypot(centers[:, 0] - x, centers[:, 1] - y) < 1.3 * radius
        return self.attributes["coarseness"] * (self.asked[near] if near.any() else self.asked).max()

    @property
    def holes(self):
        edges = numpy.sort(numpy.concatenate([self.triangles[:, [k, (k + 1) % 3]] for k in range(3)]), axis=1)
        euler = len(self.points) - len(numpy.unique(edges, axis=0)) + len(self.triangles)
        return len(numpy.unique(self.component)) - euler


class Topology(unittest.TestCase):
    def mesh(self, work, config, *overrides):
        """The mesh and the warnings; None if the points are too few for any boundary of the shape."""
        done = run(config, *overrides, f"output.directory={work}", "output.overwrite=true", "--quiet")
        if done.returncode == 2 and "are too few for this shape" in done.stderr:
            return None
        self.assertEqual(done.returncode, 0, f"{overrides}\n{done.stdout}{done.stderr}")
        return Mesh(work / f"{config.stem}.h5"), [line for line in done.stdout.splitlines() if "warning: " in line]

    def judge(self, m, mesh, says):
        """Bodies above the resolution are there, connected as they were; islands are there and separate."""
        of_component = {}
        for x, y, radius, component in m.bodies:
            if radius < RESOLUTION * mesh.h_near(x, y, radius):
                continue
            triangle = mesh.at(x, y)
            self.assertIsNotNone(triangle, f"body at {x}, {y}\n{says}")
            of_component.setdefault(component, set()).add(mesh.component[triangle])
        for component, found in of_component.items():
            self.assertEqual(len(found), 1, f"component {component} fell apart\n{says}")
        self.assertEqual(len(set().union(*of_component.values()) if of_component else ()), len(of_component),
                         f"waters were joined\n{says}")
        large = [island for island in m.islands if island[2] > RESOLUTION * mesh.h_near(*island)]
        for x, y, _ in large:
            self.assertIsNone(mesh.at(x, y), f"island at {x}, {y}\n{says}")
        self.assertGreaterEqual(mesh.holes, len(large), says)
        made = (len(numpy.unique(mesh.component)), mesh.holes)
        given = (mesh.attributes["given_components"], mesh.attributes["given_holes"])
        self.assertEqual(made, (mesh.attributes["components"], mesh.attributes["holes"]))
        self.assertLessEqual(made[0], given[0], says)
        first = "".join(says)
        for name, then, now in (("component", given[0], made[0]), ("hole", given[1], made[1])):
            self.assertEqual(now != then, re.search(rf"{then} {name}s? became {now}\b", first) is not None, says)

    def test_what_is_connected_stays_connected(self):
        for maker in MAKERS:
            m = make_map(maker)
            with Workspace() as work:
                config = m.write(work, maker.__name__)
                for size, keys in SIZES.items():
                    for share in (0.1, 0.5, 3, 20) if size == "uniform" else (0.1, 0.5, 3):
                        points = max(20, round(share * m.vertices))
                        with self.subTest(map=maker.__name__, size=size, points=points):
                            made = self.mesh(work, config, f"meshing.points={points}", *keys)
                            self.assertTrue(made or share < 0.5, "too few points")
                            if made:
                                self.judge(m, *made)


if __name__ == "__main__":
    unittest.main()
