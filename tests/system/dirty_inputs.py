# SPDX-License-Identifier: BSD-3-Clause
"""Contour files as users have them, for inputs_test.py: files that are read, and files that are refused."""
import json
import re

GEOMETRY, FILE, USAGE = 3, 4, 2
SQUARE = ["0.1 0.1", "0.9 0.1", "0.9 0.9", "0.1 0.9"]
HOLE = ["0.4 0.4", "0.6 0.4", "0.6 0.6", "0.4 0.6"]


def xy(*rings, between="\n", end="\n"):
    """Lines of rings."""
    return (between + end).join("".join(line + end for line in ring) for ring in rings)


def geojson(*rings, kind="Polygon", **more):
    """A geometry with a line for each position."""
    rows = [[[float(word) for word in line.split()] for line in ring] for ring in rings]
    return json.dumps({"type": kind, "coordinates": rows if kind == "Polygon" else rows[0], **more}, indent=1)


POLY = """# a square with a hole, markers
8 2 0 0
1 0.1 0.1
2 0.9 0.1
3 0.9 0.9
4 0.1 0.9
5 0.4 0.4
6 0.6 0.4
7 0.6 0.6
8 0.4 0.6
8 1
1 1 2 1
2 2 3 2
3 3 4 1
4 4 1 1
5 5 6 7
6 6 7 7
7 7 8 7
8 8 5 7
1
1 0.5 0.5
"""
FROM_ZERO = re.sub(r"^(\d) (\d) (\d) (\d)$", lambda m: " ".join(str(int(w) - 1) for w in m.groups()[:3]) + " " + m[4],
                   re.sub(r"^(\d) (0\.\d) (0\.\d)$", lambda m: f"{int(m[1]) - 1} {m[2]} {m[3]}", POLY, flags=re.M),
                   flags=re.M).replace("7 1 -1 0\n", "8 2 0 0\n")
MSH = """# JIGSAW
mshid=3;EUCLIDEAN-MESH
ndims=2
point=4
0.1;0.1;0
0.9;0.1;0
0.9;0.9;0
0.1;0.9;0
edge2=4
0;1;1
1;2;2
2;3;1
3;0;1
"""
WHOLE, HOLED = 0.64, 0.6

# (what, file, text, area of the shape) or (what, file, text, exit code, what the message holds)
READ = [
    ("commas", "a.xy", xy([line.replace(" ", ",") for line in SQUARE]), WHOLE),
    ("commas and blanks", "a.xy", xy([line.replace(" ", " , ") for line in SQUARE]), WHOLE),
    ("tabs", "a.xy", xy([line.replace(" ", "\t") for line in SQUARE], HOLE), HOLED),
    ("byte order mark, CR LF", "a.xy", "\ufeff" + xy(SQUARE, HOLE, between="", end="\r\n"), HOLED),
    ("CR only", "a.xy", xy(SQUARE, HOLE, between="", end="\r"), HOLED),
    ("closed rings, GMT", "a.xy", "> land\n" + xy(SQUARE + SQUARE[:1]) + "> lake\n" + xy(HOLE + HOLE[:1]), HOLED),
    ("repeated points", "a.xy", xy([line for line in SQUARE for _ in range(3)]), WHOLE),
    ("names of columns, no last line end", "a.xy", "lon,lat\n" + xy(SQUARE).rstrip(), WHOLE),
    ("a ring given twice", "a.xy", xy(SQUARE, SQUARE[2:] + SQUARE[:2], between=""), WHOLE),
    ("byte order mark", "a.geojson", "\ufeff" + geojson(SQUARE + SQUARE[:1], HOLE + HOLE[:1]), HOLED),
    ("open polygon, closed line", "a.json", geojson(SQUARE), WHOLE),
    ("plain", "a.poly", POLY, HOLED),
    ("from 0, tabs, CR LF", "a.poly", FROM_ZERO.replace(" ", "\t").replace("\n", "\r\n"), HOLED),
    ("commas, no section of holes", "a.poly", "\n".join(POLY.replace(" ", ", ").splitlines()[:-2]) + "\n", WHOLE),
    ("region attributes, a free vertex", "a.poly",
     POLY.replace("8 2 0 0", "9 2 0 0").replace("8 0.4 0.6\n", "8 0.4 0.6\n9 0.2 0.2\n") + "1\n1 0.2 0.2 5 0.1\n",
     HOLED),
    ("vertices twice", "a.poly", POLY.replace("8 2 0 0", "9 2 0 0").replace("8 0.4 0.6\n", "8 0.4 0.6\n9 0.1 0.1\n")
     .replace("4 4 1 1\n", "4 4 9 1\n"), HOLED),
    ("line inside", "a.poly", POLY.replace("8 1\n", "9 1\n").replace("1\n1 0.5", "9 1 5 0\n1\n1 0.5"), HOLED),
    ("plain", "a.msh", MSH, WHOLE),
    ("sections that do not matter, capitals", "a.msh",
     MSH.replace("edge2", "EDGE2") + "tria3=1\n0;1;2;0\nvalue=4;1\n1\n1\n1\n1\n", WHOLE),
]
REFUSED = [
    ("three columns", "a.xy", xy([line + " 0" for line in SQUARE]), GEOMETRY, r"a\.xy:1: .*remove the third column"),
    ("decimal commas", "a.xy", xy([line.replace(".", ",") for line in SQUARE]), GEOMETRY, r"a\.xy:1: .*point"),
    ("latitude first", "a.xy", "lat lon\n" + xy(SQUARE), GEOMETRY, r"a\.xy:1: .*other order"),
    ("crossing", "a.xy", xy([SQUARE[0], SQUARE[2], SQUARE[1], SQUARE[3]]), GEOMETRY, r"a\.xy:\d: .*crosses.*near \("),
    ("two vertices", "a.xy", xy(SQUARE, HOLE[:2]), GEOMETRY, r"a\.xy:7: .*2 distinct vertices"),
    ("nan", "a.xy", xy(SQUARE + ["nan nan"]), GEOMETRY, r"a\.xy:5: .*finite"),
    ("UTF-16", "a.xy", xy(SQUARE).encode("utf-16"), GEOMETRY, r"a\.xy:1: .*UTF-8"),
    ("empty", "a.xy", "", GEOMETRY, r"a\.xy: .*no vertex"),
    ("cut off", "a.geojson", geojson(SQUARE)[:-9], GEOMETRY, r"a\.geojson:\d+: expected JSON"),
    ("a word", "a.geojson", geojson(SQUARE).replace("0.9", '"0.9"', 1), GEOMETRY, r"a\.geojson:\d+: .*numbers"),
    ("open line", "a.geojson", geojson(SQUARE, kind="LineString"), GEOMETRY,
     r"a\.geojson:\d+: .*end where they start.*\(0\.1, 0\.1\) no other line shares"),
    ("crossing", "a.geojson", geojson([SQUARE[0], SQUARE[2], SQUARE[1], SQUARE[3]]), GEOMETRY,
     r"a\.geojson:\d+: .*crosses.*ogr2ogr -makevalid"),
    ("points only", "a.geojson", '{"type": "Point", "coordinates": [1, 2]}', GEOMETRY, r"a\.geojson: .*Polygon"),
    ("missing vertex", "a.poly", POLY.replace("8 8 5 7", "8 8 9 7"), GEOMETRY,
     r"a\.poly:19: expected vertices from 1 to 8"),
    ("open ring", "a.poly", POLY.replace("8 1\n1", "7 1\n1", 1).replace("8 8 5 7\n", ""), GEOMETRY,
     r"a\.poly:\d+: 1 segment ends at vertex [58]"),
    ("too short", "a.poly", POLY[:60], GEOMETRY, r"a\.poly:\d+: expected .*vertex|a\.poly:\d+: expected vertex"),
    ("space", "a.poly", POLY.replace("8 2 0 0", "8 3 0 0"), GEOMETRY, r"a\.poly:2: expected a plane \.poly"),
    ("no .node", "a.poly", "0 2 0 0\n" + POLY[POLY.index("8 1\n"):], FILE, r"a\.node.*itself has no vertices"),
    ("Gmsh", "a.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n", GEOMETRY, r"a\.msh:1: .*Gmsh"),
    ("on the ellipsoid", "a.msh", MSH.replace("EUCLIDEAN", "ELLIPSOID"), GEOMETRY, r"a\.msh:2: .*projection"),
    ("missing point", "a.msh", MSH.replace("3;0;1", "3;4;1"), GEOMETRY, r"a\.msh:13: expected points from 0 to 3"),
    ("too few rows", "a.msh", MSH.replace("edge2=4", "edge2=5"), GEOMETRY, r"a\.msh:\d+: expected edge 5 of 5"),
    ("no shapefile", "a.shp", "0 0\n1 0\n1 1\n", FILE, r"a\.shx.*NAME\.shp and NAME\.shx"),
    ("another format", "a.dxf", "0\nSECTION\n", USAGE, r"a\.dxf: .*ogr2ogr"),
]

# What has no area: (what, file, text, area of the shape after the repair, what the message says without the repair)
ROAD = json.dumps({"type": "FeatureCollection", "features": [
    {"type": "Feature", "properties": {}, "geometry": json.loads(geojson(SQUARE + SQUARE[:1]))},
    {"type": "Feature", "properties": {"name": "road"},
     "geometry": {"type": "LineString", "coordinates": [[0.2, 0.2], [0.8, 0.7]]}}]})
REPAIRED = [
    ("a ring of one place", "a.geojson", geojson(SQUARE + SQUARE[:1], ["0.5 0.5"] * 4), WHOLE,
     r"distinct vert(ex|ices)"),
    ("a ring on one line", "a.xy", xy(SQUARE, ["0.3 0.5", "0.5 0.5", "0.7 0.5"]), WHOLE, "encloses no area"),
    ("a spike", "a.xy", xy(SQUARE[:2] + ["0.9 0.5", "1.2 0.5", "0.9 0.5"] + SQUARE[2:]), WHOLE, "straight back"),
    ("a keyhole", "a.xy", xy(SQUARE + ["0.1 0.5", "0.4 0.5", "0.4 0.6", "0.6 0.6", "0.6 0.4", "0.4 0.4", "0.4 0.5",
                                       "0.1 0.5"]), HOLED, "in both directions"),
    ("a road", "a.geojson", ROAD, WHOLE, "end where they start"),
    ("a third column", "a.xy", xy([line + " 0" for line in SQUARE]), WHOLE, "third column"),
]
# (what, file, text): what has area, or may have it, is refused with `repair = true` as well.
NOT_REPAIRED = [
    ("a figure eight", "a.xy", xy([SQUARE[0], SQUARE[2], SQUARE[1], SQUARE[3]])),
    ("a ring with a gap", "a.geojson", geojson(SQUARE + ["0.1 0.15"], kind="LineString")),
    ("rings that cross", "a.xy", xy(SQUARE, ["0.5 0.5", "1.5 0.5", "0.5 0.8"])),
]
