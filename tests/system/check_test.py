#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests that trime_check passes the meshes of all configs, and finds each kind of damage by the right check."""
import json
import math
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

import h5py
import numpy as np

from trime_run import ROOT, run

CHECK = os.environ.get("TRIME_CHECK", str(ROOT / "build" / "ci" / "src" / "check" / "trime_check"))
POINTS = 1200
GEOMETRY, TOPOLOGY = "Mesh/mesh/geometry", "Mesh/mesh/topology"


def check(*arguments):
    """Exit code and text."""
    done = subprocess.run([CHECK, *map(str, arguments)], capture_output=True, text=True, check=False, timeout=60)
    return done.returncode, done.stdout + done.stderr


def stored_hash(path):
    with h5py.File(path, "r") as file:
        return int(file["trime_mpi"].attrs["mesh_hash"])


def check_damaged(whole, path, damage):
    """Code and text of a check of a copy of the file, at `path`, that was damaged."""
    shutil.copy(whole, path)
    with h5py.File(path, "r+") as file:
        damage(file)
    return check(path)


def mix(z):
    z = z + np.uint64(0x9E3779B97F4A7C15)
    z = (z ^ (z >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    z = (z ^ (z >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    return z ^ (z >> np.uint64(31))


def mesh_hash(file):
    """The mesh hash, computed as src/files.md says."""
    xy = (file[GEOMETRY][:] + 0.0).view(np.uint64)
    ids = file[TOPOLOGY][:].astype(np.uint64)
    point = mix(mix(mix(np.uint64(2) * np.arange(len(xy), dtype=np.uint64)) ^ xy[:, 0]) ^ xy[:, 1])
    triangle = mix(np.uint64(2) * np.arange(len(ids), dtype=np.uint64) + np.uint64(1))
    for k in range(3):
        triangle = mix(triangle ^ ids[:, k])
    return np.concatenate([point, triangle]).sum(dtype=np.uint64)


def seal(file):
    """The views and the hash follow the arrays, so that other checks must find what is wrong."""
    xy, ids = file[GEOMETRY][:], file[TOPOLOGY][:]
    file["geometry/vertices"][:] = xy
    for name, values in (("Points", np.pad(xy, ((0, 0), (0, 1)))), ("Connectivity", ids.ravel())):
        if not file["VTKHDF"][name].is_virtual:  # a virtual one shows the arrays
            file["VTKHDF"][name][:] = values
    file["trime_mpi"].attrs.modify("mesh_hash", mesh_hash(file))
    file["trime_mpi"].attrs.modify("mesh_hash_hex", np.bytes_(f"{int(mesh_hash(file)):016x}"))


def inner(file, count=1):
    """Points inside, far from each other in the order of the file."""
    return np.flatnonzero(file["VTKHDF/PointData/boundary"][:] == 0)[20::97][:count]


def rim(file):
    """A point on the boundary that is not a corner."""
    data = file["VTKHDF/PointData"]
    return np.flatnonzero((data["boundary"][:] != 0) & (data["fixed"][:] == 0))[5]


def replace(file, name, values):
    del file[name]
    file[name] = values


def change(file, name, index, value):
    values = file[name][:]
    values[index] = value
    if file[name].is_virtual:  # or the array behind it would change, too
        replace(file, name, values)
    else:
        file[name][:] = values


def move(file, point, share):
    """By a share of h, to the lattice."""
    h = file["VTKHDF/PointData/size"][point]
    file[GEOMETRY][point] += np.round(share * h * np.array([0.8, 0.6]) * 2.0**40) / 2.0**40
    seal(file)


def flip_triangle(file):
    ids = file[TOPOLOGY][100]
    file[TOPOLOGY][100] = ids[[0, 2, 1]]
    seal(file)


def flip_edge(file):
    """The other diagonal of two triangles that are not cocircular."""
    ids = [tuple(t) for t in file[TOPOLOGY][:]]
    sides = {(t[k], t[(k + 1) % 3]): (n, t[(k + 2) % 3]) for n, t in enumerate(ids) for k in range(3)}
    for (a, b), (n, c) in sorted(sides.items()):
        m, d = sides.get((b, a), (None, None))
        if m is not None and n > 400 and m > 400:
            for number, triangle in ((n, (c, d, b)), (m, (d, c, a))):
                least = triangle.index(min(triangle))
                file[TOPOLOGY][number] = triangle[least:] + triangle[:least]
            break
    seal(file)


def swap_coordinates(file):
    a, b = inner(file, 2)
    file[GEOMETRY][a], file[GEOMETRY][b] = file[GEOMETRY][b], file[GEOMETRY][a]
    seal(file)


def swap_ids(file):
    """Two points change their numbers, everywhere but in the hash."""
    a, b = inner(file, 2)
    number = np.arange(len(file[GEOMETRY]))
    number[[a, b]] = b, a
    file[GEOMETRY][:] = file[GEOMETRY][:][number]
    file["VTKHDF/PointData/size"][:] = file["VTKHDF/PointData/size"][:][number]
    file[TOPOLOGY][:] = number[file[TOPOLOGY][:]]
    stored = file["trime_mpi"].attrs["mesh_hash"], file["trime_mpi"].attrs["mesh_hash_hex"]
    seal(file)
    file["trime_mpi"].attrs.modify("mesh_hash", stored[0])
    file["trime_mpi"].attrs.modify("mesh_hash_hex", stored[1])


def swap_rows(file):
    a, b = file[TOPOLOGY][50], file[TOPOLOGY][60]
    file[TOPOLOGY][50], file[TOPOLOGY][60] = b, a
    seal(file)


def repeat_triangle(file):
    file[TOPOLOGY][101] = file[TOPOLOGY][100]
    seal(file)


def lose_triangle(file):
    for name in (TOPOLOGY, "VTKHDF/CellData/alpha", "VTKHDF/CellData/beta", "VTKHDF/CellData/region", "VTKHDF/Types",
                 "VTKHDF/Offsets"):
        replace(file, name, file[name][:-1])
    replace(file, "VTKHDF/Connectivity", file["VTKHDF/Connectivity"][:-3])
    file["VTKHDF/NumberOfCells"][0] -= 1
    file["VTKHDF/NumberOfConnectivityIds"][0] -= 3
    seal(file)


def lose_facet(file):
    for name in ("topology", "values", "parts", "labels", "asked_size"):
        replace(file, f"Mesh/facets/{name}", file[f"Mesh/facets/{name}"][:-1])


def turn_facet(file):
    file["Mesh/facets/topology"][7] = file["Mesh/facets/topology"][7][::-1]


def other_part(file):
    file["Mesh/facets/parts"][7] = 1 - file["Mesh/facets/parts"][7]


def lose_fixed_point(file):
    """One inside: on the boundary it would be a corner."""
    data = file["VTKHDF/PointData"]
    change(file, "VTKHDF/PointData/fixed", np.flatnonzero((data["fixed"][:] == 1) & (data["boundary"][:] == 0))[0], 0)


def lose_corner(file):
    data = file["VTKHDF/PointData"]
    change(file, "VTKHDF/PointData/fixed", np.flatnonzero((data["fixed"][:] == 1) & (data["boundary"][:] != 0))[0], 0)


def bend(name):
    def damage(file):
        replace(file, name, np.array(file[name][:], np.float64 if file[name].dtype == np.float32 else np.int16))
    return damage


def row(file, name):
    return list(file["trime_mpi/checks/name"][:]).index(name.encode())


# What is done to the file of spade_fixed_points.ini, and the checks that must speak.
DAMAGES = {
    "a point moved inside": (lambda f: move(f, inner(f)[0], 0.1), ["alpha", "quality"]),
    "a point moved far": (lambda f: move(f, inner(f)[0], 3), ["orientation"]),
    "a boundary point moved": (lambda f: move(f, rim(f), 0.05), ["on_curve"]),
    "a point moved by rounding": (lambda f: change(f, GEOMETRY, (inner(f)[0], 0), np.nextafter(
        f[GEOMETRY][inner(f)[0], 0], 2)), ["lattice", "mesh_hash"]),
    "a point moved in a view": (lambda f: change(f, "VTKHDF/Points", (9, 1), 0.5), ["vtk_points"]),
    "a triangle flipped": (flip_triangle, ["orientation", "manifold"]),
    "an edge flipped": (flip_edge, ["delaunay"]),
    "coordinates permuted": (swap_coordinates, ["orientation"]),
    "ids permuted": (swap_ids, ["mesh_hash"]),
    "rows of triangles swapped": (swap_rows, ["order"]),
    "a triangle twice": (repeat_triangle, ["manifold", "rim"]),
    "a triangle lost": (lose_triangle, ["rim"]),
    "a facet lost": (lose_facet, ["rim", "closed_loops"]),
    "a facet turned": (turn_facet, ["facets", "simple_loops"]),
    "a wrong tag": (lambda f: change(f, "Mesh/facets/values", 7, 9), ["tags"]),
    "a wrong part": (other_part, ["on_curve"]),
    "a foreign part": (lambda f: change(f, "Mesh/facets/parts", 7, 5), ["tags", "facet_parts"]),
    "a wrong tag of a point": (lambda f: change(f, "VTKHDF/PointData/boundary", inner(f)[0], 1), ["boundary_array"]),
    "a table of tags changed": (lambda f: change(f, "trime_mpi/tags/edge_count", 0, 3), ["tags"]),
    "a coordinate that is not a number": (lambda f: change(f, GEOMETRY, (9, 0), np.nan), ["finite"]),
    "an id out of range": (lambda f: change(f, TOPOLOGY, (9, 1), 10**9), ["id_range"]),
    "a negative id": (lambda f: change(f, "Mesh/facets/topology", (9, 1), -1), ["id_range"]),
    "alpha edited": (lambda f: change(f, "VTKHDF/CellData/alpha", 9, 1.001), ["alpha"]),
    "beta edited": (lambda f: change(f, "VTKHDF/CellData/beta", 9, np.nan), ["beta"]),
    "a size of zero": (lambda f: change(f, "VTKHDF/PointData/size", 9, 0), ["positive_size"]),
    "a large size": (lambda f: change(f, "VTKHDF/PointData/size", 9, 5), ["size"]),
    "an asked size that is not a number": (lambda f: change(f, "Mesh/facets/asked_size", 9, np.nan), ["asked_size"]),
    "a region of zero": (lambda f: change(f, "VTKHDF/CellData/region", 9, 0), ["region"]),
    "alpha cut off": (lambda f: replace(f, "VTKHDF/CellData/alpha", f["VTKHDF/CellData/alpha"][:-5]), ["arrays"]),
    "an array of another type": (bend("VTKHDF/CellData/alpha"), ["arrays"]),
    "ids of another type": (bend(TOPOLOGY), ["arrays"]),
    "an array lost": (lambda f: f.__delitem__("Mesh/facets/parts"), ["arrays"]),
    "offsets changed": (lambda f: change(f, "VTKHDF/Offsets", 9, 28), ["vtk_cells"]),
    "a kind of cell changed": (lambda f: change(f, "VTKHDF/Types", 9, 9), ["vtk_cells"]),
    "the hash changed": (lambda f: f["trime_mpi"].attrs.modify("mesh_hash", np.uint64(1)), ["mesh_hash"]),
    "a check changed": (lambda f: change(f, "trime_mpi/checks/found", row(f, "edge_count"), 7), ["stored_checks"]),
    "a check failed": (lambda f: change(f, "trime_mpi/checks/passed", row(f, "area"), 0), ["stored_checks"]),
    "marked as complete or not": (lambda f: f["trime_mpi"].attrs.modify("complete", 0), ["stored_checks"]),
    "quality changed": (lambda f: f["trime_mpi/quality"].attrs.modify("alpha_mean", 1.01), ["quality"]),
    "obtuse triangles changed": (lambda f: f["trime_mpi/quality"].attrs.modify("obtuse_triangles", 3), ["quality"]),
    "a histogram changed": (lambda f: change(f, "trime_mpi/quality/alpha_histogram", 0, 1), ["quality"]),
    "a fixed point lost": (lose_fixed_point, ["fixed_points"]),
    "a corner lost": (lose_corner, ["stored_checks"]),
    "a period made up": (lambda f: f["trime_mpi"].attrs.modify("period_x", 1.0), ["periods"]),
}


class Check(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.work = pathlib.Path(tempfile.mkdtemp(prefix="trime-system-"))
        cls.addClassCleanup(shutil.rmtree, cls.work, ignore_errors=True)

    def mesh(self, stem, *options):
        path = self.work / f"{stem}.h5"
        if not path.exists():
            done = run(ROOT / "configs" / f"{stem}.ini", f"meshing.points={POINTS}", f"output.directory={self.work}",
                       *options)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return path

    def wrong(self, text):
        return re.findall(r"(?m)^WRONG +(\S+)", text)

    def test_passes_the_meshes_of_all_configs(self):
        for config in sorted((ROOT / "configs").glob("*.ini")):
            with self.subTest(config=config.name):
                for arguments in ([self.mesh(config.stem)], [self.mesh(config.stem), config]):
                    code, text = check(*arguments)
                    self.assertEqual(code, 0, text)
                    self.assertRegex(text, r"All \d+ checks passed")
                    self.assertNotIn("WRONG", text)
                if config.stem in ("square", "circle", "triangle", "rectangle", "spade", "boolean", "torus_hole"):
                    self.assertRegex(text, r"(?m)^ok +on_curve")

    def test_passes_the_mesh_of_a_map(self):
        """trime_check reads polygons and lines of maps."""
        ring = [[3000, 1000], [9000, 1000], [9000, 5000], [3000, 5000], [3000, 1000]]
        for kind, places in (("Polygon", [ring]), ("LineString", ring), ("MultiLineString", [ring[:3], ring[:1:-1]])):
            (self.work / "map.geojson").write_text(json.dumps(
                {"type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "EPSG:25833"}},
                 "features": [{"type": "Feature", "properties": {"name": "Isle"},
                               "geometry": {"type": kind, "coordinates": places}}]}))
            config = self.work / "map.ini"
            config.write_text("[shape]\ngeometry = difference(land, pond)\n[shape.land]\ntype = contour\n"
                              "file = map.geojson\n"
                              "attribute = name\n[shape.pond]\ntype = circle\ncenter = 6000 3000\nradius = 700\n"
                              f"[meshing]\npoints = {POINTS}\n[output]\noverwrite = true\n")
            done = run(config, f"output.directory={self.work}")
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            code, text = check(self.work / "map.h5")
            self.assertEqual(code, 0, text)
            self.assertRegex(text, r"(?m)^ok +container")
            self.assertRegex(text, r"(?m)^ok +facet_parts")
            code, text = check(self.work / "map.h5", ROOT / "configs" / "square.ini")
            self.assertEqual(code, 5, text)
            self.assertIn("facet_parts", self.wrong(text))

    def test_finds_every_damage(self):
        self.assertGreaterEqual(len(DAMAGES), 20)
        whole = self.mesh("spade_fixed_points")
        for name, (damage, names) in DAMAGES.items():
            with self.subTest(damage=name):
                code, text = check_damaged(whole, self.work / "damaged.h5", damage)
                self.assertEqual(code, 5, text)
                for expected in names:
                    self.assertIn(expected, self.wrong(text), text)
                self.assertRegex(text, r"checks FAILED")

    def test_a_sealed_file_is_sound(self):
        """The hash in Python is that of the program, so damages above are found by the checks that are named."""
        path = self.work / "sealed.h5"
        shutil.copy(self.mesh("spade_fixed_points"), path)
        with h5py.File(path, "r+") as file:
            self.assertEqual(mesh_hash(file), file["trime_mpi"].attrs["mesh_hash"])
            seal(file)
        code, text = check(path)
        self.assertEqual(code, 0, text)

    def test_files_of_earlier_versions_are_read(self):
        """They have stored points and int64 vertices in both views."""
        new, old = self.mesh("spade_fixed_points"), self.work / "earlier.h5"
        shutil.copy(new, old)
        with h5py.File(old, "r+") as file:
            for name in (TOPOLOGY, "VTKHDF/Connectivity", "VTKHDF/Offsets"):
                about = dict(file[name].attrs)
                replace(file, name, file[name][:].astype(np.int64))
                file[name].attrs.update(about)
            replace(file, "VTKHDF/Points", file["VTKHDF/Points"][:])
            del file["viz/topology/cells"]
            file["viz/topology/cells"] = file[TOPOLOGY]
        code, text = check(old)
        self.assertEqual(code, 0, text)
        for command, ending, content in (("convert", "msh", pathlib.Path.read_bytes), ("refine", "h5", stored_hash)):
            made = []
            for source in (old, new):
                target = source.with_suffix(f".{command}.{ending}")
                done = run(command, source, target)
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                made.append(content(target))
            self.assertEqual(*made)

    def test_the_shape_of_another_config(self):
        code, text = check(self.mesh("square"), ROOT / "configs" / "triangle.ini")
        self.assertEqual(code, 5, text)
        self.assertIn("facet_parts", self.wrong(text))

    def test_corners_of_contours_that_cross(self):
        """A slanted comb less a star: how many corners there are is counted here without any cleverness."""
        turn, teeth = 0.3, 8
        comb = [(0.1, 0.2)]
        for k in range(teeth):
            comb += [(0.1 + 0.1 * (k + share), y) for share, y in ((0.1, 0.3), (0.45, 0.8), (0.8, 0.3))]
        comb += [(0.9, 0.2)]
        comb = [(0.5 + math.cos(turn) * (x - 0.5) - math.sin(turn) * (y - 0.5),
                 0.5 + math.sin(turn) * (x - 0.5) + math.cos(turn) * (y - 0.5)) for x, y in comb]
        star = [(0.52 + r * math.cos(math.pi * k / 9 + 0.1), 0.47 + r * math.sin(math.pi * k / 9 + 0.1))
                for k in range(18) for r in [0.13 if k % 2 else 0.26]]
        for name, ring in (("comb", comb), ("star", star)):
            (self.work / f"{name}.xy").write_text("".join(f"{x!r} {y!r}\n" for x, y in ring), "ascii")
        config = self.work / "crossing.ini"
        config.write_text("[shape]\ngeometry = difference(comb, star)\n" +
                          "".join(f"[shape.{name}]\ntype = contour\nfile = {name}.xy\n" for name in ("comb", "star")) +
                          "[meshing]\npoints = 4000\nkeep_features = true\ncorner_angle = 3\n"
                          "[output]\nname = crossing\n", "ascii")
        done = run(config, f"output.directory={self.work}")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

        def inside(p, ring):
            return sum((a[1] > p[1]) != (b[1] > p[1]) and p[0] < a[0] + (p[1] - a[1]) * (b[0] - a[0]) / (b[1] - a[1])
                       for a, b in zip(ring, ring[1:] + ring[:1])) % 2 == 1

        def turns(a, b, c):
            u, v = (b[0] - a[0], b[1] - a[1]), (c[0] - b[0], c[1] - b[1])
            return abs(math.degrees(math.atan2(u[0] * v[1] - u[1] * v[0], u[0] * v[0] + u[1] * v[1]))) > 3

        corners = [b for ring, other, wanted in ((comb, star, False), (star, comb, True))
                   for a, b, c in zip(ring[-1:] + ring[:-1], ring, ring[1:] + ring[:1])
                   if turns(a, b, c) and inside(b, other) == wanted]
        self.assertGreater(len(corners), 15)
        code, text = check(self.work / "crossing.h5")
        self.assertEqual(code, 0, text)
        self.assertRegex(text, rf"(?m)^ok +corners +expected {len(corners)}, found {len(corners)}:")
        with h5py.File(self.work / "crossing.h5", "r+") as file:
            places = file[GEOMETRY][:]
            change(file, "VTKHDF/PointData/fixed", np.argmin(np.hypot(*(places - corners[-1]).T)), 0)
        code, text = check(self.work / "crossing.h5")
        self.assertIn("corners", self.wrong(text))

    def test_places_where_parts_meet(self):
        """Crossings below corner_angle, sides that go on in another part, and what is too small to be seen."""
        def rectangle(x_min, x_max, y_min, y_max):
            return f"type = rectangle\nx_min = {x_min}\nx_max = {x_max}\ny_min = {y_min}\ny_max = {y_max}\n"

        def circle(x, radius):
            return f"type = circle\ncenter = {x} 0.5\nradius = {radius}\n"

        shapes = {  # two parts, corners, corners left out
            "slanted": ((rectangle(0.1, 0.6, 0.3, 0.6),
                         "type = triangle\np0 = 0.4 0.58\np1 = 0.4 0.2\np2 = 0.9 0.66\n"), 9, 0),
            "circles": ((circle(0.4, 0.3), circle(0.43, 0.28)), 2, 0),
            "one_side": ((rectangle(0.1, 0.49, 0.1, 0.6), rectangle(0.45, 0.9, 0.1, 0.6)), 6, 0),
            "bump": ((rectangle(0.1, 0.9, 0.1, 0.6),
                      "type = triangle\np0 = 0.48 0.599\np1 = 0.52 0.599\np2 = 0.5 0.6005\n"), 4, 2),
        }
        for name, (parts, corners, left_out) in shapes.items():
            with self.subTest(shape=name):
                config = self.work / f"{name}.ini"
                config.write_text("[shape]\ngeometry = union(a, b)\n" +
                                  "".join(f"[shape.{part}]\n{text}" for part, text in zip("ab", parts)) +
                                  "[meshing]\npoints = 500\nsimplify_within = 0\n", "ascii")
                done = run(config, f"output.directory={self.work}")
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                code, text = check(self.work / f"{name}.h5")
                self.assertEqual(code, 0, text)
                with h5py.File(self.work / f"{name}.h5") as file:
                    self.assertEqual(np.count_nonzero(file["VTKHDF/PointData/fixed"][:]), corners)
                    self.assertEqual(file["trime_mpi"].attrs["corners_left_out"], left_out)

    def test_corners_of_the_config(self):
        path = self.work / "cornerless.h5"
        shutil.copy(self.mesh("square"), path)
        with h5py.File(path, "r+") as file:
            change(file, "VTKHDF/PointData/fixed", np.flatnonzero(file["VTKHDF/PointData/fixed"][:])[0], 0)
        code, text = check(path)
        self.assertEqual(code, 5, text)
        self.assertIn("corners", self.wrong(text))

    def test_a_limit_of_what_may_be_lost(self):
        done = run(ROOT / "configs" / "coast.ini", f"meshing.points={POINTS}", "meshing.max_loss=0.5",
                   f"output.directory={self.work}", "output.name=limited")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        code, text = check(self.work / "limited.h5")
        self.assertEqual(code, 0, text)

    def test_steps_have_no_certificate(self):
        self.mesh("circle")
        done = run(ROOT / "configs" / "circle.ini", f"meshing.points={POINTS}", f"output.directory={self.work}",
                   "output.name=steps", "output.interval=-2")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        code, text = check(next(self.work.glob("steps_step_*.h5")))
        self.assertEqual(code, 0, text)
        self.assertIn("stored_checks", text)

    def test_files_with_one_view(self):
        for formats in ("vtkhdf", "xdmf", "text"):
            with self.subTest(formats=formats):
                done = run(ROOT / "configs" / "circle.ini", f"meshing.points={POINTS}", f"output.directory={self.work}",
                           f"output.name=only_{formats}", f"output.formats={formats}")
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                code, text = check(self.work / f"only_{formats}.h5")
                self.assertEqual(code, 0, text)

    def test_files_that_are_no_meshes(self):
        whole = self.mesh("square")
        (self.work / "text.h5").write_text("a mesh\n", "ascii")
        (self.work / "cut.h5").write_bytes(whole.read_bytes()[:whole.stat().st_size // 2])
        with h5py.File(self.work / "foreign.h5", "w") as file:
            file["data"] = [1, 2, 3]
        for name, told in (("none.h5", "No such file"), (".", "not a regular file"), ("text.h5", "not an HDF5 file"),
                           ("cut.h5", "cut off"), ("foreign.h5", "no mesh of trime_mpi")):
            with self.subTest(file=name):
                code, text = check(self.work / name)
                self.assertEqual(code, 4, text)
                self.assertRegex(text, r"^trime_check: error: ")
                self.assertIn(told, text)

    def test_command_line(self):
        whole = self.mesh("square")
        (self.work / "bad.ini").write_text("[shape]\ngeometry = nowhere\n", "ascii")
        for code, arguments in ((2, []), (2, ["--nonsense"]), (2, [whole, self.work / "bad.ini"]),
                                (4, [whole, self.work / "none.ini"]), (0, ["--help"]), (0, ["--version"])):
            with self.subTest(arguments=arguments):
                self.assertEqual(check(*arguments)[0], code)


if __name__ == "__main__":
    unittest.main()
