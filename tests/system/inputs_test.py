#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests contours as users have them.

The program reads dirty files of every format, or refuses them with file and line, on 1 and 3 ranks alike. Markers of
segments and attributes of maps reach the edges of the mesh. A coast in longitude and latitude is meshed in a plane and
written back, and GDAL finds it at the right place.
"""
import collections
import concurrent.futures
import json
import math
import re
import subprocess
import unittest

import h5py
import numpy
import scipy.spatial
from osgeo import osr

from dirty_inputs import (FILE, GEOMETRY, HOLE, HOLED, NOT_REPAIRED, POLY, READ, REFUSED, REPAIRED, SQUARE, USAGE,
                          geojson, xy)
from rough_coast import rough_coast
from tiled_country import Country, as_geojson, name_of
from trime_run import Workspace, run

osr.UseExceptions()

CONFIG = "[shape]\ngeometry = land\n[shape.land]\ntype = contour\nfile = {}\n[meshing]\npoints = {}\n"
FAULTS = re.compile(r"found (\d+) faults")  # the first line of a message that lists a few


def gdal(*arguments):
    """Output of a program of GDAL."""
    return subprocess.run([str(word) for word in arguments], capture_output=True, text=True, check=True,
                          timeout=60).stdout


def shapefile(path, text):
    """A shapefile from GeoJSON."""
    source = path.with_suffix(".source.geojson")
    source.write_text(text)
    gdal("ogr2ogr", "-f", "ESRI Shapefile", path, source)


def coast_in_degrees():
    """The made coast west of Norway, as rings of [longitude, latitude], closed; 1 degree high."""
    return [[[round(4 + x / 128, 6), round(60 + y / 256, 6)] for x, y in ring + ring[:1]] for ring in rough_coast(3)]


def corners_of(rings, plane, angle=30):
    """Vertices of rings in degrees that turn by more than `angle` degrees in a plane, by GDAL's projection."""
    systems = osr.SpatialReference(), osr.SpatialReference()
    systems[0].ImportFromEPSG(4326)
    systems[1].ImportFromProj4(plane)
    for system in systems:
        system.SetAxisMappingStrategy(osr.OAMS_TRADITIONAL_GIS_ORDER)
    transform, count = osr.CoordinateTransformation(*systems), 0
    for ring in rings:
        x, y, _ = numpy.array(transform.TransformPoints(ring[:-1])).T
        steps = numpy.diff(numpy.append(x, x[0])) + 1j * numpy.diff(numpy.append(y, y[0]))
        count += int((numpy.abs(numpy.angle(steps / numpy.roll(steps, 1), deg=True)) > angle).sum())
    return count


def area_in_plane(ring, plane, pieces=500):
    """Area of a closed ring whose edges are straight in degrees, in a plane as PROJ names it, by GDAL's projection."""
    systems = osr.SpatialReference(), osr.SpatialReference()
    systems[0].ImportFromEPSG(4326)
    systems[1].SetFromUserInput(plane)
    for system in systems:
        system.SetAxisMappingStrategy(osr.OAMS_TRADITIONAL_GIS_ORDER)
    steps = numpy.arange(0, len(ring) - 1, 1 / pieces)
    places = numpy.array([numpy.interp(steps, range(len(ring)), column) for column in numpy.array(ring).T]).T
    x, y, _ = numpy.array(osr.CoordinateTransformation(*systems).TransformPoints(places)).T
    return abs((x * numpy.roll(y, -1) - numpy.roll(x, -1) * y).sum()) / 2


def fourfold(line):
    """`shape: area 0.64, ...` as (area, rest)."""
    return float(re.search(r"area (\S+),", line)[1]), line.split("boundary")[1]


class DirtyInputs(unittest.TestCase):
    """On 1 and 3 ranks the same words."""

    def validated(self, name, text, *options):
        """Returns what the program prints for a contour, on 1 and 3 ranks."""
        said = []
        with Workspace() as work:
            (work / name).write_bytes(text if isinstance(text, bytes) else text.encode())
            (work / "case.ini").write_text(CONFIG.format(name, 500))
            for ranks in (1, 3):
                done = run(work / "case.ini", "--validate", *options, ranks=ranks, cwd=work)
                shape = [line for line in done.stdout.splitlines() if line.startswith("shape:")]
                told = [line.replace(str(work), "") for line in (done.stderr + done.stdout).splitlines()
                        if ("warning" in line or "error" in line) and "share their cores" not in line]
                said.append((done.returncode, shape, told))
        self.assertEqual(said[0], said[1])
        return said[0]

    def all_validated(self, table):
        """Returns what validated() returns for each row; two rows run at a time."""
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            return list(pool.map(lambda row: self.validated(row[1], row[2]), table))

    def test_read(self):
        for (what, name, _, area), (code, shape, told) in zip(READ, self.all_validated(READ)):
            with self.subTest(what=what, file=name):
                self.assertEqual(code, 0, told)
                self.assertAlmostEqual(fourfold(shape[0])[0], area, 9)

    def test_refused(self):
        for (what, name, _, code, message), (found, _, told) in zip(REFUSED, self.all_validated(REFUSED)):
            with self.subTest(what=what, file=name):
                self.assertEqual(found, code, told)
                self.assertEqual(len(told), 1 if len(told) == 1 else 1 + int(FAULTS.search(told[0])[1]), told)
                self.assertRegex("\n".join(told), message)

    def test_what_has_no_area_is_listed_or_left_out(self):
        for what, name, text, area, words in REPAIRED:
            with self.subTest(what):
                code, _, told = self.validated(name, text)
                self.assertEqual(code, GEOMETRY, told)
                self.assertRegex("\n".join(told), words)
                self.assertIn("repair = true", "\n".join(told))
                code, shape, told = self.validated(name, text, "shape.land.repair=true")
                self.assertEqual(code, 0, told)
                self.assertRegex("\n".join(told), rf"warning: .*{re.escape(name)}")
                self.assertAlmostEqual(fourfold(shape[0])[0], area, 9)

    def test_what_has_area_is_never_left_out(self):
        for what, name, text in NOT_REPAIRED:
            with self.subTest(what):
                code, _, told = self.validated(name, text, "shape.land.repair=true")
                self.assertEqual(code, GEOMETRY, told)
                self.assertRegex(told[0], rf"error: .*{re.escape(name)}")

    def test_all_faults_are_in_one_message(self):
        spikes = [line for k in range(1, 13) for line in (f"{0.07 * k:.2f} 0", f"{0.07 * k:.2f} -0.2",
                                                          f"{0.07 * k:.2f} 0")]
        text = xy(["0 0", *spikes, "1 0", "1 1", "0 1"])
        with Workspace() as work:
            (work / "a.xy").write_text(text)
            (work / "case.ini").write_text(CONFIG.format("a.xy", 500))
            refused = run(work / "case.ini", "--validate", cwd=work)
        self.assertEqual(refused.returncode, GEOMETRY, refused.stderr)
        self.assertEqual(refused.stderr.count("straight back"), 10, refused.stderr)
        self.assertIn("found 12 faults", refused.stderr)
        self.assertIn("and 2 more", refused.stderr)
        self.assertEqual(self.validated("a.xy", text, "shape.land.repair=true")[0], 0)

    def test_there_are_thirty(self):
        self.assertGreaterEqual(len(READ) + len(REFUSED), 30)

    def test_what_is_left_out_is_told(self):
        for text, message in (("region attributes", r":\d+: region points do not change the shape"),
                              ("region attributes", r":11: this vertex lies on no segment"),
                              ("no section of holes", r":7: 1 ring has no hole point inside")):
            row = next(row for row in READ if text in row[0] and row[1] == "a.poly")
            self.assertRegex("\n".join(self.validated(row[1], row[2])[2]), message)

    def test_damaged_shapefiles(self):
        with Workspace() as work:
            (work / "case.ini").write_text(CONFIG.format("a.shp", 500))
            shapefile(work / "a.shp", geojson(SQUARE + SQUARE[:1], HOLE + HOLE[:1]))
            whole = (work / "a.shp").read_bytes()
            done = run(work / "case.ini", "--validate", ranks=3)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertAlmostEqual(fourfold(done.stdout[done.stdout.index("shape:"):])[0], HOLED, 9)
            for ranks in (1, 3):
                (work / "a.shp").write_bytes(whole[:150])
                done = run(work / "case.ini", "--validate", ranks=ranks)
                self.assertEqual(done.returncode, FILE, done.stdout + done.stderr)
                self.assertRegex(done.stderr, r"a\.shp:1: the record is damaged")
                (work / "a.shp").write_bytes(b"nothing of the kind" * 20)
                done = run(work / "case.ini", "--validate", ranks=ranks)
                self.assertEqual(done.returncode, FILE, done.stdout + done.stderr)
                self.assertRegex(done.stderr, r"a\.shp is not a shapefile")
                (work / "a.shp").write_bytes(whole)
                index = (work / "a.shx").read_bytes()  # says that it has 200 million records
                (work / "a.shx").write_bytes(index[:24] + (50 + 4 * 200_000_000).to_bytes(4, "big") + index[28:])
                done = run(work / "case.ini", "--validate", ranks=ranks)
                self.assertEqual(done.returncode, FILE, done.stdout + done.stderr)
                self.assertRegex(done.stderr, r"a\.shx is damaged or cut off: expected 1600000100 bytes.*found 108")
                (work / "a.shx").write_bytes(index)


class Markers(unittest.TestCase):
    def test_markers_of_segments_are_those_of_edges(self):
        """The right side of the square has a separate marker, though the boundary does not turn at the vertex in its
        middle."""
        text = POLY.replace("8 2 0 0", "9 2 0 0").replace("8 0.4 0.6\n", "8 0.4 0.6\n9 0.5 0.1\n")
        text = text.replace("8 1\n1 1 2 1\n", "9 1\n1 1 9 1\n9 9 2 -4\n")
        with Workspace() as work:
            (work / "a.poly").write_text(text)
            (work / "case.ini").write_text(CONFIG.format("a.poly", 800))
            done = run(work / "case.ini", f"output.directory={work}", "output.formats=xdmf gmsh2", ranks=3)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            with h5py.File(work / "case.h5") as file:
                points, edges = file["Mesh/mesh/geometry"][:], file["Mesh/facets/topology"][:]
                markers, parts = file["Mesh/facets/markers"][:], file["Mesh/facets/parts"][:]
                tags = file["trime_mpi/tags"]
                names = [name.decode() for name in tags["part_name"]]
                self.assertEqual(names, ["land", "land.-4", "land.1", "land.2", "land.7"])
                numpy.testing.assert_array_equal(markers, tags["part_marker"][:][parts])
            x, y = points[edges].mean(axis=1).T
            expected = numpy.where((numpy.abs(x - 0.5) < 0.2) & (numpy.abs(y - 0.5) < 0.2), 7,
                                   numpy.where(x > 0.9 - 1e-9, 2, numpy.where((y < 0.1 + 1e-9) & (x > 0.5), -4, 1)))
            numpy.testing.assert_array_equal(markers, expected)
            self.assertIn(b'"land.-4"', (work / "case.msh2").read_bytes())


class Names(unittest.TestCase):
    """Attributes of the features of a map: a bay of two lines, with an island that has no kind."""
    LINES = [([[0.1, 0.1], [0.9, 0.1]], "open sea", 5), ([[0.9, 0.1], [0.9, 0.9], [0.1, 0.9], [0.1, 0.1]], "Küste", -2)]
    ISLAND = [[0.4, 0.4], [0.6, 0.4], [0.6, 0.6], [0.4, 0.6], [0.4, 0.4]]

    def collection(self):
        features = [({"type": "LineString", "coordinates": line}, {"kind": kind, "tag": tag})
                    for line, kind, tag in self.LINES] + [({"type": "LineString", "coordinates": self.ISLAND},
                                                           {"id": 1})]
        return json.dumps({"type": "FeatureCollection", "features": [
            {"type": "Feature", "geometry": geometry, "properties": properties}
            for geometry, properties in features]}, indent=1, ensure_ascii=False)

    def check(self, work, name, attribute, names, ranks):
        """Names and markers of the parts, and the edges that have them. Returns the hash of the mesh."""
        (work / "case.ini").write_text(CONFIG.format(name, 800) + f"[output]\ndirectory = {work}\n")
        done = run(work / "case.ini", f"shape.land.attribute={attribute}", "output.overwrite=true",
                   "output.formats=xdmf gmsh2 fort14", ranks=ranks)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        with h5py.File(work / "case.h5") as file:
            points, edges = file["Mesh/mesh/geometry"][:], file["Mesh/facets/topology"][:]
            tags = file["trime_mpi/tags"]
            self.assertEqual({name.decode(): int(marker)
                              for name, marker in zip(tags["part_name"], tags["part_marker"])},
                             names)
            of_edge = [tags["part_name"][part].decode() for part in file["Mesh/facets/parts"][:]]
            found = int(file["trime_mpi"].attrs["mesh_hash"])
        by_marker = {marker: part for part, marker in names.items()}
        x, y = points[edges].mean(axis=1).T
        expected = numpy.where((numpy.abs(x - 0.5) < 0.2) & (numpy.abs(y - 0.5) < 0.2), by_marker[0],
                               numpy.where(y < 0.1 + 1e-9, by_marker[self.sea(names)], by_marker[self.coast(names)]))
        self.assertEqual(of_edge, list(expected))
        return found

    def sea(self, names):
        return 5 if 5 in names.values() else 1

    def coast(self, names):
        return -2 if -2 in names.values() else 2

    def test_texts_are_names_and_integers_markers(self):
        with Workspace() as work:
            (work / "a.geojson").write_text(self.collection())
            shapefile(work / "a.shp", self.collection())
            gdal("ogr2ogr", "-f", "ESRI Shapefile", "-lco", "ENCODING=ISO-8859-1", work / "latin.shp",
                 work / "a.geojson")
            texts = {"land": 0, "land.open sea": 1, "land.Küste": 2}
            numbers = {"land": 0, "land.5": 5, "land.-2": -2}
            found = {self.check(work, name, "kind", texts, ranks)
                     for name, ranks in (("a.geojson", 3), ("a.shp", 1), ("latin.shp", 1))}
            self.assertIn("= open boundaries", (work / "case.14").read_text())
            self.assertRegex((work / "case.14").read_text(), r"1 = open boundaries\n.*\n\d+ = land\.open sea\n")
            self.assertIn('"land.Küste"'.encode(), (work / "case.msh2").read_bytes())
            found |= {self.check(work, name, "tag", numbers, ranks) for name, ranks in (("a.geojson", 1), ("a.shp", 3))}
            self.assertEqual(len(found), 1)

    def test_multipolygons_with_holes(self):
        """As QGIS writes them: a reference system, several polygons of one name, holes, no name, no geometry."""
        def ring(x, y, side):
            return [[x, y], [x + side, y], [x + side, y + side], [x, y + side], [x, y]]
        parts = [([[ring(0, 0, 40), ring(5, 5, 10), ring(20, 20, 15)], [ring(50, 0, 10)]], "Küste"),
                 ([[ring(50, 20, 20), ring(55, 25, 8)]], "isle"), ([[ring(22, 22, 6)]], None)]
        text = json.dumps({"type": "FeatureCollection", "name": "islands", "xy_coordinate_resolution": 1e-15,
                           "crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::32632"}},
                           "features": [{"type": "Feature", "properties": {"fid": 7, "name": name}, "geometry":
                                         {"type": "MultiPolygon", "coordinates": polygons}}
                                        for polygons, name in parts] +
                           [{"type": "Feature", "properties": {"fid": 9, "name": "gone"}, "geometry": None}]},
                          ensure_ascii=False)
        lengths = {"land": 4 * 6, "land.Küste": 4 * (40 + 10 + 15 + 10), "land.isle": 4 * (20 + 8)}
        found = set()
        with Workspace() as work:
            (work / "a.geojson").write_text(text)
            shapefile(work / "a.shp", text)
            for name, ranks in (("a.geojson", 3), ("a.shp", 1)):
                (work / "case.ini").write_text(CONFIG.format(name, 1500))
                done = run(work / "case.ini", "shape.land.attribute=name", f"output.directory={work}",
                           "output.overwrite=true", ranks=ranks)
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                with h5py.File(work / "case.h5") as file:
                    points, edges = file["Mesh/mesh/geometry"][:], file["Mesh/facets/topology"][:]
                    parts_of_edges, tags = file["Mesh/facets/parts"][:], file["trime_mpi/tags"]
                    names = [name.decode() for name in tags["part_name"]]
                    self.assertEqual(set(names), {"land", "land.Küste", "land.isle"})
                    self.assertEqual(sorted(tags["edge_kind"][:].tolist()), 3 * [b"hole"] + 4 * [b"outer"])
                    found.add(int(file["trime_mpi"].attrs["mesh_hash"]))
                    self.assertRegex(file["trime_mpi"].attrs["crs"].decode(), "32632|UTM_Zone_32N")
                long = numpy.linalg.norm(points[edges[:, 1]] - points[edges[:, 0]], axis=1)
                for number, name in enumerate(names):
                    self.assertAlmostEqual(long[parts_of_edges == number].sum(), lengths[name], 9)
        self.assertEqual(len(found), 1)

    def test_refused(self):
        with Workspace() as work:
            (work / "a.geojson").write_text(self.collection())
            shapefile(work / "a.shp", self.collection())
            (work / "a.xy").write_text(xy(SQUARE))
            for name, message in (("a.geojson", r"a\.geojson: .*attribute 'sort', found only id, kind, tag"),
                                  ("a.shp", r"a\.shp: .*attribute 'sort', found only id, kind, tag"),
                                  ("a.xy", r"a\.xy: expected a \.geojson or \.shp")):
                (work / "case.ini").write_text(CONFIG.format(name, 500))
                for ranks in (1, 3):
                    done = run(work / "case.ini", "--validate", "shape.land.attribute=sort", ranks=ranks)
                    self.assertEqual(done.returncode, USAGE, done.stdout + done.stderr)
                    self.assertRegex(done.stderr, message)
            (work / "a.dbf").unlink()
            done = run(work / "case.ini", "--validate", f"shape.land.file={work}/a.shp", "shape.land.attribute=kind")
            self.assertEqual(done.returncode, FILE, done.stdout + done.stderr)
            self.assertRegex(done.stderr, r"a\.dbf, which has the attributes of .*a\.shp")


class Maps(unittest.TestCase):
    def mesh(self, work, name, *overrides, ranks=1):
        """The mesh of a contour file; its hash."""
        (work / "case.ini").write_text(CONFIG.format(name, 3000))
        done = run(work / "case.ini", f"output.directory={work}", "output.overwrite=true", "--verbose", *overrides,
                   ranks=ranks)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        with h5py.File(work / "case.h5") as file:
            return int(file["trime_mpi"].attrs["mesh_hash"]), done

    def places(self, path):
        """Triangles and edges of an exported file, in degrees."""
        features = json.loads(path.read_text())["features"]
        kinds = {"triangle": [], "edge": []}
        for feature in features:
            kinds[feature["properties"]["kind"]].append(feature["geometry"]["coordinates"])
        return numpy.array(kinds["triangle"])[:, 0], numpy.array(kinds["edge"])

    def test_a_coast_in_degrees(self):
        rings = coast_in_degrees()
        text = json.dumps({"type": "Polygon", "coordinates": rings}, indent=1)
        auto = ["shape.projection=auto", "meshing.simplify_within=0", "meshing.points=6000"]  # every curve stays
        with Workspace() as work:
            (work / "coast.geojson").write_text(text)
            shapefile(work / "coast.shp", text)
            (work / "coast.xy").write_text("\n".join("".join(f"{x} {y}\n" for x, y in ring) for ring in rings))
            hashes = {self.mesh(work, "coast.shp", *auto, ranks=3)[0], self.mesh(work, "coast.xy", *auto)[0]}
            found, done = self.mesh(work, "coast.geojson", *auto, "output.formats=vtkhdf xdmf geojson", ranks=3)
            self.assertEqual(hashes, {found})
            self.assertRegex(done.stdout, r"projection: \+proj=stere \+lat_0=60\.\d+ \+lon_0=[45]")
            self.assertRegex(done.stdout, r"worst triangle at .* \[.*coast\.geojson:\d+: "
                                          r"longitude [456]\.\d+, latitude 6[01]\.\d+\]")
            with h5py.File(work / "case.h5") as file:
                self.assertTrue(file["trime_mpi"].attrs["crs"].startswith(b"+proj=stere"))
                self.assertIn("Stereographic", file["trime_mpi/crs_wkt"][()].decode())
                points, ends = file["Mesh/mesh/geometry"][:], file["Mesh/facets/topology"][:]
                is_corner = file["VTKHDF/PointData/fixed"][:] == 1
                left_out = int(file["trime_mpi"].attrs["corners_left_out"])
                self.assertEqual(set(file["trime_mpi/rings/state"][:]), {b"kept"})
                plane = file["trime_mpi"].attrs["crs"].decode()
                quality = dict(file["trime_mpi/quality"].attrs)
            self.assertLess(numpy.abs(points).max(), 1e5)  # metres from the middle
            triangles, edges = self.places(work / "case.geojson")
            middle = (quality["shortest_edge_longitude"], quality["shortest_edge_latitude"])
            self.assertLess(numpy.abs(triangles.reshape(-1, 2) - middle).max(axis=1).min(),  # half an edge, in degrees
                            quality["shortest_edge"] / 2 / 5e4)
            vertices = numpy.concatenate([ring[:-1] for ring in rings])
            corners = {point: place for points, places in zip(ends, edges) for point, place in zip(points, places)
                       if is_corner[point]}  # each a vertex of the coast, and no other one a corner
            nearest = [numpy.abs(vertices - place).max(axis=1) for place in corners.values()]
            self.assertLess(max(distances.min() for distances in nearest), 1e-9)
            self.assertEqual(len({int(distances.argmin()) for distances in nearest}), len(corners))
            self.assertEqual(len(corners), is_corner.sum())
            self.assertEqual(len(corners) + left_out, corners_of(rings, plane))
            self.assertGreater(len(corners), 500)
            self.assertGreater(len(triangles), 8000)
            written = (work / "case.geojson").read_bytes()
            for ranks in (1, 2):
                done = run("convert", work / "case.h5", work / "again.geojson", "--overwrite", ranks=ranks)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertEqual((work / "again.geojson").read_bytes(), written)
            told = gdal("ogrinfo", "-ro", "-al", "-so", work / "case.geojson")
            extent = [float(word) for word in re.search(r"Extent: \((\S+), (\S+)\) - \((\S+), (\S+)\)", told).groups()]
            low, high = vertices.min(axis=0), vertices.max(axis=0)
            numpy.testing.assert_allclose(extent, [*low, *high], atol=0.05)
            self.assertRegex(told, r'ID\["EPSG",4326\]|WGS 84')
            self.assertIn(f"Feature Count: {len(triangles) + len(edges)}", told)

    def test_polygons_of_one_map_are_united(self):
        def square(x, y, side):
            return [[x, y], [x + side, y], [x + side, y + side], [x, y + side], [x, y]]

        def feature(name, *rings):
            return {"type": "Feature", "properties": {"name": name},
                    "geometry": {"type": "Polygon", "coordinates": rings}}
        tiles = [feature("west" if i < 12 else "east", square(i, j, 1)) for i in range(25) for j in range(20)]
        gap = [[5, 0], [10, 0], [10, 5], [5, 5], [5.001, 2.5], [5, 0]]
        nested = [feature("a", square(0, 0, 5)), feature("b", square(3, 2, 5)), feature("c", square(1, 1, 1)),
                  feature("d", square(20, 0, 9), square(22, 2, 4)), feature("e", square(23, 3, 1))]
        cases = ((tiles, r"500 polygons are united .* 1 ring; .* length 955 and overlap by an area of 0\n", 1, 0, 500),
                 ([feature("a", square(0, 0, 5)), feature("b", square(5, 5, 5))], "2 polygons are united", 2, 0, 50),
                 ([feature("a", square(0, 0, 5)), feature("b", gap)], "2 polygons are united", 2, 0, 49.9975),
                 (nested, r"5 polygons are united .* 4 rings; .* overlap by an area of 7\n", 3, 1, 25 + 25 - 6 + 66))
        with Workspace() as work:
            (work / "case.ini").write_text("[shape]\ngeometry = land\n[shape.land]\ntype = contour\nattribute = name\n"
                                           "file = map.geojson\n[meshing]\npoints = 1000\n")
            for features, said, pieces, holes, area in cases:
                (work / "map.geojson").write_text(json.dumps({"type": "FeatureCollection", "features": features}))
                if pieces != 2:  # polygons that only touch are accepted in any case
                    done = run(work / "case.ini", "--validate")
                    self.assertEqual(done.returncode, 3)
                    self.assertIn("set 'overlap = union'", done.stderr)
                    self.assertRegex(done.stderr, r"geojson \(feature \d+, '\w+'\): an edge (crosses|touches) an edge "
                                                  r"of feature \d+, '\w+' near \(")
                done = run(work / "case.ini", "shape.land.overlap=union", "meshing.keep_features=true",
                           f"output.directory={work}", "output.overwrite=true", "--verbose")
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertRegex(done.stdout, said)
                self.assertRegex(done.stdout, rf"boundary: {pieces} components?, {holes} holes?")
                with h5py.File(work / "case.h5") as file:
                    points, triangles = file["Mesh/mesh/geometry"][:], file["Mesh/mesh/topology"][:]
                a, b, c = (points[triangles[:, k]] for k in range(3))
                made = ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]).sum() / 2
                if pieces != 2:  # polygons that touch are separated by strips that the mesh does not cover
                    self.assertAlmostEqual(made, area, delta=1e-6 * area)

    def test_districts_that_tile_a_country(self):
        """500 districts with the same vertices along common borders, and 200 with gaps and overlaps of 0.1 m."""
        plan = ["shape.projection=auto", "shape.land.overlap=union", "output.formats=vtkhdf xdmf",
                "meshing.simplify_within=0"]  # corners are vertices of the map
        with Workspace() as work:
            for districts, apart, gaps in ((500, 0, 0), (200, 1e-6, 1000)):
                country = Country(5, districts, apart)
                (work / "map.geojson").write_text(as_geojson(country))
                shapefile(work / "map.shp", (work / "map.geojson").read_text())
                found = set()
                for name, ranks in (("map.geojson", 2), ("map.shp", 1)):
                    (work / "case.ini").write_text(CONFIG.format(f"{name}\nattribute = name", 8000))
                    done = run(work / "case.ini", *plan, f"output.directory={work}", "output.overwrite=true",
                               "--verbose", ranks=ranks)
                    self.assertEqual(done.returncode, 0, done.stderr)
                    self.assertNotIn("touch", done.stdout)
                    self.assertIn(f"{districts} polygons are united into an outline of ", done.stdout)
                    closed = re.search(r": (\d+) gaps between polygons, narrower .* in area, are closed", done.stdout)
                    self.assertGreaterEqual(int(closed[1]) if closed else 0, gaps)
                    with h5py.File(work / "case.h5") as file:
                        found.add(int(file["trime_mpi"].attrs["mesh_hash"]))
                        points, triangles = file["Mesh/mesh/geometry"][:], file["Mesh/mesh/topology"][:]
                        ends, parts = file["Mesh/facets/topology"][:], file["Mesh/facets/parts"][:]
                        is_corner = file["VTKHDF/PointData/fixed"][:] == 1
                        of_shape = file["trime_mpi/rings/area"][:].sum()  # an outline without holes
                        names = [one.decode() for one in file["trime_mpi/tags/part_name"]]
                self.assertEqual(len(found), 1)
                a, b, c = (points[triangles[:, k]] for k in range(3))
                made = ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]).sum() / 2
                plane = re.search(r"projection: (.*)", done.stdout)[1]
                given = sum(area_in_plane(ring, plane, pieces=1) for ring in country.rings)
                self.assertAlmostEqual(of_shape / given, 1, delta=1e-6)
                self.assertAlmostEqual(made / given, 1, delta=5e-3)  # an edge of the mesh is longer than capes and bays
                done = run("convert", work / "case.h5", work / "case.2dm", "--degrees", "--overwrite")
                self.assertEqual(done.returncode, 0, done.stderr)
                places = numpy.array([line.split()[2:4] for line in (work / "case.2dm").read_text().splitlines()
                                      if line.startswith("ND ")], dtype=float)
                vertices = scipy.spatial.KDTree(numpy.concatenate(country.rings))
                self.assertGreater(is_corner.sum(), 50)
                back = vertices.query(places[is_corner])[0] < 1e-9
                self.assertEqual(back.sum(), len(back)) if apart == 0 else self.assertGreater(back.mean(), 0.98)
                owners = collections.defaultdict(set)  # names of the districts at each place
                for k, ring in enumerate(country.rings):
                    for place in ring:
                        owners[tuple(place)].add(f"land.{name_of(k)}")
                right = [names[part] in owners[tuple(numpy.round(places[pair[0]], 7))]
                         for pair, part in zip(ends, parts) if is_corner[pair[0]]]
                self.assertEqual(set(names[part] for part in parts), {f"land.{name_of(k)}" for k in range(7)})
                self.assertGreaterEqual(numpy.mean(right), 1 if apart == 0 else 0.98)

    def test_long_edges_are_straight_in_degrees(self):
        box = [[-13, 76], [13, 76], [13, 78], [-13, 78], [-13, 76]]
        land = [[-5.1, 76], [3, 76], [0, 77], [-5.1, 76]]
        cut = [[-5, 76], [7, 76], [5, 76.6], [0, 77], [-4, 76.4], [-5, 76]]
        config = ("[shape]\ngeometry = difference(box, land)\nprojection = auto\n[shape.box]\ntype = contour\n"
                  "file = box.geojson\n[shape.land]\ntype = contour\nfile = land.geojson\n[meshing]\npoints = 2000\n")
        with Workspace() as work:
            (work / "case.ini").write_text(config)
            (work / "box.geojson").write_text(json.dumps({"type": "Polygon", "coordinates": [box]}))
            for ring, corners in ((cut, 8), (cut[::-1], 8), (land, 7)):
                (work / "land.geojson").write_text(json.dumps({"type": "Polygon", "coordinates": [ring]}))
                done = run(work / "case.ini", f"output.directory={work}", "output.overwrite=true",
                           "output.formats=geojson", "--verbose")
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertRegex(done.stdout, r"\d+ long edges of the contours are divided by \d+ more vertices")
                self.assertIn("+lat_0=77 +lon_0=0 ", done.stdout)
                self.assertNotIn("warning", done.stdout + done.stderr)
                self.assertRegex(done.stdout, rf"boundary: 1 component, 0 holes, \d+ sites, {corners} corners")
                _, edges = self.places(work / "case.geojson")
                low = edges[numpy.abs(edges[:, :, 1] - 76).max(axis=1) < 0.01].reshape(-1, 2)
                self.assertLess(low[:, 0].min(), -12.9)  # along all of the parallel, to 1e-6 of 680 km
                self.assertLess(numpy.abs(low[:, 1] - 76).max(), 0.7 / 111e3)
                places = edges.reshape(-1, 2)
                for vertex in box[:4]:
                    self.assertLess(numpy.abs(places - vertex).max(axis=1).min(), 1e-9)

    def test_a_named_projection_is_that_of_gdal(self):
        square = [[9.0, 48.0], [9.4, 48.0], [9.4, 48.3], [9.0, 48.3], [9.0, 48.0]]
        text = json.dumps({"type": "Polygon", "coordinates": [square]})
        with Workspace() as work:
            shapefile(work / "a.shp", text)
            gdal("ogr2ogr", "-t_srs", "EPSG:32632", work / "utm.shp", work / "a.shp")
            gdal("ogr2ogr", "-t_srs", "EPSG:32632", work / "utm.geojson", work / "a.shp")
            projected, _ = self.mesh(work, "a.shp", "shape.projection=EPSG:32632")
            with h5py.File(work / "case.h5") as file:
                corners = file["Mesh/mesh/geometry"][:]
            for x, y in json.loads((work / "utm.geojson").read_text())["features"][0]["geometry"]["coordinates"][0]:
                self.assertLess(numpy.abs(corners - (x, y)).max(axis=1).min(), 1e-5)
            self.mesh(work, "utm.shp", "output.formats=xdmf geojson")  # as it is, with the system of its .prj
            _, edges = self.places(work / "case.geojson")
            for corner in square:
                self.assertLess(numpy.abs(edges - corner).max(axis=2).min(), 1e-9)
            self.assertNotEqual(projected, 0)

    def test_degrees_that_are_meshed_as_lengths_are_told(self):
        with Workspace() as work:
            shapefile(work / "a.shp", geojson(SQUARE + SQUARE[:1]))
            (work / "case.ini").write_text(CONFIG.format("a.shp", 500))
            self.assertRegex(run(work / "case.ini", "--validate").stdout,
                             r"warning: .*'projection = auto' in \[shape\]")
            (work / "a.prj").unlink()
            self.assertRegex(run(work / "case.ini", "--validate").stdout,
                             r"a\.shp does not say in which reference system .* 'projection = auto' in \[shape\]")
            (work / "far.geojson").write_text(geojson(["25 65", "26 65", "26 65.5", "25 65.5"]))
            self.assertRegex(run(work / "case.ini", "--validate", "shape.land.file=far.geojson").stdout,
                             r"warning: the coordinates of \S+far\.geojson are most likely longitude and latitude")
            self.assertRegex(run(work / "case.ini", "--validate", "sizing.min_size=200").stdout,
                             r"warning: min_size = 200 is longer than the whole shape.*a\.shp.*'projection = auto'")

    def test_a_projection_made_for_another_place_is_told(self):
        with Workspace() as work:
            (work / "a.geojson").write_text(geojson(["9 48", "9.4 48", "9.4 48.3", "9 48.3"]))
            (work / "case.ini").write_text(CONFIG.format("a.geojson", 500))
            for zone, told in ((32632, False), (32636, True)):
                said = run(work / "case.ini", "--validate", f"shape.projection=EPSG:{zone}").stdout
                (self.assertRegex if told else self.assertNotRegex)(
                    said, r"warning: 'projection = EPSG:\d+' stretches lengths by a factor of 1\.0\d "
                          r".* EPSG:32632 \(UTM zone 32\)")

    def test_a_part_that_is_not_used_may_lie_anywhere(self):
        with Workspace() as work:
            part = "[shape.{}]\ntype = circle\ncenter = {} {}\nradius = 0.4\n"
            (work / "case.ini").write_text("[domain]\nx_max = 1\n[shape]\ngeometry = disc\n" +
                                           part.format("disc", 0.5, 0.5) +
                                           part.format("far", 50, 50) + "[meshing]\npoints = 500\n")
            done = run(work / "case.ini", "--validate")
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            self.assertRegex(done.stdout,
                             "warning: the part 'far' does not occur in the geometry 'disc', so it is left out")

    def test_fixed_points_are_projected_too(self):
        with Workspace() as work:
            (work / "a.geojson").write_text(geojson(["9 48", "9.4 48", "9.4 48.3", "9 48.3"]))
            (work / "points.xy").write_text("9.1234 48.0987\n9.2 48.2\n")
            self.mesh(work, "a.geojson", "shape.projection=auto", f"meshing.fixed_points={work}/points.xy",
                      "output.formats=xdmf geojson", ranks=2)
            triangles, _ = self.places(work / "case.geojson")
            for place in ((9.1234, 48.0987), (9.2, 48.2)):
                self.assertLess(numpy.abs(triangles - place).max(axis=2).min(), 1e-9)

    def test_across_the_date_line(self):
        with Workspace() as work:
            (work / "a.geojson").write_text(geojson(["179 -17", "-179 -17", "-179 -16", "179 -16"]))
            self.mesh(work, "a.geojson", "shape.projection=auto")
            with h5py.File(work / "case.h5") as file:
                width = numpy.ptp(file["Mesh/mesh/geometry"][:, 0])
            self.assertAlmostEqual(width / (2 * 111320 * math.cos(math.radians(16.5))), 1, delta=0.01)

    def test_a_ring_across_the_date_line_without_projection(self):
        with Workspace() as work:
            (work / "a.geojson").write_text(geojson(["179 -17", "-179 -17", "-179 -16", "-179.5 -17.5", "179 -16"]))
            (work / "case.ini").write_text(CONFIG.format("a.geojson", 500))
            refused = run(work / "case.ini", "--validate", cwd=work)
        self.assertEqual(refused.returncode, GEOMETRY, refused.stderr)
        self.assertIn("set 'projection = auto' in [shape]", refused.stderr)
        self.assertNotIn("makevalid", refused.stderr)

    def test_polygons_that_are_cut_at_the_date_line_are_joined(self):
        def polygon(*rings):
            return {"type": "Polygon", "coordinates": [[[x, y] for x, y in ring + ring[:1]] for ring in rings]}

        def feature(name, geometry):
            return {"type": "Feature", "properties": {"name": name}, "geometry": geometry}
        # An island with a lake, cut as RFC 7946 asks, with vertices at other latitudes on the two sides.
        west = [(178, -18), (180, -18), (180, -17.5), (179.5, -17.2), (180, -17), (180, -16.4), (180, -16), (178, -16)]
        east = [(-180, -18), (-178.5, -17), (-180, -16), (-180, -17), (-179.5, -17.2), (-180, -17.5)]
        halves = [feature("west", polygon(west)), feature("east", polygon(east))]
        one = [feature("isle", {"type": "MultiPolygon", "coordinates": [polygon(ring)["coordinates"]
                                                                        for ring in (west, east)]})]
        far = [feature("other", polygon([(177, -18), (177.5, -18), (177.5, -17), (177, -17)]))]
        pole = [feature("ice", polygon([(180, -84.7), (180, -90), (-180, -90), (-180, -84.7), (-75, -80), (0, -75),
                                        (90, -80)]))]
        cases = ((halves, "auto", "error", 1, 1, {"west", "east"}), (one, "auto", "error", 1, 1, {"isle"}),
                 (halves, "auto", "union", 1, 1, {"west", "east"}),
                 (one + far, "EPSG:3832", "error", 2, 1, {"isle", "other"}),
                 (pole, "EPSG:3031", "error", 1, 0, {"ice"}))
        with Workspace() as work:
            for features, plane, overlap, pieces, holes, names in cases:
                (work / "map.geojson").write_text(json.dumps({"type": "FeatureCollection", "features": features}))
                (work / "case.ini").write_text(CONFIG.format("map.geojson\nattribute = name", 1000))
                done = run(work / "case.ini", f"shape.projection={plane}", "output.formats=xdmf geojson",
                           f"shape.land.overlap={overlap}", f"output.directory={work}", "output.overwrite=true",
                           "--verbose", ranks=2)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertRegex(done.stdout, "the polygons that meet at longitudes 180 and -180 are joined; they "
                                 + "share " + ("5.3 degrees" if features is pole else "1.5 degrees"))
                self.assertRegex(done.stdout, rf"boundary: {pieces} components?, {holes} holes?")
                with h5py.File(work / "case.h5") as file:
                    points, triangles = file["Mesh/mesh/geometry"][:], file["Mesh/mesh/topology"][:]
                a, b, c = (points[triangles[:, k]] for k in range(3))
                made = ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]).sum() / 2
                parts = [part for one in features for part in ([one["geometry"]["coordinates"]]
                         if one["geometry"]["type"] == "Polygon" else one["geometry"]["coordinates"])]
                plane_of = re.search(r"projection: (.*)", done.stdout)[1]
                self.assertAlmostEqual(made / sum(area_in_plane(part[0], plane_of) for part in parts), 1, delta=1e-3)
                found = json.loads((work / "case.geojson").read_text())["features"]
                properties = [one["properties"] for one in found if one["properties"]["kind"] == "edge"]
                self.assertEqual({one["name"] for one in properties}, {f"land.{name}" for name in names})

    def test_refused(self):
        with Workspace() as work:
            (work / "a.geojson").write_text(geojson(["9 48", "9.4 48", "9.4 48.3", "9 98.3"]))
            (work / "case.ini").write_text(CONFIG.format("a.geojson", 500))
            for ranks in (1, 3):
                for projection, code, message in (
                        ("auto", GEOMETRY, r"a\.geojson:\d+: the vertex \(9, 98\.3\) .*latitude"),
                        ("EPSG:1", USAGE, r"'projection = EPSG:1' in \[shape\]: .*EPSG:32633"),
                        ("EPSG:4326", USAGE, r"expected a system with coordinates in metres")):
                    if projection != "auto":
                        (work / "a.geojson").write_text(geojson(["9 48", "9.4 48", "9.4 48.3", "9 48.3"]))
                    else:
                        (work / "a.geojson").write_text(geojson(["9 48", "9.4 48", "9.4 48.3", "9 98.3"]))
                    done = run(work / "case.ini", "--validate", f"shape.projection={projection}", ranks=ranks)
                    self.assertEqual(done.returncode, code, done.stdout + done.stderr)
                    self.assertRegex(done.stderr, message)
            done = run(work / "case.ini", "--validate", "shape.projection=auto", "shape.land.normalize=true")
            self.assertEqual(done.returncode, USAGE, done.stdout + done.stderr)
            self.assertRegex(done.stderr, "expected only one of them")


if __name__ == "__main__":
    unittest.main()
