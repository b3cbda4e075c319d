#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests sizes from data: ESRI ASCII grids and NetCDF-4 files whose values are variables of the formula of the size."""
import unittest

import h5py
import numpy

from check_test import check
from trime_run import Workspace, run

CONFIG = """[shape]
geometry = square
[shape.square]
type = rectangle
x_min = 0
x_max = 1
y_min = 0
y_max = 1
[field.h]
file = {file}
[sizing]
type = expression
expression = h
gradation = {gradation}
"""
ROW = [0.02, 0.024, 0.028, 0.032, 0.036, 0.04]


def write_ascii(path, values, corner=(-0.1, -0.1), cell=0.2):
    """The rows of `values` ascend from the south."""
    head = (f"ncols {len(values[0])}\nnrows {len(values)}\nxllcorner {corner[0]}\nyllcorner {corner[1]}\n"
            f"cellsize {cell}\nNODATA_value -9999\n")
    path.write_text(head + "".join(" ".join(f"{float(v)!r}" for v in row) + "\n" for row in reversed(values)), "ascii")


def write_netcdf(path, values, x, y, dtype="f8", **attributes):
    with h5py.File(path, "w") as file:
        data = file.create_dataset("elevation", data=numpy.asarray(values, dtype))
        for number, (name, at) in enumerate((("lat", y), ("lon", x))):
            scale = file.create_dataset(name, data=numpy.asarray(at, "f8"))
            scale.make_scale(name)
            data.dims[number].attach_scale(scale)
        data.attrs.update(attributes)


class Fields(unittest.TestCase):
    def run_mesh(self, work, file, *overrides, gradation=0.1, ranks=1):
        (work / "f.ini").write_text(CONFIG.format(file=file, gradation=gradation), "ascii")
        return run(work / "f.ini", *overrides, "--quiet", f"output.directory={work}", "output.overwrite=true",
                   ranks=ranks)

    def mesh(self, work, file, *overrides, **keys):
        done = self.run_mesh(work, file, *overrides, **keys)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        with h5py.File(work / "f.h5") as mesh:
            points, triangles = mesh["Mesh/mesh/geometry"][:], mesh["Mesh/mesh/topology"][:]
            edges = numpy.unique(numpy.sort(numpy.concatenate(
                [triangles[:, [k, (k + 1) % 3]] for k in range(3)]), axis=1), axis=0)
            return (points, edges, mesh["VTKHDF/PointData/size"][:], mesh["VTKHDF/CellData/alpha"][:].max(),
                    mesh["trime_mpi"].attrs["mesh_hash"])

    def refuse(self, work, file, *words, overrides=(), ranks=2):
        done = self.run_mesh(work, file, *overrides, ranks=ranks)
        self.assertIn(done.returncode, (2, 3, 4), done.stdout + done.stderr)
        for word in words:
            self.assertIn(word, done.stdout + done.stderr)

    def test_linear_raster(self):
        with Workspace() as work:
            write_ascii(work / "h.asc", [ROW] * 6)
            points, edges, sizes, _, of_one = self.mesh(work, "h.asc")
            numpy.testing.assert_allclose(sizes, 0.02 + 0.02 * points[:, 0], rtol=1e-5)
            ends = points[edges]
            ratio = numpy.hypot(*(ends[:, 1] - ends[:, 0]).T) / (0.02 + 0.02 * ends.mean(axis=1)[:, 0])
            self.assertAlmostEqual(ratio.mean(), 1, delta=0.03)
            self.assertLess(ratio.std(), 0.075)  # 0.0725 when this test was written
            self.assertAlmostEqual(len(points), 1515, delta=61)
            for ranks in (2, 3):
                self.assertEqual(self.mesh(work, "h.asc", ranks=ranks)[4], of_one)
            at = 0.2 * numpy.arange(6)
            write_netcdf(work / "up.nc", [ROW] * 6, at, at)
            self.assertEqual(self.mesh(work, "up.nc", ranks=2)[4], of_one)
            write_netcdf(work / "down.nc", numpy.full((6, 6), 0.0) + ROW[::-1], at[::-1], at[::-1])
            sizes = self.mesh(work, "down.nc")[2]
            self.assertAlmostEqual(sizes.min(), 0.02, delta=1e-6)

    def test_step(self):
        with Workspace() as work:
            x = numpy.arange(65) / 64
            write_ascii(work / "h.asc", [numpy.where(x <= 0.25, 0.01, 0.08)] * 65, (-1 / 128, -1 / 128), 1 / 64)
            points, edges, sizes, alpha, _ = self.mesh(work, "h.asc", gradation=0.2)
            wanted = numpy.minimum(0.08, 0.01 + 0.2 * numpy.maximum(0, points[:, 0] - 0.25))
            # The limiter lets sizes grow by a little less than the gradation.
            numpy.testing.assert_allclose(sizes, wanted, rtol=0.05)
            ends = points[edges]
            lengths = numpy.hypot(*(ends[:, 1] - ends[:, 0]).T)
            self.assertTrue((numpy.abs(numpy.diff(sizes[edges], axis=1)[:, 0]) <= 0.21 * lengths).all())
            self.assertLessEqual(alpha, 1.25)

    def test_missing_values(self):
        with Workspace() as work:
            values = [list(ROW) for _ in range(6)]
            values[3][2] = -9999
            write_ascii(work / "h.asc", values)
            self.refuse(work, "h.asc", "no data in 1 of the cells", "row 3, column 3", "fill = nearest")
            self.mesh(work, "h.asc", "field.h.fill=nearest")
            sizes = self.mesh(work, "h.asc", "field.h.fill=0.015")[2]
            self.assertLess(sizes.min(), 0.02)
            at = 0.2 * numpy.arange(6)
            counts = numpy.rint(numpy.asarray(values) * 1000).astype("i2")
            counts[3][2] = -1
            write_netcdf(work / "i.nc", counts, at, at, "i2", scale_factor=0.001, _FillValue=numpy.int16(-1))
            self.refuse(work, "i.nc", "row 4, column 3")
            self.mesh(work, "i.nc", "field.h.fill=nearest")
            counts[3][2] = -32767  # what the NetCDF library leaves in a cell that nobody has written
            write_netcdf(work / "unwritten.nc", counts, at, at, "i2", scale_factor=0.001)
            self.refuse(work, "unwritten.nc", "row 4, column 3")

    def test_slopes_of_smooth_data(self):
        """The slope of noisy data makes noisy sizes, that of the smoothed data does not; the same on all ranks."""
        with Workspace() as work:
            x = numpy.arange(81) / 50 - 0.3
            noise = numpy.where(numpy.add.outer(numpy.arange(81), numpy.arange(81)) % 2, 0.004, -0.004)
            write_ascii(work / "h.asc", 0.5 * x + noise, (-0.31, -0.31), 0.02)
            formula = "sizing.expression=0.03*max(0.5, grad(h)/0.5)"
            hashes = set()
            for ranks in (1, 2, 3):
                _, _, sizes, alpha, found = self.mesh(work, "h.asc", formula, "field.h.smooth=0.15", ranks=ranks)
                numpy.testing.assert_allclose(sizes, 0.03, rtol=0.02)
                self.assertLess(alpha, 1.2)
                hashes.add(found)
            self.assertEqual(len(hashes), 1)
            sizes = self.mesh(work, "h.asc", formula)[2]
            self.assertLess(sizes.mean(), 0.02)
            self.refuse(work, "h.asc", "smooth", overrides=["field.h.smooth=-1"])
            self.refuse(work, "h.asc", "'smooth' of at most 1000 cells", "1250 cells", "-outsize 80% 80%",
                        overrides=[formula, "field.h.smooth=25"])
            done = self.run_mesh(work, "h.asc", formula, "field.h.smooth=0.01", "--validate", ranks=2)
            self.assertIn("'smooth = 0.01' in [field.h] has no effect", done.stdout)
            self.assertIn("the cells of the raster, which are 0.02 x 0.02", done.stdout)
            done = self.run_mesh(work, "h.asc", formula, "field.h.smooth=0.15", "--validate")
            self.assertNotIn("no effect", done.stdout)

    def test_several_sizes(self):
        """At each place the smallest one of all sizes counts."""
        with Workspace() as work:
            write_ascii(work / "h.asc", [ROW] * 6)
            more = "[size.left]\nexpression = 0.03 - 0.01*x\n[size.fine]\nexpression = 0.05*h/h\n"
            (work / "s.ini").write_text(CONFIG.format(file="h.asc", gradation=0.1) + more, "ascii")

            def mesh(*overrides, ranks=1):
                done = run(work / "s.ini", f"output.directory={work}", "output.overwrite=true", *overrides, ranks=ranks)
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                with h5py.File(work / "s.h5") as file:
                    return (done.stdout, file["Mesh/mesh/geometry"][:][:, 0], file["VTKHDF/PointData/size"][:],
                            file["trime_mpi"].attrs["mesh_hash"])

            said, x, sizes, of_one = mesh()
            wanted = numpy.minimum(0.02 + 0.02 * x, 0.03 - 0.01 * x)
            numpy.testing.assert_allclose(sizes, wanted, rtol=1e-3)
            share = 100 * numpy.mean(0.02 + 0.02 * x <= 0.03 - 0.01 * x)
            found = float(said.split("[sizing] ")[1].split(" %")[0])
            self.assertAlmostEqual(found, share, delta=0.6)
            self.assertIn("[size.fine] 0 % of the points", said)
            for ranks in (2, 3):
                self.assertEqual(mesh(ranks=ranks)[3], of_one)
            self.assertEqual(check(work / "s.h5")[0], 0)
            _, x, sizes, _ = mesh("sizing.type=uniform", "sizing.scale=absolute", "sizing.max_size=0.027")
            numpy.testing.assert_allclose(sizes, numpy.minimum(0.027, 0.03 - 0.01 * x), rtol=1e-3)
            said, x, sizes, _ = mesh("sizing.type=automatic", "sizing.scale=absolute", "sizing.min_size=0.01")
            self.assertTrue((sizes <= 0.03 - 0.01 * x + 1e-4).all())
            self.assertIn("[sizing]", said)
            said, x, sizes, _ = mesh("sizing.size_at=square 0.01", ranks=2)
            wanted = numpy.minimum(0.02 + 0.02 * x, 0.03 - 0.01 * x)
            found = float(said.split("[size_at] ")[1].split(" %")[0])
            self.assertAlmostEqual(found, 100 * numpy.mean(sizes < 0.999 * wanted), delta=3)
            (work / "s.ini").write_text(CONFIG.format(file="h.asc", gradation=0.1) + "[size.left]\n", "ascii")
            done = run(work / "s.ini", ranks=2)
            self.assertEqual(done.returncode, 2)
            self.assertIn("[size.left] needs 'expression'", done.stderr)

    def test_bad_input(self):
        with Workspace() as work:
            write_ascii(work / "small.asc", [ROW] * 6, (-0.1, -0.1), 0.1)
            self.refuse(work, "small.asc", "covers the shape", "outside = nearest", "75 %")
            self.mesh(work, "small.asc", "field.h.outside=nearest")
            write_ascii(work / "h.asc", [ROW] * 6)
            text = (work / "h.asc").read_text("ascii")
            (work / "five.asc").write_text(text.replace(" 0.04\n", "\n", 1), "ascii")
            self.refuse(work, "five.asc", "expected 6 x 6 values, found only 35")
            self.refuse(work, "h.asc", "unknown name", overrides=["sizing.expression=h+depth"])
            self.refuse(work, "h.asc", "expected a positive size", overrides=["sizing.expression=h-0.03"])
            self.refuse(work, "h.asc", "is not a number at (0, 0)", "such as sqrt(max(depth, 1))",
                        overrides=["sizing.expression=max(sqrt(h-0.03), 0.02)"])
            self.refuse(work, "h.asc", "there are h; did you mean 'h'?", overrides=["sizing.expression=grad(hh)"])
            self.refuse(work, "none.asc", "none.asc", "[field.h]")
            (work / "old.nc").write_bytes(b"CDF\x01" + bytes(100))
            self.refuse(work, "old.nc", "nccopy -4")
            (work / "g.tif").write_bytes(b"II*\0" + bytes(100))
            self.refuse(work, "g.tif", "gdal_translate -of AAIGrid")

    def test_restart_with_other_data(self):
        with Workspace() as work:
            write_ascii(work / "h.asc", [ROW] * 6)
            (work / "stop").touch()
            stopped = self.run_mesh(work, "h.asc", f"checkpoint.stop_file={work / 'stop'}", ranks=2)
            self.assertEqual(stopped.returncode, 75, stopped.stdout + stopped.stderr)
            write_ascii(work / "h.asc", [ROW] * 5 + [[0.021] * 6])
            other = self.run_mesh(work, "h.asc", "--restart", "auto")
            self.assertEqual(other.returncode, 4, other.stdout + other.stderr)
            self.assertIn("has changed since", other.stderr)
            write_ascii(work / "h.asc", [ROW] * 6)
            again = self.run_mesh(work, "h.asc", "--restart", "auto")
            self.assertEqual(again.returncode, 0, again.stdout + again.stderr)

    def test_gradient(self):
        with Workspace() as work:
            write_ascii(work / "h.asc", [ROW] * 6)
            sizes = self.mesh(work, "h.asc", "sizing.expression=2*grad(h)")[2]
            numpy.testing.assert_allclose(sizes, 0.04, rtol=1e-6)

    def test_periodic_container(self):
        """The data are needed in the whole container, also if no curve bounds the shape."""
        with Workspace() as work:
            x = numpy.arange(-2, 23) / 20
            row = numpy.round(0.03 + 0.015 * numpy.cos(2 * numpy.pi * x), 9)
            write_ascii(work / "h.asc", [row] * 25, (-0.125, -0.125), 0.05)
            periodic = ("domain.periodic_x=true", "domain.periodic_y=true", "shape.geometry=domain")
            points, _, sizes, _, _ = self.mesh(work, "h.asc", *periodic, ranks=2, gradation=0.3)
            self.assertLess(sizes[numpy.abs(points[:, 0] - 0.5) < 0.05].max(), 0.02)
            self.assertGreater(sizes[points[:, 0] < 0.05].min(), 0.04)
            write_ascii(work / "half.asc", [row[:12]] * 25, (-0.125, -0.125), 0.05)
            self.refuse(work, "half.asc", "covers the shape", overrides=periodic)

    def test_slopes_of_smooth_data_at_the_opposite_meridian(self):
        """The slope of sin(x) is as large there as at x = 0."""
        with Workspace() as work:
            x, y = numpy.arange(-179, 180, 2.0), numpy.arange(-39, 40, 2.0)
            write_netcdf(work / "h.nc", numpy.sin(numpy.radians(x))[None, :] + 0 * y[:, None], x, y)
            belt = ("shape.square.x_min=-180", "shape.square.x_max=180", "shape.square.y_min=-10",
                    "shape.square.y_max=10", "sizing.expression=1.5 + 60*grad(h)", "field.h.smooth=15",
                    "field.h.coordinates=degrees")
            points, _, sizes, _, _ = self.mesh(work, "h.nc", *belt)
            middle = sizes[numpy.abs(points[:, 0]) < 4].mean()
            self.assertGreater(middle, 2.4)
            for end in (-180, 180):
                numpy.testing.assert_allclose(sizes[numpy.abs(points[:, 0] - end) < 4], middle, rtol=0.02)

    def test_degrees(self):
        """A bay across the date line, with data from 0 to 360 and from -180 to 180."""
        with Workspace() as work:
            (work / "bay.geojson").write_text(
                '{"type": "Polygon", "coordinates": [[[179, 60], [181, 60], [181, 61], [179, 61], [179, 60]]]}',
                "ascii")
            config = ("[shape]\ngeometry = bay\nprojection = auto\n[shape.bay]\ntype = contour\nfile = bay.geojson\n"
                      "[field.depth]\nfile = {}\n[sizing]\ntype = expression\nexpression = 100*sqrt(-depth)\n")
            y = numpy.arange(58, 63.01, 0.5)
            hashes = set()
            for name, x in (("a.nc", numpy.arange(0.25, 360, 0.5)), ("b.nc", numpy.arange(-179.75, 180, 0.5))):
                values = numpy.rint(-1000 - 500 * numpy.cos(numpy.radians(x))[None, :] + 0 * y[:, None])
                write_netcdf(work / name, values, x, y, "i2")
                (work / "d.ini").write_text(config.format(name), "ascii")
                for ranks in (1, 3):
                    done = run(work / "d.ini", "--quiet", f"output.directory={work}", "output.overwrite=true",
                               ranks=ranks)
                    self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                    with h5py.File(work / "d.h5") as mesh:
                        hashes.add(mesh["trime_mpi"].attrs["mesh_hash"])
                        sizes = mesh["VTKHDF/PointData/size"][:]
                    numpy.testing.assert_allclose(sizes, 100 * numpy.sqrt(500), rtol=0.02)
            self.assertEqual(len(hashes), 1)


if __name__ == "__main__":
    unittest.main()
