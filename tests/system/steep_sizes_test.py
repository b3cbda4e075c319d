#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests sizes that jump, that have narrow bands, and that grow fast; and sizes that are lengths. The mesh follows them
where triangles can, everywhere in the band, with the same bits on any number of ranks, and trime_check agrees.
"""
import os
import subprocess
import unittest

import h5py
import numpy

from trime_run import ROOT, Workspace, run

SQUARE = ("[shape]\ngeometry = square\n[shape.square]\ntype = rectangle\nx_min = 0\nx_max = 1\ny_min = 0\ny_max = 1\n"
          "[sizing]\ntype = expression\nexpression = 1\n")
CHECK = os.environ.get("TRIME_CHECK", str(ROOT / "build" / "ci" / "src" / "check" / "trime_check"))
LARGEST_ALPHA = 1.65
LONGEST = 1.5  # times the size that is asked for, in each tenth of a band


class Mesh:
    def __init__(self, path):
        with h5py.File(path, "r") as file:
            self.points = file["Mesh/mesh/geometry"][:]
            self.triangles = file["Mesh/mesh/topology"][:]
            self.sizes = file["VTKHDF/PointData/size"][:]
            self.alpha = file["VTKHDF/CellData/alpha"][:].max()
            self.hash = file["trime_mpi"].attrs["mesh_hash"]
        edges = numpy.concatenate([self.triangles[:, [k, (k + 1) % 3]] for k in range(3)])
        self.edges = numpy.unique(numpy.sort(edges, axis=1), axis=0)
        ends = self.points[self.edges]
        self.lengths = numpy.hypot(*(ends[:, 1] - ends[:, 0]).T)
        self.middles = ends.mean(axis=1)

    def growth(self):
        """Change of the size along each edge, per length."""
        sizes = self.sizes[self.edges]
        return numpy.abs(sizes[:, 1] - sizes[:, 0]) / self.lengths


class MeshedSizes(unittest.TestCase):
    def mesh(self, work, *overrides, config=SQUARE, ranks=1, threads=1):
        (work / "size.ini").write_text(config, "ascii")
        done = run(work / "size.ini", *overrides, "--quiet", f"output.directory={work}", "output.overwrite=true",
                   ranks=ranks, threads=threads)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.messages = done.stdout + done.stderr
        return Mesh(work / "size.h5")


class SteepSizes(MeshedSizes):
    def expect_band(self, expression, in_band, key, points=4000):
        """Everywhere in a band of small sizes the edges are as long as the size there."""
        with Workspace() as work:
            mesh = self.mesh(work, f"sizing.expression={expression}", f"meshing.points={points}")
            checked = subprocess.run([CHECK, work / "size.h5"], capture_output=True, text=True, check=False)
            self.assertEqual(checked.returncode, 0, checked.stdout)
        self.assertIn("the size grows by up to", self.messages)
        self.assertLess(mesh.alpha, LARGEST_ALPHA, expression)
        inside = in_band(*mesh.points.T)
        least = numpy.median(mesh.sizes[inside])
        tenth = numpy.clip((10 * key(*mesh.middles.T)).astype(int), 0, 9)
        band = in_band(*mesh.middles.T)
        for k in range(10):
            chosen = band & (tenth == k)
            self.assertTrue(chosen.any(), f"{expression}: no edge in tenth {k} of the band")
            self.assertLess(mesh.lengths[chosen].mean(), LONGEST * least, f"{expression}: tenth {k}")

    def test_narrow_bands_are_meshed_as_fine_as_asked(self):
        for half_width, ratio in ((0.002, 5), (0.002, 50), (0.013, 20), (0.05, 50)):
            self.expect_band(f"abs(y-0.437)<{half_width}?{1 / ratio}:1",
                             lambda x, y, w=half_width: numpy.abs(y - 0.437) < w, lambda x, y: x)

    def test_slanted_bands_and_halves(self):
        self.expect_band("abs(y-0.2-0.37*x)<0.003?0.02:1", lambda x, y: numpy.abs(y - 0.2 - 0.37 * x) < 0.003,
                         lambda x, y: x)
        self.expect_band("x<0.5?0.02:1", lambda x, y: x < 0.49, lambda x, y: y)

    def test_steep_formulas_have_good_triangles(self):
        for expression in ("10^(2*x)", "10^(5*x)", "0.001+abs(x-0.5)", "x<0.5?1:0.03"):
            with Workspace() as work:
                mesh = self.mesh(work, f"sizing.expression={expression}", "meshing.points=10000")
            self.assertLess(mesh.alpha, LARGEST_ALPHA, expression)
            self.assertGreater(len(mesh.points), 9800, expression)

    def test_raw_sizes_are_possible(self):
        with Workspace() as work:
            raw = self.mesh(work, "sizing.expression=10^(2*x)", "meshing.points=1000", "sizing.gradation=none")
            limited = self.mesh(work, "sizing.expression=10^(2*x)", "meshing.points=1000")
            gentle = self.mesh(work, "sizing.expression=1+x", "meshing.points=1000")
            same = self.mesh(work, "sizing.expression=1+x", "meshing.points=1000", "sizing.gradation=none")
        self.assertGreater(raw.sizes.max(), 1.5 * limited.sizes.max())
        self.assertEqual(gentle.hash, same.hash)

    def test_the_mesh_is_the_same_on_any_ranks(self):
        size = ("sizing.expression=abs(x^2+y^2-0.5)<0.004?0.05:1", "meshing.points=6000")
        with Workspace() as work:
            hashes = {self.mesh(work, *size, ranks=ranks, threads=threads).hash
                      for ranks, threads in ((1, 1), (1, 2), (2, 1), (3, 2))}
        self.assertEqual(len(hashes), 1)

    def test_growth_is_at_most_the_gradation(self):
        for gradation in (0.1, 0.2):
            with Workspace() as work:
                mesh = self.mesh(work, "sizing.expression=0.01+5*max(0,hypot2)".replace("hypot2", "abs(x-0.3)+y*y"),
                                 "meshing.points=8000", f"sizing.gradation={gradation}")
            self.assertLess(numpy.quantile(mesh.growth(), 0.99), 1.02 * gradation)


class AbsoluteSizes(MeshedSizes):
    def test_sizes_are_lengths(self):
        config = SQUARE.replace("expression = 1", "expression = 0.01+0.1*x\nscale = absolute")
        with Workspace() as work:
            mesh = self.mesh(work, config=config)
            again = self.mesh(work, config=config, ranks=3)
            checked = subprocess.run([CHECK, work / "size.h5"], capture_output=True, text=True, check=False)
            self.assertEqual(checked.returncode, 0, checked.stdout)
        asked = 0.01 + 0.1 * mesh.middles[:, 0]
        self.assertAlmostEqual((mesh.lengths / asked).mean(), 1, delta=0.05)
        self.assertEqual(mesh.hash, again.hash)

    def test_points_are_a_limit(self):
        config = SQUARE.replace("expression = 1", "expression = 0.02\nscale = absolute")
        with Workspace() as work:
            (work / "size.ini").write_text(config, "ascii")
            for limit in (200, 1000):
                done = run(work / "size.ini", f"meshing.points={limit}", f"output.directory={work / str(limit)}")
                self.assertEqual(done.returncode, 2)
                self.assertRegex(done.stderr, f"points = {limit} is the limit.* take about [23][0-9]{{3}} points")
            self.assertFalse((work / "200").exists())
            dry = run(work / "size.ini", "--dry-run", f"output.directory={work}")
            self.assertRegex(dry.stdout, "about (29|30)[0-9]{2} points")

    def test_absurd_sizes_at_the_boundary_are_refused_at_once(self):
        """Their points would be counted for minutes, or hours."""
        config = SQUARE.replace("expression = 1", "expression = 1\nscale = absolute")
        small = ((r"5e-08, ask for about 8e\+07", "sizing.expression=1e-9+0.1*dist()"),  # raised to 1e-6 of the largest
                 (r"1e-09, ask for about 4e\+09", "sizing.type=uniform", "sizing.max_size=0.1",
                  "sizing.size_at=square 1e-9"))
        with Workspace() as work:
            (work / "size.ini").write_text(config, "ascii")
            for words, *size in small:
                for more, ranks in (([], 2), (["--validate"], 1)):
                    done = run(work / "size.ini", *size, f"output.directory={work / 'new'}", *more, ranks=ranks,
                               timeout=30)
                    self.assertEqual(done.returncode, 2, done.stdout)
                    self.assertRegex(done.stderr, rf"sizes in \[sizing\], down to {words} points on the "
                                                  r"boundary alone, whose length is 4; at most 5e\+07")
                    self.assertFalse((work / "new").exists())

    def test_uniform_and_automatic_sizes(self):
        config = SQUARE.replace("type = expression\nexpression = 1\n", "scale = absolute\nmax_size = 0.03\n")
        with Workspace() as work:
            mesh = self.mesh(work, config=config)
            self.assertAlmostEqual(mesh.lengths.mean(), 0.03, delta=0.001)
            mesh = self.mesh(work, "sizing.type=automatic", "sizing.min_size=0.004", config=config)
        self.assertLess(numpy.quantile(mesh.growth(), 0.99), 0.102)
        self.assertLess(mesh.lengths.min(), 0.005)
        self.assertGreater(mesh.lengths.max(), 0.025)


BAY = ("[shape]\ngeometry = water\n[shape.water]\ntype = contour\nfile = bay.geojson\nattribute = kind\n"
       "[sizing]\nscale = absolute\nmax_size = 2000\ngradation = 0.15\n")
LINE = ('{"type":"Feature","properties":{"kind":"%s"},"geometry":{"type":"LineString","coordinates":%s}}')
COAST = [[0, 0], [0, -8000], [9000, -15000], [26000, -9000], [40000, -8000], [40000, 0]]
SEA = [[40000, 0], [40000, 30000], [0, 30000], [0, 0]]


class BoundarySizes(MeshedSizes):
    def bay(self, *overrides, ranks=1):
        with Workspace() as work:
            features = ",".join((LINE % ("coast", COAST), LINE % ("open sea", SEA)))
            (work / "bay.geojson").write_text('{"type":"FeatureCollection","features":[%s]}' % features, "ascii")
            return self.mesh(work, *overrides, config=BAY, ranks=ranks)

    def test_lengths_at_the_coast_grow_from_there(self):
        mesh = self.bay("sizing.size_at=coast 200")
        coast = (mesh.points[mesh.edges][:, :, 1] <= 0).all(axis=1) & (mesh.sizes[mesh.edges].max(axis=1) < 201)
        self.assertAlmostEqual(numpy.median(mesh.lengths[coast]), 200, delta=10)
        self.assertLess(mesh.growth().max(), 0.153)
        self.assertEqual(mesh.hash, self.bay("sizing.size_at=coast 200", ranks=3).hash)
        by_formula = self.bay("sizing.type=expression", "sizing.expression=min(2000,200+0.15*dist(coast))")
        self.assertEqual(mesh.hash, by_formula.hash)


if __name__ == "__main__":
    unittest.main()
