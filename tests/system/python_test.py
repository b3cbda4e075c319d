#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests the Python package: meshes as arrays, runs from Python with their errors as exceptions, and pictures."""
import contextlib
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import warnings

import h5py
import numpy as np

from trime_run import MPIEXEC, PROGRAM, ROOT, Workspace, users_environment

PACKAGE = ROOT / "scripts" / "python"
sys.path.insert(0, str(PACKAGE))
import trime_mpi  # noqa: E402  (found by the line above)
from trime_mpi import raster  # noqa: E402

DISC = {"shape": {"geometry": "difference(disc, hole)",
                  "disc": {"type": "circle", "center": (0.5, 0.5), "radius": 0.4},
                  "hole": {"type": "rectangle", "x_min": 0.4, "x_max": 0.6, "y_min": 0.4, "y_max": 0.6}},
        "meshing": {"points": 1500}}


def setUpModule():
    os.environ.update(users_environment(1), TRIME_PROGRAM=PROGRAM, TRIME_MPIEXEC=MPIEXEC)
    # Directories of other tests that run at the same time do not count.
    tempfile.tempdir = unittest.enterModuleContext(tempfile.TemporaryDirectory(prefix="tp-"))


def changed(**sections):
    """DISC with other values of some sections."""
    return {name: dict(DISC.get(name, {}), **sections.get(name, {})) for name in {**DISC, **sections}}


class Geo:
    """An object with __geo_interface__."""

    def __init__(self, kind, coordinates=None, **others):
        self.__geo_interface__ = {"type": kind, **({} if coordinates is None else {"coordinates": coordinates}),
                                  **others}


def temporary_files():
    """Working directories of the package that are there."""
    return sorted(pathlib.Path(tempfile.gettempdir()).glob("trime-????????"))


class Reading(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.work = cls.enterClassContext(Workspace())
        cls.file = cls.work / "m.h5"
        cls.mesh = trime_mpi.mesh(DISC, ranks=2, threads=1, output=cls.file)

    def test_arrays_are_those_of_the_file(self):
        mesh = trime_mpi.read(self.file)
        with h5py.File(self.file, "r") as file:
            np.testing.assert_array_equal(mesh.points, file["Mesh/mesh/geometry"][:])
            np.testing.assert_array_equal(mesh.triangles, file["Mesh/mesh/topology"][:])
            np.testing.assert_array_equal(mesh.size, file["VTKHDF/PointData/size"][:])
            self.assertEqual(mesh.hash, file["trime_mpi"].attrs["mesh_hash_hex"].decode())
        a, b, c = np.moveaxis(mesh.points[mesh.triangles], 1, 0)
        self.assertTrue((np.cross(b - a, c - a) > 0).all())
        self.assertEqual(mesh.hash, self.mesh.hash)

    def test_arrays_in_place_are_the_same_and_leave_the_file_alone(self):
        mesh, in_place = trime_mpi.read(self.file), trime_mpi.read(self.file, in_place=True)
        for name, value in vars(mesh).items():
            if isinstance(value, np.ndarray):
                np.testing.assert_array_equal(getattr(in_place, name), value)
        in_place.points[3] = 7
        np.testing.assert_array_equal(trime_mpi.read(self.file).points, mesh.points)
        self.assertEqual(list(in_place.boundaries), list(mesh.boundaries))

    def test_boundaries_by_name(self):
        found = self.mesh.boundaries
        self.assertEqual(set(found), {"disc", "hole"})
        self.assertEqual(sum(len(one.facets) for one in found.values()), len(self.mesh.facets))
        radius = np.hypot(*(self.mesh.points[found["disc"].vertices] - 0.5).T)
        np.testing.assert_allclose(radius, 0.4, rtol=1e-9)
        side = np.abs(self.mesh.points[found["hole"].vertices] - 0.5).max(axis=1)
        np.testing.assert_allclose(side, 0.1, rtol=1e-9)
        self.assertEqual(len(found["hole"].vertices), len(found["hole"].facets))

    def test_what_the_run_says_of_itself(self):
        mesh = self.mesh
        self.assertTrue(mesh.is_complete and mesh.checks["area"].passed)
        self.assertGreater(len(mesh.history["sweep"]), 3)
        self.assertGreaterEqual(mesh.quality["alpha_max"], mesh.quality["alpha_mean"])
        self.assertGreater(mesh.counters["run"]["messages"]["sum"], 0)
        self.assertGreater(mesh.timers["sweeps"]["max"], 0)
        self.assertEqual({loop["kind"] for loop in mesh.loops.values()}, {"outer", "hole"})
        self.assertIn("geometry = difference(disc, hole)", mesh.config)
        self.assertIn("gradation", mesh.config_resolved)
        self.assertEqual(mesh.fixed.sum(), mesh.attributes["corners"])

    def test_ranks_own_ranges_of_points(self):
        self.assertEqual(len(self.mesh.first_point), 2)
        owned = np.bincount(self.mesh.ranks(), minlength=2)
        self.assertEqual(self.mesh.first_point.tolist(), [0, owned[0]])
        self.assertGreater(owned.min(), len(self.mesh.points) // 4)

    def test_what_is_no_mesh(self):
        with self.assertRaisesRegex(trime_mpi.FileError, "there is no .*nothing.h5"):
            trime_mpi.read(self.work / "nothing.h5")
        (self.work / "text.h5").write_text("no mesh", encoding="utf-8")
        with self.assertRaisesRegex(trime_mpi.FileError, "not a mesh file of trime_mpi"):
            trime_mpi.read(self.work / "text.h5")


class Running(unittest.TestCase):
    def test_one_config_one_mesh_on_any_ranks_and_nothing_stays(self):
        before = temporary_files()
        hashes = {trime_mpi.mesh(DISC, ranks=ranks, threads=1).hash for ranks in (1, 2)}
        self.assertEqual(len(hashes), 1)
        self.assertEqual(temporary_files(), before)

    def test_rings_and_fixed_points_as_arrays(self):
        square = np.array([[0.1, 0.1], [0.9, 0.1], [0.9, 0.9], [0.1, 0.9]])
        place = np.array([[0.2, 0.45]])
        mesh = trime_mpi.mesh({"shape": {"geometry": "a",
                                         "a": {"type": "contour", "rings": [square, 0.25 + square / 2]}},
                               "meshing": {"points": 800, "fixed_points": place}})
        self.assertLess(np.abs(mesh.points - place).max(axis=1).min(), 1e-9)
        self.assertAlmostEqual(mesh.attributes["shape_area"], 0.64 - 0.16, places=9)

    def test_polygons_as_rings(self):
        """Objects with __geo_interface__, as shapely and geopandas have it, also with heights."""
        square = np.array([[0.1, 0.1], [0.9, 0.1], [0.9, 0.9], [0.1, 0.9], [0.1, 0.1]])
        hole, height = 0.25 + square / 2, np.ones((5, 1))
        plate = Geo("Polygon", [np.hstack([ring, height]).tolist() for ring in (square, hole)])
        named = Geo("FeatureCollection", features=[{
            "type": "Feature", "properties": {"name": "plate", "count": np.float32(1)},
            "geometry": plate.__geo_interface__}])
        for rings, part, names in ((plate, {}, ["a"]), ([plate], {}, ["a"]), (plate.__geo_interface__, {}, ["a"]),
                                   ([Geo("LinearRing", one.tolist()) for one in (square, hole)], {}, ["a"]),
                                   (named, {"attribute": "name"}, ["a.plate"])):
            with self.subTest(rings=type(rings), part=part):
                mesh = trime_mpi.mesh({"shape": {"geometry": "a", "a": {"type": "contour", "rings": rings, **part}},
                                       "meshing": {"points": 500}}, threads=1)
                self.assertAlmostEqual(mesh.attributes["shape_area"], 0.64 - 0.16, places=9)
                self.assertEqual(list(mesh.boundaries), names)

    def test_values_that_cannot_be_written(self):
        square = np.array([[0.1, 0.1], [0.9, 0.1], [0.9, 0.9], [0.1, 0.9]])
        sizes = r"config\['sizing'\]\['expression'\]: .*found {}.*; the size cannot be an array or a function yet"
        for section, key, value, message in (
                ("a", "rings", np.hstack([square, square]), r"rings.*found the shape \(4, 4\)"),
                ("a", "rings", [square, np.ones((4, 3))], r"rings'\]\[1\].*\(4, 3\); leave out the third column"),
                ("a", "rings", [square, Geo("Polygon", [square.tolist()])], "found both"),
                ("a", "rings", Geo("Point", (1, 2)), "of the type Point"),
                ("a", "rings", [], "found none"), ("a", "rings", 5, "type int"),
                ("a", "rings", [[1, 2], [3]], r"\[0\]"),
                ("meshing", "fixed_points", [[0.2, 0.3, 1]], "fixed_points.*third column"),
                ("sizing", "expression", lambda x, y: x + y, sizes.format("a function")),
                ("sizing", "expression", np.ones(5), sizes.format("an array")),
                ("sizing", "expression", [1.0, 2.0], sizes.format("an object of type list")),
                ("meshing", "seed", print, "seed.*found a function"),
                ("meshing", "points", np.ones((2, 2)), r"found an array with the shape \(2, 2\)"),
                ("meshing", "points", "5\n6", "expected one line")):
            config = {"a": {"type": "contour", "rings": square}, "sizing": {"type": "expression"},
                      "meshing": {"points": 500}}
            config[section][key] = value
            config["shape"] = {"geometry": "a", "a": config.pop("a")}
            with self.subTest(key=key, value=value), self.assertRaisesRegex(trime_mpi.ConfigError, message):
                trime_mpi.mesh(config)
        with self.assertRaisesRegex(trime_mpi.ConfigError, r"options\['sizing.expression'\].*found an array"):
            trime_mpi.mesh(DISC, options={"sizing.expression": np.ones(3)})

    def test_paths_are_relative_to_the_working_directory(self):
        with Workspace() as work, contextlib.chdir(work):
            pathlib.Path("ring.xy").write_text("0 0\n1 0\n1 1\n0 1\n", encoding="utf-8")
            pathlib.Path("points.xy").write_text("0.25 0.5\n", encoding="utf-8")
            config = {"shape": {"geometry": "a", "a": {"type": "contour", "file": "ring.xy"}},
                      "meshing": {"points": 300}}
            pathlib.Path("out").mkdir()
            mesh = trime_mpi.mesh(config, options={"meshing.fixed_points": pathlib.Path("points.xy")},
                                  output="out/m.h5", threads=1)
            self.assertIn((0.25, 0.5), {tuple(point) for point in mesh.points})
            self.assertEqual(trime_mpi.read("out/m.h5").hash, mesh.hash)

    def test_rules_of_models_and_several_sizes(self):
        config = {
            "shape": {"geometry": "disc", "disc": {"type": "circle", "center": (0.5, 0.5), "radius": 0.4}},
            "size": {"wave": {"expression": "1 + x"}, "coast": {"expression": "2 - x"}}, "meshing": {"points": 300},
            "output": {"accept": ["fvcom", "mpas"], "open_boundary": ["disc", "disc"]}}
        mesh = trime_mpi.mesh(config)
        self.assertEqual({verdict.solver for verdict in mesh.verdicts}, {"fvcom", "mpas"})
        self.assertTrue(all(verdict.holds for verdict in mesh.verdicts if verdict.refuses))
        angle = next(verdict for verdict in mesh.verdicts if verdict.rule == "least_angle")
        self.assertAlmostEqual(angle.worst, mesh.tables["quality"]["min_angle_degrees"], places=9)
        self.assertEqual((angle.is_least, angle.limit, angle.measured), (True, 30, len(mesh.triangles)))
        self.assertEqual(set(mesh.size_shares), {"size.wave", "size.coast"})
        self.assertEqual(sum(mesh.size_shares.values()), len(mesh.points))
        self.assertEqual(mesh.attributes["open_boundary"], "disc,disc")

    def test_none_is_the_default(self):
        mesh = trime_mpi.mesh(changed(meshing={"points": 700, "fixed_points": None, "seed": None}), threads=1)
        self.assertEqual(mesh.hash, trime_mpi.mesh(changed(meshing={"points": 700}), threads=1).hash)

    def test_file_of_a_config_with_options(self):
        mesh = trime_mpi.mesh(ROOT / "configs" / "circle.ini", options={"meshing.points": 700})
        self.assertAlmostEqual(len(mesh.points), 700, delta=20)

    def test_config_errors_have_their_messages(self):
        for ranks in (1, 2):
            with self.subTest(ranks=ranks), self.assertRaises(trime_mpi.ConfigError) as caught:
                trime_mpi.mesh(changed(sizing={"gradaton": 0.1}, meshing={"points": 1500, "seed": "x"}), ranks=ranks,
                               threads=1)
            self.assertEqual(caught.exception.code, 2)
            self.assertEqual(len(caught.exception.messages), 2)
            told = "\n".join(caught.exception.messages)
            self.assertRegex(told, r"config.ini:\d+: unknown key 'gradaton' in \[sizing\]; did you mean 'gradation'\?")
            self.assertNotIn(tempfile.gettempdir(), told)

    def test_each_exit_code_has_its_class(self):
        bow = np.array([[0.1, 0.1], [0.9, 0.9], [0.9, 0.1], [0.1, 0.9]])
        with self.assertRaisesRegex(trime_mpi.GeometryError, "cross"):
            trime_mpi.mesh({"shape": {"geometry": "a", "a": {"type": "contour", "rings": bow}},
                            "meshing": {"points": 500}})
        with self.assertRaisesRegex(trime_mpi.FileError, "nothing.xy"):
            trime_mpi.mesh({"shape": {"geometry": "a", "a": {"type": "contour", "file": "nothing.xy"}},
                            "meshing": {"points": 500}})
        with self.assertRaises(trime_mpi.IncompleteError) as caught:
            trime_mpi.mesh(changed(meshing={"points": 1500, "max_sweeps": 2}))
        self.assertIn("sweep cap", str(caught.exception))
        self.assertFalse(caught.exception.mesh.is_complete)
        with self.assertRaisesRegex(trime_mpi.ProgramMissing, "no program /nowhere"):
            trime_mpi.mesh(DISC, program="/nowhere/trime_mpi")

    def test_a_file_that_is_there_stays(self):
        with Workspace() as work:
            trime_mpi.mesh(DISC, output=work / "m.h5")
            with self.assertRaisesRegex(trime_mpi.FileError, "m.h5"):
                trime_mpi.mesh(DISC, output=work / "m.h5")
            trime_mpi.mesh(DISC, output=work / "m.h5", overwrite=True)

    def test_warnings_of_the_program(self):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            ring = np.array([[0.1, 0.1], [0.9, 0.1], [0.9, 0.1], [0.9, 0.9], [0.1, 0.9]])  # a vertex twice
            mesh = trime_mpi.mesh({"shape": {"geometry": "a", "a": {"type": "contour", "rings": ring}},
                                   "meshing": {"points": 500}})
        self.assertEqual([str(one.message) for one in caught], mesh.warnings)
        self.assertTrue(mesh.warnings)

    def test_an_interrupt_ends_the_run(self):
        long = changed(meshing={"points": 3000000})
        before = temporary_files()
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                timer = threading.Timer(2, signal.pthread_kill, [threading.main_thread().ident, signal.SIGINT])
                timer.start()
                with self.assertRaises(KeyboardInterrupt):
                    trime_mpi.mesh(long, ranks=ranks, threads=1)
                timer.join()
                self.assertEqual(temporary_files(), before)
        with self.assertRaises(subprocess.TimeoutExpired):
            trime_mpi.mesh(long, timeout=1)
        time.sleep(0.2)
        left = subprocess.run(["ps", "-eo", "ppid,args"], capture_output=True, text=True, check=True).stdout
        self.assertEqual([line for line in left.splitlines()
                          if line.split()[0] == str(os.getpid()) and PROGRAM in line], [])


class Drawing(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.mesh = trime_mpi.mesh(changed(meshing={"points": 4000}, sizing={"type": "automatic"}), ranks=2, threads=1)

    def test_all_pictures(self):
        with Workspace() as work:
            for what in ("quality", "size", "parts", "ranks", "history"):
                with self.subTest(what=what):
                    trime_mpi.plot(self.mesh, what, work / "p.png", dpi=60)
                    picture = (work / "p.png").read_bytes()
                    self.assertTrue(picture.startswith(b"\x89PNG"))
                    self.assertGreater(len(picture), 12_000)
                    trime_mpi.plot(self.mesh, what, work / "p.svg", dpi=60)
                    self.assertIn("</svg>", (work / "p.svg").read_text(encoding="utf-8")[-20:])

    def test_pictures_name_what_they_show(self):
        texts = [text.get_text() for text in trime_mpi.plot(self.mesh, "parts").legends[0].get_texts()]
        self.assertTrue(any(text.startswith("disc: ") for text in texts), texts)
        texts = [text.get_text() for text in trime_mpi.plot(self.mesh, "ranks").legends[0].get_texts()]
        self.assertEqual([text.split(":")[0] for text in texts], ["rank 0", "rank 1"])

    def test_pixels_show_what_polygons_would(self):
        """Each pixel inside the shape is filled, and has the mean of the value there."""
        middle = self.mesh.corners().mean(axis=1)
        for pixels in (60, 12):  # smaller and larger than triangles
            with self.subTest(pixels=pixels):
                canvas = raster.Canvas(self.mesh.points.min(axis=0), self.mesh.points.max(axis=0), pixels)
                image, polygons = raster.mean_image(self.mesh, canvas, middle[:, 0])
                self.assertEqual(len(polygons), 0)
                rows, columns = np.mgrid[:canvas.shape[0], :canvas.shape[1]]
                x = canvas.low[0] + (columns + 0.5) * canvas.side
                y = canvas.low[1] + (rows + 0.5) * canvas.side
                margin = 0.75 * canvas.side  # half a diagonal, and a little
                radius, square = np.hypot(x - 0.5, y - 0.5), np.maximum(abs(x - 0.5), abs(y - 0.5))
                inside = (radius < 0.4 - margin) & (square > 0.1 + margin)
                self.assertFalse(np.isnan(image[inside]).any())
                self.assertTrue(np.isnan(image[(radius > 0.4 + margin) | (square < 0.1 - margin)]).all())
                self.assertLess(np.abs(image - x)[inside].max(), self.mesh.size.max() + canvas.side)

    def test_large_triangles_are_left_to_polygons(self):
        canvas = raster.Canvas(self.mesh.points.min(axis=0), self.mesh.points.max(axis=0), 5000)
        image, polygons = raster.number_image(self.mesh, canvas, np.zeros(len(self.mesh.triangles), int))
        self.assertEqual(len(polygons), len(self.mesh.triangles))
        self.assertTrue((image == -1).all())

    def test_wrong_wishes(self):
        with self.assertRaisesRegex(ValueError, "expected one of quality, size"):
            trime_mpi.plot(self.mesh, "beauty")


class Package(unittest.TestCase):
    def test_versions_are_those_of_the_program(self):
        version = re.search(r"VERSION (\d+\.\d+\.\d+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"))[1]
        self.assertEqual(trime_mpi.__version__, version)
        self.assertIn(f'version = "{version}"', (PACKAGE / "pyproject.toml").read_text(encoding="utf-8"))

    def test_a_module_that_is_missing_is_named_with_its_package(self):
        for module, use in (("h5py", ""), ("numpy", ""), ("matplotlib", "; trime_mpi.plot('m.h5')")):
            with self.subTest(module=module):
                program = f"import sys; sys.modules['{module}'] = None; import trime_mpi{use}"
                done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False,
                                      env=dict(os.environ, PYTHONPATH=str(PACKAGE)))
                self.assertIn(f"needs the Python module '{module}'", done.stderr)
                self.assertIn(f"apt-get install python3-{module}", done.stderr)

    def test_installs_without_a_network(self):
        with Workspace() as work:
            source = work / "source"
            subprocess.run(["cp", "-r", PACKAGE, source], check=True)  # the build leaves files in its source
            done = subprocess.run([sys.executable, "-m", "pip", "install", "--no-build-isolation", "--no-deps",
                                   "--no-index", "--target", work / "site", source], capture_output=True, text=True,
                                  check=False, timeout=300)
            if "No module named pip" in done.stderr or "setuptools" in done.stderr and "No module" in done.stderr:
                self.skipTest("no pip with setuptools here")
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            found = subprocess.run([sys.executable, "-c", "import trime_mpi; print(trime_mpi.__file__)"],
                                   capture_output=True, text=True, check=True, cwd=work,
                                   env=dict(os.environ, PYTHONPATH=str(work / "site"))).stdout
            self.assertTrue(found.startswith(str(work / "site")), found)


if __name__ == "__main__":
    unittest.main()
