#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests regions as people use them: units of a geological map, grains, a size for each region, and a solver.

The polygons come from seeds, and those of the map do not quite fit together. The solver computes the temperature around
a disc of another material; the error of linear elements falls with second order if edges follow the interface.
"""
import json
import math
import os
import pathlib
import random
import subprocess
import unittest

import h5py
import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import spsolve
from scipy.spatial import Voronoi

from region_meshes import Mesh, by_number, circle, rectangle, region
from trime_run import PROGRAM, WorkspaceCase, run

CHECK = os.environ.get("TRIME_CHECK", str(pathlib.Path(PROGRAM).parent / "src" / "check" / "trime_check"))
RADIUS, RATIO = 0.3, 10.0  # of the disc, and its conductivity over that of the rest


def feature(unit, ring):
    return {"type": "Feature", "properties": {"unit": unit},
            "geometry": {"type": "Polygon", "coordinates": [[*map(list, ring), list(ring[0])]]}}


def section(seed):
    """Five layers with wavy borders, each digitised twice with an error of 0.3, and a lens on top of two of them."""
    noise = random.Random(seed).uniform
    borders = [[(0.0, 0.0), (1000.0, 0.0)]]
    for base, phase in ((90, 0.2), (180, 1.0), (260, 2.0), (330, 0.3)):
        borders.append([(5.0 * i, base + 25 * math.sin(0.015 * math.pi * i + phase)) for i in range(201)])
    borders.append([(0.0, 400.0), (1000.0, 400.0)])

    def digitised(border):
        return [(x, y + noise(-0.3, 0.3)) for x, y in border] if len(border) > 2 else border

    lens = [(600 + 80 * math.cos(0.1 * math.pi * i), 220 + 14 * math.sin(0.1 * math.pi * i)) for i in range(20)]
    layers = [feature(name, digitised(low) + digitised(high)[::-1])
              for name, low, high in zip(("granite", "gneiss", "sand", "clay", "gravel"), borders, borders[1:])]
    return [feature("ore", lens), *layers]


def grains(count, seed):
    """The Voronoi cells of random points in the unit square."""
    own = np.random.default_rng(seed).random((count, 2))
    mirrored = [own * [sx, sy] + [cx, cy] for sx, sy, cx, cy in
                ((1, 1, 0, 0), (-1, 1, 0, 0), (-1, 1, 2, 0), (1, -1, 0, 0), (1, -1, 0, 2))]
    cells = Voronoi(np.vstack(mirrored))
    return [feature(k + 1, np.round(np.clip(cells.vertices[cells.regions[cells.point_region[k]]], 0, 1), 12).tolist())
            for k in range(count)]


def labels(count, kinds, noise, seed):
    """Labels of count x count cells: patches of about 8 cells with rough borders, and single cells by noise."""
    draw = np.random.default_rng(seed)
    f = np.fft.fftfreq(count)
    low = np.exp(-100 * (f[:, None]**2 + f[None, :]**2))
    fields = [np.real(np.fft.ifft2(np.fft.fft2(draw.normal(size=(count, count))) * low)) for _ in range(kinds)]
    return np.argmax([x / x.std() + noise * draw.normal(size=x.shape) for x in fields], axis=0) + 1


def exact(points):
    """The temperature around the disc in a uniform flow along x."""
    x, y = (points - 0.5).T
    square = np.maximum(x * x + y * y, RADIUS * RADIUS)
    return np.where(x * x + y * y < RADIUS * RADIUS, 2 / (1 + RATIO) * x,
                    x * (1 + (1 - RATIO) / (1 + RATIO) * RADIUS * RADIUS / square))


def error_of(mesh, is_disc):
    """Square root of the integral of (u - exact)^2 for linear elements with the given values on the boundary."""
    p, t = mesh.points, mesh.triangles
    sides = np.stack([p[t[:, (k + 2) % 3]] - p[t[:, (k + 1) % 3]] for k in range(3)], axis=1)
    scale = np.where(is_disc, RATIO, 1.0) / (4 * mesh.areas)
    local = np.einsum("tik,tjk->tij", sides, sides) * scale[:, None, None]
    rows, columns = np.repeat(t, 3, axis=1).ravel(), np.tile(t, 3).ravel()
    matrix = coo_matrix((local.ravel(), (rows, columns)), shape=(len(p), len(p))).tocsr()
    u = exact(p)
    free = np.setdiff1d(np.arange(len(p)), np.unique(mesh.facets))
    held = np.unique(mesh.facets)
    u[free] = spsolve(matrix[free][:, free], -matrix[free][:, held] @ u[held])
    square = 0.0
    for a, b in ((0, 1), (1, 2), (2, 0)):
        middle = 0.5 * (p[t[:, a]] + p[t[:, b]])
        square += math.fsum(mesh.areas / 3 * (0.5 * (u[t[:, a]] + u[t[:, b]]) - exact(middle))**2)
    return math.sqrt(square)


class RegionMaps(WorkspaceCase):
    def mesh(self, text, points, ranks=1, threads=2):
        config = self.directory / "mesh.ini"
        config.write_text(f"{text}[meshing]\npoints = {points}\n"
                          f"[output]\ndirectory = {self.directory}\nname = mesh\noverwrite = true\n")
        done = run(config, ranks=ranks, threads=threads)
        self.report = done.stdout + done.stderr
        self.assertEqual(done.returncode, 0, self.report)
        judged = subprocess.run([CHECK, self.directory / "mesh.h5"], capture_output=True, text=True, check=False)
        self.assertEqual(judged.returncode, 0, judged.stdout + judged.stderr)
        return Mesh(self.directory / "mesh.h5")

    def same_on_three_ranks(self, text, points):
        mesh = self.mesh(text, points)
        for name, array in self.mesh(text, points, ranks=3, threads=1).arrays().items():
            self.assertEqual(array.tobytes(), mesh.arrays()[name].tobytes(), name)
        return mesh

    def write_map(self, features):
        (self.directory / "map.geojson").write_text(json.dumps({"type": "FeatureCollection", "features": features}))

    def test_units_of_a_map(self):
        for seed in (1, 2):
            self.write_map(section(seed))
            mesh = self.same_on_three_ranks(
                "[domain]\nx_min = 0\nx_max = 1000\ny_min = 0\ny_max = 400\n[shape]\ngeometry = domain\n"
                "[region.rock]\nfile = map.geojson\nattribute = unit\n", 5000)
            self.assertIn("smaller or narrower than the triangles", self.report)
            units = ("ore", "granite", "gneiss", "sand", "clay", "gravel")
            self.assertEqual(set(mesh.names.values()), {"domain", *(f"rock.{unit}" for unit in units)})
            self.assertLess(mesh.alpha(), 1.3)
            for name, area, given in zip(*(mesh.table[key] for key in ("region_name", "area", "given_area"))):
                if name != b"domain":  # gaps between the layers
                    self.assertAlmostEqual(area, given, delta=0.02 * given, msg=name)

    def test_features_without_a_value_are_named(self):
        squares = [feature(unit, [(x, 0), (x + 0.25, 0), (x + 0.25, 1), (x, 1)])
                   for unit, x in (("a", 0), (None, 0.25), ("b", 0.5))]
        self.write_map(squares)
        mesh = self.mesh("[shape]\ngeometry = domain\n[region.g]\nfile = map.geojson\nattribute = unit\n", 500)
        self.assertEqual(set(mesh.names.values()), {"domain", "g", "g.a", "g.b"})
        self.assertIn("1 feature has no value of the attribute 'unit', or the value 0, and belongs to 'g'", self.report)
        self.assertIn("(feature 2)", self.report)

    def test_grains(self):
        self.write_map(grains(150, 5))
        mesh = self.same_on_three_ranks(
            "[shape]\ngeometry = domain\n[region.g]\nfile = map.geojson\nattribute = unit\n", 20000)
        self.assertEqual(len(np.unique(mesh.region)), 150)
        self.assertAlmostEqual(math.fsum(mesh.areas), 1, delta=1e-12)
        for name, area, given in zip(*(mesh.table[key] for key in ("region_name", "area", "given_area"))):
            self.assertAlmostEqual(area, given, delta=0.02 * given + 1e-12, msg=name)

    def test_too_few_points_for_the_grains(self):
        self.write_map(grains(150, 5))
        for points in (200, 700, 800, 900):
            config = self.directory / "few.ini"
            config.write_text("[shape]\ngeometry = domain\n[region.g]\nfile = map.geojson\nattribute = unit\n"
                              f"[meshing]\npoints = {points}\n[output]\ndirectory = {self.directory}\nname = few\n"
                              "overwrite = true\n")
            done = run(config)
            self.assertIn(done.returncode, (0, 2, 3), done.stdout + done.stderr)
            if done.returncode:
                self.assertIn("are too few", done.stderr)

    def test_labels_that_are_smaller_than_the_triangles(self):
        checkers = np.indices((64, 64)).sum(axis=0) % 2 + 1
        for cells, points in ((checkers, 500), (labels(64, 4, 0.0, 1), 500), (labels(64, 4, 1.0, 2), 1500),
                              (labels(64, 3, 0.3, 3), 3000)):
            self.write_labels(cells)
            mesh = self.same_on_three_ranks("[shape]\ngeometry = domain\n[region.cover]\nfile = cells.asc\n", points)
            self.assertAlmostEqual(math.fsum(mesh.areas), 1, delta=1e-12)
            self.assertLess(len(mesh.points), 1.01 * points)

    def write_labels(self, cells):
        rows, columns = cells.shape
        (self.directory / "cells.asc").write_text(
            f"ncols {columns}\nnrows {rows}\nxllcorner 0\nyllcorner 0\ncellsize {1 / columns!r}\n"
            + "".join(" ".join(map(str, row)) + "\n" for row in cells))

    def test_squares_of_a_map_that_meet_in_corners(self):
        cells = np.vstack([np.indices((4, 8)).sum(axis=0) % 2 + 1, np.random.default_rng(3).integers(1, 4, (4, 8))])
        self.write_labels(cells)
        raster = self.mesh("[shape]\ngeometry = domain\n[region.c]\nfile = cells.asc\n", 1500)
        x, y = 0.125, 0.125
        self.write_map([feature(label, [(x * k, y * j), (x * k + x, y * j), (x * k + x, y * j + y), (x * k, y * j + y)])
                        for label in (1, 2, 3) for j in range(8) for k in range(8) if cells[7 - j, k] == label])
        polygons = self.same_on_three_ranks(
            "[shape]\ngeometry = domain\n[region.c]\nfile = map.geojson\nattribute = unit\n", 1500)
        self.assertNotIn("moved apart", self.report)
        self.assertEqual(polygons.names, raster.names)
        for name in ("c.1", "c.2", "c.3"):
            self.assertAlmostEqual(polygons.area(name), raster.area(name), delta=1e-12)
        self.assertEqual(polygons.pair_names(), raster.pair_names())
        self.assertAlmostEqual(polygons.length(), raster.length(), delta=1e-12)
        self.assertLess(polygons.alpha(), 1.5)

    def balance(self, mesh):
        """The area of each region in the mesh, with what it lost and without what it gained, minus its given area."""
        with h5py.File(self.directory / "mesh.h5") as file:
            rows = file["/trime_mpi/region_losses"]
            losses = list(zip(rows["loser"][:], rows["winner"][:], rows["area"][:]))
        kept = dict(zip(mesh.table["region_id"], mesh.table["area"] - mesh.table["given_area"]))
        for loser, winner, area in losses:
            kept[loser] += area
            kept[winner] -= area
        return list(kept.values())

    def test_cells_that_are_smaller_than_the_triangles(self):
        text = "[shape]\ngeometry = domain\n[region.cover]\nfile = cells.asc\n"
        for seed, noise in ((11, 0.5), (12, 0.0)):
            self.write_labels(labels(48, 3, noise, seed))
            mesh = self.same_on_three_ranks(text, 400)
            self.assertLess(np.abs(self.balance(mesh)).max(), 1e-9)
            self.assertLess(mesh.alpha(), 3)

        # Two grains that are 1.6 h wide stay, the passage of one cell between them and single cells go.
        cells = np.full((64, 64), 1)
        cells[20:30, 10:20] = cells[20:30, 40:50] = cells[25, 20:40] = 2
        cells[45:60:5, 5:60:5] = 3
        self.write_labels(cells)
        mesh = self.same_on_three_ranks(text, 120)
        self.assertIn("the region 'cover.3', of area 0.00805664, has no triangles", self.report)
        self.assertLess(np.abs(self.balance(mesh)).max(), 1e-9)
        centers = mesh.points[mesh.triangles].mean(axis=1)[:, 0]
        grain = mesh.region == mesh.numbers["cover.2"]
        self.assertFalse((grain & (0.35 < centers) & (centers < 0.6)).any())
        for is_here in (centers < 0.35, centers > 0.6):
            self.assertAlmostEqual(mesh.areas[grain & is_here].sum(), (10 / 64)**2, delta=0.1 * (10 / 64)**2)

    def test_two_versions_of_one_coast(self):
        noise = random.Random(7).uniform
        turns = [2 * math.pi * k / 2000 for k in range(2000)]

        def version():
            radii = [0.3 + 0.05 * math.sin(5 * t) + 0.02 * math.sin(37 * t) + noise(-2e-4, 2e-4) for t in turns]
            return [[0.5 + r * math.cos(t), 0.5 + r * math.sin(t)] for r, t in zip(radii, turns)]

        land, hole = feature("land", version()), version()[::-1]
        sea = feature("sea", [(0.05, 0.05), (0.95, 0.05), (0.95, 0.95), (0.05, 0.95)])
        sea["geometry"]["coordinates"].append([*hole, hole[0]])
        self.write_map([land, sea])
        mesh = self.same_on_three_ranks(
            "[shape]\ngeometry = domain\n[region.g]\nfile = map.geojson\nattribute = unit\n", 3000)
        self.assertEqual(set(mesh.names[k] for k in np.unique(mesh.region)), {"domain", "g.land", "g.sea"})
        self.assertLess(mesh.alpha(), 1.5)

    def test_a_size_for_each_region(self):
        sizing = "[sizing]\nscale = absolute\nmax_size = 0.03\ngradation = 0.2\n"
        text = "[shape]\ngeometry = domain\n" + rectangle("half", (0, 0), (0.5, 1)) + region("left", "half")
        mesh = self.mesh(text + "size = 0.01\n" + sizing, 20000)
        x = mesh.points[mesh.triangles].mean(axis=1)[:, 0]
        wanted = np.minimum(0.03, 0.01 + 0.2 * np.maximum(0, mesh.points[:, 0] - 0.5))
        self.assertLess(np.abs(mesh.size / wanted - 1).max(), 0.035)
        self.assertAlmostEqual(mesh.areas[x < 0.45].mean(), 4.33e-5, delta=0.03 * 4.33e-5)
        self.assertAlmostEqual(mesh.areas[x > 0.65].mean(), 3.90e-4, delta=0.05 * 3.90e-4)
        self.assertAlmostEqual(mesh.length() / len(mesh.edges), 0.01, delta=0.0005)

    def test_second_order_at_an_interface(self):
        disc = circle("disc", RADIUS)
        orders = {}
        for name, text in (("with", disc + region("inside", "disc")), ("without", "")):
            errors = []
            for points in (1000, 4000, 16000):
                mesh = self.mesh("[shape]\ngeometry = domain\n" + text, points)
                middle = mesh.points[mesh.triangles].mean(axis=1) - 0.5
                is_disc = mesh.region == 2 if text else np.hypot(*middle.T) < RADIUS
                errors.append((len(mesh.points), error_of(mesh, is_disc)))
            (coarse, first), *_, (fine, last) = errors
            orders[name] = math.log(first / last) / (0.5 * math.log(fine / coarse))
        self.assertGreater(orders["with"], 1.9, orders)
        self.assertLess(orders["without"], 1.7, orders)

    def test_names_and_numbers(self):
        self.write_map([feature(7, [(0, 0), (0.5, 0), (0.5, 1), (0, 1)]),
                        feature(3, [(0.5, 0), (1, 0), (1, 1), (0.5, 1)])])
        mesh = self.mesh(
            "[shape]\ngeometry = domain\ncover = all\n[region.z]\nfile = map.geojson\nattribute = unit\n", 500)
        self.assertEqual([mesh.names[k] for k in (2, 3)], ["z.7", "z.3"])
        for number, area in by_number(mesh.region, mesh.areas).items():
            self.assertAlmostEqual(area, 0.5, delta=1e-11, msg=number)


if __name__ == "__main__":
    unittest.main()
