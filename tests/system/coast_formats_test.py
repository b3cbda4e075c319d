#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests the files for coastal models (gr3, slf with cli, fvcom, fort14, 2dm) and for SU2, with depths from data."""
import json
import re
import unittest

import h5py
import numpy as np

from check_test import check, check_damaged
from coast_readers import Fvcom, Gr3, Slf, Su2
from fields_test import write_ascii
from format_readers import Expected, rows
from trime_run import WorkspaceCase, run

FILE, INCOMPLETE = 4, 5
# A bay with an open side, and an island in it.
LINES = {"coast": [[1, 1], [0, 1], [0, 0], [1, 0]], "open sea": [[1, 0], [1, 1]],
         "island": [[0.4, 0.4], [0.6, 0.4], [0.6, 0.6], [0.4, 0.6], [0.4, 0.4]]}
CONFIG = """[shape]
geometry = bay
[shape.bay]
type = contour
file = bay.geojson
attribute = kind
[field.elevation]
file = ground.asc
[meshing]
points = 800
[output]
formats = vtkhdf xdmf gr3 slf fvcom fort14 2dm su2
depth = 1 - elevation
overwrite = true
"""
FILES = ["bay.gr3", "bay.slf", "bay.cli", "bay.14", "bay.2dm", "bay.su2", "bay_grd.dat", "bay_dep.dat", "bay_obc.dat"]
BESIDE = ("bay.cli", "bay_dep.dat", "bay_obc.dat")  # written with another file


def elevation(points):
    """What the raster holds, which is bilinear."""
    return -30 * points[:, 0] - 5 + 2 * points[:, 1]


class CoastFormats(WorkspaceCase):
    def setUp(self):
        super().setUp()
        (self.directory / "bay.geojson").write_text(json.dumps({"type": "FeatureCollection", "features": [
            {"type": "Feature", "properties": {"kind": kind}, "geometry": {"type": "LineString", "coordinates": line}}
            for kind, line in LINES.items()]}))
        (self.directory / "bay.ini").write_text(CONFIG + f"directory = {self.directory}\n")
        centres = np.arange(6) * 0.25 - 0.125
        write_ascii(self.directory / "ground.asc",
                    [elevation(np.column_stack([centres, np.full(6, y)])).tolist() for y in centres],
                    corner=(-0.25, -0.25), cell=0.25)

    def mesh(self, *overrides, ranks=1, threads=1):
        done = run(self.directory / "bay.ini", *overrides, ranks=ranks, threads=threads)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done

    def files(self):
        """Their bytes; the first line of some names the path."""
        return {name: (self.directory / name).read_bytes() for name in FILES}

    def test_each_format_holds_the_mesh(self):
        done = self.mesh(ranks=2)
        self.assertRegex(done.stdout, r"gr3: open boundary: bay\.open sea; land boundary: bay\.coast, bay\.island")
        self.assertRegex(done.stdout, r"fvcom: open boundary: bay\.open sea; land boundary: bay\.coast, bay\.island")
        self.assertRegex(done.stdout, r"the reference system .* is unknown, so there is no file _cor\.dat")
        self.assertRegex(done.stdout, r"depths from [\d.]+ to [\d.]+; 0 of \d+ points have a negative depth")
        expected = Expected(self.directory / "bay.h5")
        depth = 1 - elevation(expected.points)
        with h5py.File(self.directory / "bay.h5") as file:
            np.testing.assert_allclose(file["VTKHDF/PointData/depth"][:], depth, rtol=1e-9)
        gr3, slf, su2, fvcom = (kind(self.directory / f"bay{ending}") for kind, ending in
                                ((Gr3, ".gr3"), (Slf, ".slf"), (Su2, ".su2"), (Fvcom, "_grd.dat")))
        for read in (gr3, slf, su2, fvcom):
            np.testing.assert_array_equal(read.points, expected.points)
            np.testing.assert_array_equal(read.triangles, expected.triangles)
        np.testing.assert_allclose(gr3.depth, depth, rtol=1e-9)
        np.testing.assert_array_equal(slf.values[0], -gr3.depth)
        self.assertEqual([name.split() for name in slf.variables], [[b"BOTTOM", b"M"]])
        fort14 = (self.directory / "bay.14").read_text().splitlines()[2:2 + len(depth)]
        self.assertEqual([float(line.split()[3]) for line in fort14], gr3.depth.tolist())
        heights = [float(line.split()[4]) for line in (self.directory / "bay.2dm").read_text().splitlines()
                   if line.startswith("ND ")]
        self.assertEqual(heights, (-gr3.depth).tolist())
        np.testing.assert_array_equal(fvcom.depth, gr3.depth)
        self.assertIsNone(fvcom.latitudes)
        self.assertEqual([fvcom.obc.tolist()], [points for _, _, points in gr3.open])
        self.compare_boundaries(expected, gr3, slf, su2)

    def compare_boundaries(self, expected, gr3, slf, su2):
        self.assertEqual([name for name, _, _ in gr3.open], ["bay.open sea"])
        self.assertEqual(sorted((name, kind) for name, kind, _ in gr3.land), [("bay.coast", 0), ("bay.island", 1)])
        edges, labels = [], []
        for name, kind, points in gr3.open + gr3.land:
            ring = points + points[:1] if kind == 1 else points  # without its first point at the end
            edges += list(zip(ring, ring[1:]))
            labels += [expected.parts[name]] * (len(ring) - 1)
        self.assertEqual(rows(np.array(edges), labels), expected.rim_rows())
        parts = {name.replace(" ", "_").replace(".", "_"): label for name, label in expected.parts.items()}
        found = [(edge, parts[name]) for name, marked in su2.markers.items() for edge in marked]
        self.assertEqual(rows(np.array([edge for edge, _ in found]), [label for _, label in found]),
                         expected.rim_rows())
        # Rings: the outer one first, from the lowest x + y, then the island; the mesh lies on the left of both.
        np.testing.assert_array_equal(slf.number[slf.rim], np.arange(len(slf.rim)) + 1)
        self.assertEqual(np.count_nonzero(slf.number), len(slf.rim))
        outer = next(k for k in range(len(slf.rim)) if abs(slf.points[slf.rim[k]] - 0.5).max() < 0.2)
        rings = [slf.rim[:outer], slf.rim[outer:]]
        self.assertEqual(rows(np.array([(a, b) for ring in rings for a, b in zip(ring, np.roll(ring, -1))]),
                              np.zeros(len(slf.rim), int)), rows(expected.rim, np.zeros(len(expected.rim), int)))
        self.assertEqual(slf.points[slf.rim[0]].tolist(), [0, 0])
        is_open = np.isin(slf.rim, expected.rim[expected.labels == expected.parts["bay.open sea"]])
        self.assertEqual({tuple(code) for code in slf.codes[is_open]}, {(5, 4, 4, 4)})
        self.assertEqual({tuple(code) for code in slf.codes[~is_open]}, {(2, 2, 2, 2)})

    def test_the_bytes_do_not_depend_on_ranks(self):
        self.mesh()
        expected = self.files()
        for ranks, threads in ((2, 1), (3, 2), (7, 1)):
            self.mesh(ranks=ranks, threads=threads)
            self.assertEqual(self.files(), expected)
        for name in (name for name in FILES if name not in BESIDE):
            (self.directory / "again").mkdir(exist_ok=True)
            done = run("convert", self.directory / "bay.h5", self.directory / "again" / name, ranks=2)
            self.assertEqual(done.returncode, 0, done.stderr)
        for name in FILES:
            again = (self.directory / "again" / name).read_bytes()
            if name.endswith((".gr3", ".14")):  # the first line is the path
                again, expected[name] = (text.split(b"\n", 1)[1] for text in (again, expected[name]))
            self.assertEqual(again, expected[name], name)

    def test_open_boundaries_of_fvcom(self):
        """Two open parts that meet share a point; a whole ring is open; no part is open."""
        for chosen, parts in (("open sea, coast", 2), ("island", 1), ("none", 0)):
            self.mesh("output.formats=vtkhdf xdmf fvcom gr3", f"output.open_boundary={chosen}", ranks=3)
            fvcom, gr3 = Fvcom(self.directory / "bay_grd.dat"), Gr3(self.directory / "bay.gr3")
            self.assertEqual(len(gr3.open), parts)
            self.assertEqual(set(fvcom.obc), {point for _, _, points in gr3.open for point in points})
            edges = {tuple(sorted(edge)) for row in fvcom.triangles for edge in zip(row, np.roll(row, -1))}
            breaks = [pair for pair in zip(fvcom.obc, fvcom.obc[1:]) if tuple(sorted(pair)) not in edges]
            self.assertLessEqual(len(breaks), 1 if parts == 2 else 0)  # neighbours in the list are neighbours

    def test_the_latitudes_of_fvcom(self):
        (self.directory / "bay.geojson").write_text(json.dumps({"type": "Polygon", "coordinates": [
            [[8, 54], [9, 54], [9, 55], [8, 55], [8, 54]]]}))
        (self.directory / "bay.ini").write_text(
            "[shape]\ngeometry = bay\nprojection = auto\n[shape.bay]\ntype = contour\nfile = bay.geojson\n"
            "[meshing]\npoints = 300\n[output]\nformats = vtkhdf xdmf fvcom\noverwrite = true\n"
            f"directory = {self.directory}\n")
        self.mesh()
        plane = Fvcom(self.directory / "bay_grd.dat")
        self.mesh("output.coordinates=degrees", ranks=2)
        degrees = Fvcom(self.directory / "bay_grd.dat")
        np.testing.assert_array_equal(plane.latitudes, degrees.latitudes)
        np.testing.assert_array_equal(degrees.points[:, 1], degrees.latitudes)
        np.testing.assert_array_equal(plane.triangles, degrees.triangles)
        self.assertTrue((abs(degrees.points - [8.5, 54.5]) < 0.5 + 1e-6).all())
        self.assertGreater(np.ptp(plane.points[:, 1]), 1e5)  # metres
        self.assertFalse(plane.depth.any() or len(plane.obc))
        self.check_latitudes_of_a_mesh_without_a_map()

    def check_latitudes_of_a_mesh_without_a_map(self):
        """FVCOM would use those of the mesh before, which are refused, or removed with overwrite."""
        latitudes = self.directory / "bay_cor.dat"
        old, kept = latitudes.read_bytes(), [self.directory / f"bay_{kind}.dat" for kind in ("grd", "dep", "obc")]
        flat = ("output.overwrite=false", "shape.projection=none")
        for path in (*kept, *self.directory.glob("bay.[hxv]*")):
            path.unlink()
        done = run(self.directory / "bay.ini", *flat, ranks=2)
        self.assertEqual(done.returncode, FILE, done.stdout + done.stderr)
        self.assertRegex(done.stderr, "bay_cor.dat exists; set output.overwrite = true to replace it")
        self.assertEqual(latitudes.read_bytes(), old)
        self.mesh("shape.projection=none", ranks=2)
        self.assertIsNone(Fvcom(kept[0]).latitudes)
        for path in kept:
            path.unlink()
        latitudes.write_bytes(old)
        convert = ("convert", self.directory / "bay.h5", kept[0])
        done = run(*convert)
        self.assertEqual(done.returncode, FILE, done.stderr)
        self.assertRegex(done.stderr, "bay_cor.dat exists; add --overwrite to replace it")
        self.assertEqual(run(*convert, "--overwrite", ranks=2).returncode, 0)
        self.assertIsNone(Fvcom(kept[0]).latitudes)

    def test_the_checker_reads_depths_and_finds_bad_ones(self):
        self.mesh("output.formats=vtkhdf xdmf")
        self.assertIn("depth", (self.directory / "bay.xdmf").read_text())
        path = self.directory / "bay.h5"
        self.assertEqual(check(path)[0], 0)

        def damage(file):
            file["VTKHDF/PointData/depth"][7] = np.nan

        code, said = check_damaged(path, self.directory / "bad.h5", damage)
        self.assertNotEqual(code, 0)
        self.assertIn("depth_array", said)

    def test_refine_keeps_the_depth_on_triangles(self):
        self.mesh("output.formats=vtkhdf")
        done = run("refine", self.directory / "bay.h5", self.directory / "fine.h5", ranks=3)
        self.assertEqual(done.returncode, 0, done.stderr)
        with h5py.File(self.directory / "fine.h5") as file:
            points, depth = file["VTKHDF/Points"][:, :2], file["VTKHDF/PointData/depth"][:]
        np.testing.assert_allclose(depth, 1 - elevation(points), rtol=1e-9)

    def test_courant_numbers(self):
        """sqrt(9.81 depth) time_step / shortest edge, by NumPy; the same on all ranks."""
        said = set()
        for ranks in (1, 3):
            done = self.mesh("output.formats=vtkhdf xdmf", "output.time_step=0.002", "output.courant=1.1", ranks=ranks)
            said.add(next(line for line in done.stdout.splitlines() if line.startswith("Courant")))
        self.assertEqual(len(said), 1)
        with h5py.File(self.directory / "bay.h5") as file:
            points, triangles = file["Mesh/mesh/geometry"][:], file["Mesh/mesh/topology"][:]
            depth, found = file["VTKHDF/PointData/depth"][:], dict(file["trime_mpi/courant"].attrs)
        at = points[triangles]
        shortest = np.linalg.norm(at - np.roll(at, -1, axis=1), axis=2).min(axis=1)
        number = 0.002 * np.sqrt(9.81 * np.maximum(0, depth[triangles].mean(axis=1))) / shortest
        self.assertEqual(found["above"], np.count_nonzero(number > 1.1))
        self.assertTrue(0 < found["above"] < len(number))
        self.assertAlmostEqual(found["largest"], number.max())
        centre = at[number.argmax()].mean(axis=0)
        np.testing.assert_allclose([found["largest_x"], found["largest_y"]], centre)
        done = run(self.directory / "bay.ini", "output.time_step=1", "output.depth=none")
        self.assertEqual(done.returncode, 2)
        self.assertIn("needs 'depth'", done.stderr)

    def test_courant_numbers_do_not_count_dry_triangles(self):
        done = self.mesh("output.formats=vtkhdf xdmf", "output.depth=x-0.5", "output.time_step=0.01", ranks=2)
        with h5py.File(self.directory / "bay.h5") as file:
            triangles, depth = file["Mesh/mesh/topology"][:], file["VTKHDF/PointData/depth"][:]
            found = dict(file["trime_mpi/courant"].attrs)
        dry = np.count_nonzero(~(depth[triangles].mean(axis=1) > 0))
        self.assertEqual(found["dry"], dry)
        self.assertTrue(0 < dry < len(triangles))
        self.assertRegex(done.stdout, f" of {len(triangles) - dry} triangles .*; {dry} dry triangles .* not counted")

    def test_depths_of_the_wrong_sign_are_reported(self):
        """By the run, its report and `info`, and before a mesh is made."""
        report = self.directory / "report.json"
        done = self.mesh("output.formats=vtkhdf xdmf", "output.depth=elevation", "output.time_step=1",
                         "output.accept=telemac, fvcom", "--report", report, ranks=2)
        with h5py.File(self.directory / "bay.h5") as file:
            points, triangles = len(file["Mesh/mesh/geometry"]), len(file["Mesh/mesh/topology"])
        told = (rf"'elevation' is not positive at {points} of {points} points of the mesh.*depths are positive "
                "downwards.*write 'depth = -elevation'")
        self.assertRegex(done.stdout, "warning: .*" + told)
        self.assertRegex(done.stdout, rf"Courant numbers .*: none, since none of {triangles} triangles has a positive")
        said = json.loads(report.read_text())
        self.assertTrue(any(re.search(told, warning) for warning in said["warnings"]), said["warnings"])
        self.assertEqual(said["groups"]["depth"]["attributes"]["positive"], 0)
        self.assertEqual(said["groups"]["courant"]["attributes"]["dry"], triangles)
        done = run("info", self.directory / "bay.h5")
        for words in (rf"depths +from -[\d.]+ to -[\d.]+, positive at 0 of {points} points",
                      rf"Courant +time step 1 s: {triangles} triangles without a positive depth",
                      "open boundary bay.open sea", r"fvcom +least_angle +>= 30 ", "shortest edge +0"):
            self.assertRegex(done.stdout, words)
        done = run(self.directory / "bay.ini", "output.depth=elevation", "--validate")
        self.assertRegex(done.stdout, r"'elevation' is not positive at (\d+) of \1 points where the shape was tried")
        done = run(self.directory / "bay.ini", "output.depth=sqrt(x-0.5)", "--dry-run", ranks=2)
        self.assertRegex(done.stdout, r"'sqrt\(x-0.5\)' is not a number at \d+ of \d+ points where the shape was tried")
        done = run(self.directory / "bay.ini", "--validate")
        self.assertNotIn("where the shape was tried", done.stdout)

    def test_keys_without_effect_are_reported(self):
        done = run(self.directory / "bay.ini", "output.courant=0.5", "field.elevation.smooth=1", "--validate")
        self.assertIn("'courant' in [output] has no effect without 'time_step'", done.stdout)
        self.assertIn("'smooth' in [field.elevation] has no effect: only the slope grad(elevation)", done.stdout)
        done = run(self.directory / "bay.ini", "output.accept=none telemac", "--validate")
        self.assertEqual(done.returncode, 2)
        self.assertIn("expected none, or a list of adcirc", done.stderr)

    def test_advice_for_sizes_that_are_lengths(self):
        """The island has less than three edges around."""
        lengths = ("meshing.points=", "sizing.scale=absolute", "sizing.max_size=0.3")
        for ranks in (1, 2):
            done = run(self.directory / "bay.ini", *lengths, "--dry-run", ranks=ranks)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertRegex(done.stdout, r"hole was filled.*Smaller sizes in \[sizing\] keep more")
            self.assertRegex(done.stdout, r"sizes that are [\d.]+ times smaller keep everything")
            self.assertNotIn("edge_length", done.stdout)

    def accepted(self, ranks, *overrides):
        """The table of rules as lists, and what the run said about them."""
        done = run(self.directory / "bay.ini", "output.formats=vtkhdf xdmf", *overrides, ranks=ranks)
        with h5py.File(self.directory / "bay.h5") as file:
            group = file["trime_mpi/accept"]
            table = {name: group[name].asstr()[:] if name in ("solver", "rule") else group[name][:] for name in group}
        return done, table

    def test_rules_of_models(self):
        """The same on all ranks, and the same as NumPy finds."""
        every = "output.accept=adcirc schism telemac fvcom delft3d mpas"
        first = None
        for ranks in (1, 2, 3):
            done, table = self.accepted(ranks, every)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            if first is None:
                first = table
            for name in table:
                np.testing.assert_array_equal(table[name], first[name], name)
        self.assertEqual(set(first["solver"]), {"adcirc", "schism", "telemac", "fvcom", "delft3d", "mpas"})
        with h5py.File(self.directory / "bay.h5") as file:
            points, triangles = file["Mesh/mesh/geometry"][:], file["Mesh/mesh/topology"][:]
            facets = file["Mesh/facets/topology"][:]
        at = points[triangles]
        along, back = np.roll(at, -1, axis=1) - at, np.roll(at, 1, axis=1) - at
        angles = np.degrees(np.arccos((along * back).sum(axis=2) / np.linalg.norm(along, axis=2)
                                      / np.linalg.norm(back, axis=2)))
        rim = {tuple(sorted(edge)) for edge in facets.tolist()}
        sides = [sum(tuple(sorted((t[k], t[k - 1]))) in rim for k in range(3)) for t in triangles.tolist()]

        def row(solver, rule):
            return int(np.flatnonzero((first["solver"] == solver) & (first["rule"] == rule))[0])

        least = row("fvcom", "least_angle")
        self.assertAlmostEqual(first["worst"][least], angles.min(), places=9)
        np.testing.assert_allclose([first["x"][least], first["y"][least]],
                                   at[np.unravel_index(angles.argmin(), angles.shape)[0]].mean(axis=0))
        self.assertEqual(first["worst"][row("fvcom", "boundary_edges")], max(sides))
        self.assertEqual(first["broken"][row("fvcom", "boundary_edges")], sum(count > 1 for count in sides))
        self.assertEqual(first["worst"][row("adcirc", "triangles_at_point")], np.bincount(triangles.ravel()).max())
        self.assertEqual(check(self.directory / "bay.h5")[0], 0)

    def test_triangles_with_two_boundary_edges_are_split(self):
        """In corners of 60 degrees and more; the corner at (2, 0) has less and keeps its one. All ranks agree."""
        def kite(degrees):
            half = np.radians(degrees / 2)
            self.write("kite.xy", [(0, 0), (np.cos(half), -np.sin(half)), (2, 0), (np.cos(half), np.sin(half))])

        def ears(split, ranks=1):
            (self.directory / "kite.ini").write_text(
                f"[shape]\ngeometry = kite\n[shape.kite]\ntype = contour\nfile = kite.xy\n[meshing]\n"
                f"edge_length = 0.05\nsplit_ears = {split}\n[output]\naccept = fvcom\noverwrite = true\n"
                f"directory = {self.directory}\n")
            done = run(self.directory / "kite.ini", ranks=ranks)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            with h5py.File(self.directory / "kite.h5") as file:
                group = file["trime_mpi/accept"]
                rules = dict(zip(group["rule"].asstr()[:], zip(group["broken"][:], group["worst"][:])))
                return (rules["boundary_edges"][0], rules["least_angle"][1], file["trime_mpi"].attrs["mesh_hash"])

        for degrees in (64, 70, 78):
            kite(degrees)
            self.assertEqual(ears("false")[0], 2)
            found = ears("true")
            self.assertEqual(found[0], 1, degrees)
            self.assertGreater(found[1], 30)
        for ranks in (2, 3):
            self.assertEqual(ears("true", ranks), found)
        kite(50)
        self.assertEqual(ears("true"), ears("false"))

    def test_a_rule_that_makes_a_model_refuse_the_mesh_marks_it(self):
        """SCHISM stops at an outer boundary that is open all along."""
        done, table = self.accepted(2, "output.accept=schism", "output.open_boundary=open sea, coast")
        self.assertEqual(done.returncode, INCOMPLETE, done.stdout + done.stderr)
        self.assertRegex(done.stdout + done.stderr, "schism: looped open boundary 1.*1 of 1 loops break this rule, and "
                                                    "schism refuses the mesh: give a part")
        self.assertEqual(table["broken"][table["rule"] == "looped_open_boundary"].tolist(), [1])
        self.assertEqual(check(self.directory / "bay.h5")[0], 0)
        done = run("refine", self.directory / "bay.h5", self.directory / "fine.h5", ranks=2)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("has neither these rules nor their checks", done.stdout + done.stderr)
        with h5py.File(self.directory / "fine.h5") as file:
            self.assertNotIn("accept", file["trime_mpi"])
        done = run(self.directory / "bay.ini", "output.accept=fvcomm")
        self.assertEqual(done.returncode, 2)
        self.assertIn("fvcom", done.stderr)

    def test_a_depth_that_is_no_number_marks_the_mesh(self):
        done = run(self.directory / "bay.ini", "output.depth=sqrt(x-0.5)", ranks=2)
        self.assertEqual(done.returncode, INCOMPLETE, done.stdout + done.stderr)
        self.assertRegex(done.stdout + done.stderr,
                         r"'sqrt\(x-0.5\)' is not a number at \d+ of \d+ points of the mesh, the first one at")

    def test_bad_formulas_are_refused(self):
        for formula, said in (("-elevatoin", "elevatoin"), ("1 +", "'depth' in \\[output\\]")):
            done = run(self.directory / "bay.ini", f"output.depth={formula}", ranks=2)
            self.assertEqual(done.returncode, 2, done.stdout)
            self.assertRegex(done.stderr, said)

    def test_a_wrong_name_in_the_depth_is_found_before_the_mesh_is_made(self):
        done = run(self.directory / "bay.ini", "output.depth=0.01*dist(cost)", ranks=2)
        self.assertEqual(done.returncode, 2, done.stdout)
        self.assertIn("cost", done.stderr)
        self.assertNotIn("Sweeps", done.stdout)

    def test_both_sides_of_a_crack_are_an_island(self):
        """They enclose no area, whatever the rounding says."""
        self.write("crack.xy", [(0.1, 0.2), (0.2, 0.233), (0.31, 0.29)])
        text = (self.directory / "bay.ini").read_text()
        (self.directory / "bay.ini").write_text("[curve.crack]\nfile = crack.xy\nsplit = true\n" + text)
        self.mesh("output.formats=vtkhdf xdmf gr3 slf", ranks=3)
        self.assertIn(("crack", 1), [(name, kind) for name, kind, _ in Gr3(self.directory / "bay.gr3").land])
        slf = Slf(self.directory / "bay.slf")
        self.assertEqual(slf.points[slf.rim[0]].tolist(), [0, 0])

    def test_a_field_for_the_depth_alone_leaves_the_size_relative(self):
        done = self.mesh("sizing.type=expression", "sizing.expression=1+x")
        self.assertNotIn("scale = absolute", done.stdout)


if __name__ == "__main__":
    unittest.main()
