// SPDX-License-Identifier: BSD-3-Clause
#include "app/option_table.hpp"

#include "app/checkpoint_names.hpp"
#include "app/options.hpp"

#include <algorithm>

namespace trime::app {
namespace {

constexpr double huge = std::numeric_limits<double>::infinity();
constexpr Range positive{0, huge, true};
constexpr Range not_negative{0, huge};
constexpr Range coordinate{-largest_coordinate, largest_coordinate};

/// The words of all output formats.
const char* format_words() {
  static const std::string words = [] {
    std::string text;
    for (const formats::FormatInfo& format : formats::all_formats())
      text.append(format.word).append(" ");
    text.pop_back();
    return text;
  }();
  return words.c_str();
}

/// The words of all models with rules, and that for no model.
const char* accept_words() {
  static const std::string words = std::string("none ") + acceptance::solver_words();
  return words.c_str();
}

const Option table[] = {
    {.section = "domain",
     .key = "x_min",
     .fallback = "auto",
     .choices = "auto",
     .range = coordinate,
     .meaning = "left side of the container, a rectangle a little larger than the shape; auto: 0, or a little to the "
                "left of a shape that does not fit into the unit square"},
    {.section = "domain",
     .key = "x_max",
     .fallback = "auto",
     .choices = "auto",
     .range = coordinate,
     .meaning = "right side of the container; auto: 1, or a little to the right of a shape that does not fit into the "
                "unit square"},
    {.section = "domain",
     .key = "y_min",
     .fallback = "auto",
     .choices = "auto",
     .range = coordinate,
     .meaning =
         "lower side of the container; auto: 0, or a little below a shape that does not fit into the unit square"},
    {.section = "domain",
     .key = "y_max",
     .fallback = "auto",
     .choices = "auto",
     .range = coordinate,
     .meaning =
         "upper side of the container; auto: 1, or a little above a shape that does not fit into the unit square"},
    {.section = "domain",
     .key = "periodic_x",
     .kind = OptionKind::boolean,
     .fallback = "false",
     .meaning = "true: the mesh is periodic in x, so the left and the right side of the container are joined"},
    {.section = "domain",
     .key = "periodic_y",
     .kind = OptionKind::boolean,
     .fallback = "false",
     .meaning = "true: the mesh is periodic in y, so the lower and the upper side of the container are joined"},
    {.section = "domain",
     .key = "cells_x",
     .kind = OptionKind::integer,
     .fallback = "auto",
     .choices = "auto",
     .range = {1, 1e6},
     .meaning = "number of columns of the grid of cells over the container; auto: about 3.3 points per cell"},
    {.section = "domain",
     .key = "cells_y",
     .kind = OptionKind::integer,
     .fallback = "auto",
     .choices = "auto",
     .range = {1, 1e6},
     .meaning = "number of rows of the grid of cells over the container; auto: about 3.3 points per cell"},

    {.section = "shape",
     .key = "geometry",
     .kind = OptionKind::text,
     .meaning =
         "the shape, made of named parts: a name, `domain` for the container itself, or `union`, `intersection` or "
         "`difference` of two or more of these, which may be nested, such as `difference(spade, union(hole, slot))`"},
    {.section = "shape",
     .key = "rest",
     .kind = OptionKind::text,
     .fallback = "geometry",
     .choices = "geometry",
     .meaning = "name of the part of the shape that lies in no [region.NAME]; `geometry`: the text of that key"},
    {.section = "shape",
     .key = "cover",
     .kind = OptionKind::word,
     .fallback = "rest",
     .choices = "rest all",
     .meaning = "`all`: the regions must cover the whole shape, and a place in none of them is an error; `rest`: such "
                "places belong to a region of their own"},
    {.section = "shape",
     .key = "projection",
     .kind = OptionKind::text,
     .fallback = "none",
     .meaning =
         "the plane in which contours in longitude and latitude are meshed: `auto` chooses a local plane in metres; "
         "any other value is a system that PROJ knows, such as `EPSG:32633`; none: coordinates are used as they are"},
    {.section = "shape.NAME",
     .key = "type",
     .kind = OptionKind::word,
     .choices = "rectangle circle triangle contour expression",
     .meaning = "the type of the part NAME; each part has one section"},
    {.section = "shape.NAME", .key = "x_min", .part_type = "rectangle", .meaning = "left side"},
    {.section = "shape.NAME", .key = "x_max", .part_type = "rectangle", .meaning = "right side"},
    {.section = "shape.NAME", .key = "y_min", .part_type = "rectangle", .meaning = "lower side"},
    {.section = "shape.NAME", .key = "y_max", .part_type = "rectangle", .meaning = "upper side"},
    {.section = "shape.NAME",
     .key = "center",
     .part_type = "circle",
     .kind = OptionKind::pair,
     .meaning = "centre X Y"},
    {.section = "shape.NAME", .key = "radius", .part_type = "circle", .range = positive, .meaning = "radius"},
    {.section = "shape.NAME", .key = "p0", .part_type = "triangle", .kind = OptionKind::pair, .meaning = "corner X Y"},
    {.section = "shape.NAME", .key = "p1", .part_type = "triangle", .kind = OptionKind::pair, .meaning = "corner X Y"},
    {.section = "shape.NAME", .key = "p2", .part_type = "triangle", .kind = OptionKind::pair, .meaning = "corner X Y"},
    {.section = "shape.NAME",
     .key = "file",
     .part_type = "contour",
     .kind = OptionKind::path,
     .meaning = "the rings of the contour. A `.xy` file has one `x y` per line; an empty line or `>` ends a ring, and "
                "`#` begins a comment. Other formats: polygons of a `.geojson` or `.shp`, `.poly` of Triangle, `.msh` "
                "of JIGSAW. A ring inside another one is a hole (even-odd rule)"},
    {.section = "shape.NAME",
     .key = "attribute",
     .part_type = "contour",
     .kind = OptionKind::text,
     .fallback = "none",
     .meaning = "an attribute of the features of a `.geojson` or `.shp` that names the boundary, such as `name`: texts "
                "make parts `NAME.TEXT`, integers become markers"},
    {.section = "shape.NAME",
     .key = "overlap",
     .part_type = "contour",
     .kind = OptionKind::word,
     .fallback = "error",
     .choices = "error union",
     .meaning = "polygons of a `.geojson` or `.shp` that overlap, lie in each other or share borders: `error` refuses "
                "them, `union` unites them"},
    {.section = "shape.NAME",
     .key = "repair",
     .part_type = "contour",
     .kind = OptionKind::boolean,
     .fallback = "false",
     .meaning = "true: what has no area is left out of the contour, and warnings list it: spikes, rings of fewer than "
                "three different vertices, two edges that cancel each other, open lines of a map, a third column. "
                "False: the file is refused, and the message lists all faults"},
    {.section = "shape.NAME",
     .key = "normalize",
     .part_type = "contour",
     .kind = OptionKind::boolean,
     .fallback = "false",
     .meaning = "true: the contour is moved to the centre of the container and scaled until its longer side is 0.8 of "
                "the container's shorter side"},
    {.section = "shape.NAME",
     .key = "sdf",
     .part_type = "expression",
     .kind = OptionKind::text,
     .meaning = "signed distance as a formula of x and y, negative inside, such as `sqrt((x-0.5)^2+(y-0.5)^2)-0.3`"},

    {.section = "region.NAME",
     .key = "geometry",
     .kind = OptionKind::text,
     .fallback = "NAME",
     .choices = "NAME",
     .meaning =
         "the region NAME of the shape, such as a material, as an expression over the same parts as `geometry` in "
         "[shape]; without this key and `file`, the part with the name of the region. The first region that "
         "contains a place has it"},
    {.section = "region.NAME",
     .key = "file",
     .kind = OptionKind::path,
     .fallback = "none",
     .choices = "none",
     .meaning = "instead of `geometry`: a file with the polygons of the region, in one of the formats of contours. "
                "Polygons of a `.geojson` or `.shp` may overlap and share borders. Each attribute of the region points "
                "of a `.poly` makes a region `NAME.ATTRIBUTE`"},
    {.section = "region.NAME",
     .key = "attribute",
     .kind = OptionKind::text,
     .fallback = "none",
     .meaning = "an attribute of the features of a `.geojson` or `.shp`, such as `unit`: each value makes a region "
                "`NAME.VALUE`"},
    {.section = "region.NAME",
     .key = "normalize_with",
     .kind = OptionKind::text,
     .fallback = "none",
     .meaning = "name of a normalised contour; the polygons of the file are moved and scaled in the same way"},
    {.section = "region.NAME",
     .key = "size",
     .fallback = "none",
     .choices = "none",
     .range = {.low = 0, .low_excluded = true},
     .meaning = "largest size in the region: a length with `scale = absolute` in [sizing], otherwise relative to the "
                "size of [sizing], so that 0.5 halves a uniform size. The size grows from there by `gradation`"},

    {.section = "region.NAME",
     .key = "area_limits",
     .kind = OptionKind::boolean,
     .fallback = "false",
     .meaning = "true: the largest areas of triangles in the region points of a `.poly` file bound the size; needs "
                "`scale = absolute` in [sizing]"},

    {.section = "curve.NAME",
     .key = "file",
     .kind = OptionKind::path,
     .meaning =
         "the lines of the curve NAME inside the shape, which edges of the mesh follow: a `.xy` file, whose lines "
         "need not be closed, the segments of a `.poly`, or the lines and polygons of a `.geojson` or `.shp`"},
    {.section = "curve.NAME",
     .key = "attribute",
     .kind = OptionKind::text,
     .fallback = "none",
     .meaning = "an attribute of the features of a `.geojson` or `.shp` that divides them into several curves: each "
                "value makes a curve `NAME.VALUE`"},
    {.section = "curve.NAME",
     .key = "clip",
     .kind = OptionKind::boolean,
     .fallback = "false",
     .meaning = "true: what lies outside of the shape is left out; false: it is an error"},
    {.section = "curve.NAME",
     .key = "split",
     .kind = OptionKind::boolean,
     .fallback = "false",
     .meaning =
         "true: the curve is a crack or a wall: the points on it are doubled, and both of its sides are boundary "
         "edges with the name of the curve"},
    {.section = "curve.NAME",
     .key = "weir_height",
     .fallback = "none",
     .choices = "none",
     .meaning =
         "height of a split curve as a weir in the format fort14; none: it is a wall there, with land on both sides"},
    {.section = "curve.NAME",
     .key = "weir_subcritical",
     .fallback = "1",
     .range = {.low = 0},
     .meaning = "coefficient of free surface subcritical flow over a weir"},
    {.section = "curve.NAME",
     .key = "weir_supercritical",
     .fallback = "1",
     .range = {.low = 0},
     .meaning = "coefficient of free surface supercritical flow over a weir"},
    {.section = "curve.NAME",
     .key = "normalize_with",
     .kind = OptionKind::text,
     .fallback = "none",
     .meaning = "name of a normalised contour; the curve is moved and scaled in the same way as this contour"},

    {.section = "field.NAME",
     .key = "file",
     .kind = OptionKind::path,
     .meaning =
         "a raster of numbers, such as the depth of the sea, whose name is a variable of the formulas of the size and "
         "of the depth: an ESRI ASCII grid or a NetCDF-4 file"},
    {.section = "field.NAME",
     .key = "variable",
     .kind = OptionKind::text,
     .fallback = "none",
     .meaning = "name of the variable of a NetCDF file; needed if the file has several ones with two dimensions"},
    {.section = "field.NAME",
     .key = "fill",
     .fallback = "error",
     .choices = "error nearest",
     .meaning = "where the shape needs a value that the file marks as missing: `error`: the run ends; `nearest`: the "
                "other values around count, or the nearest one; a number: this number"},
    {.section = "field.NAME",
     .key = "outside",
     .kind = OptionKind::word,
     .fallback = "error",
     .choices = "error nearest",
     .meaning =
         "where the shape lies outside of the raster: `error`: the run ends; `nearest`: the nearest value counts"},
    {.section = "field.NAME",
     .key = "coordinates",
     .kind = OptionKind::word,
     .fallback = "auto",
     .choices = "auto degrees plane",
     .meaning =
         "coordinates of the raster: `degrees`: longitude and latitude; `plane`: those of the mesh; auto: degrees "
         "if the contours are projected and the raster lies within 360 and 90"},

    {.section = "field.NAME",
     .key = "smooth",
     .fallback = "none",
     .choices = "none",
     .range = positive,
     .meaning =
         "length over which the data are averaged before `grad(NAME)` takes their slope, in the unit of the mesh: "
         "shorter waves are removed; at most 1000 cells of the raster; none: the slope of the data as they are"},

    {.section = "sizing",
     .key = "type",
     .kind = OptionKind::word,
     .fallback = "uniform",
     .choices = "uniform automatic expression",
     .meaning =
         "how the size of the triangles varies; `automatic` makes them small where the shape is narrow or curved"},
    {.section = "sizing",
     .key = "scale",
     .kind = OptionKind::word,
     .fallback = "auto",
     .choices = "auto fit absolute",
     .meaning = "auto: `absolute` if the formula uses data of [field.NAME], otherwise `fit`. `fit`: only ratios of "
                "sizes count, and a factor makes the number of `points` or the mean "
                "`edge_length`; `absolute`: sizes are lengths, and `points` is a limit or missing"},
    {.section = "sizing",
     .key = "gradation",
     .fallback = "auto",
     .choices = "auto none",
     .range = {0, 2},
     .meaning =
         "largest growth of the size per length in the mesh (K in TriMe++). auto: 0.1 for the type automatic, 0.3 "
         "for a formula, 0.2 around narrow places. none: a formula is used as it is. 0: the automatic size is "
         "uniform. Triangles can hardly follow a growth of more than 0.5"},
    {.section = "sizing",
     .key = "expression",
     .kind = OptionKind::text,
     .fallback = "none",
     .meaning = "relative size as a formula of x and y, such as `1+3*x+3*y`; used if `type` is expression; `dist()` is "
                "the distance to the boundary, `dist(NAME)` that to the parts with this name"},
    {.section = "sizing",
     .key = "size_at",
     .kind = OptionKind::text,
     .fallback = "none",
     .meaning =
         "lengths of the edges on parts of the boundary, on curves and at fixed points, such as `coast 200, river 50, "
         "fixed_points 20`; from there the size grows by `gradation` per length; needs `scale = absolute`"},
    {.section = "sizing",
     .key = "min_size",
     .fallback = "none",
     .choices = "none",
     .range = positive,
     .meaning = "lower bound of the size, a length in the unit of the coordinates, as is `edge_length`"},
    {.section = "sizing",
     .key = "max_size",
     .fallback = "none",
     .choices = "none",
     .range = positive,
     .meaning = "upper bound of the size, a length in the unit of the coordinates, as is `edge_length`"},
    {.section = "sizing",
     .key = "shortest_edge",
     .fallback = "none",
     .choices = "none",
     .range = positive,
     .meaning = "no edge of the mesh is shorter: sizes are raised where this takes it, and the shape is simplified "
                "there; a mesh with a shorter edge ends with exit code 5"},

    {.section = "size.NAME",
     .key = "expression",
     .kind = OptionKind::text,
     .meaning =
         "one more size, as a formula like `expression` in [sizing]; at each place the smallest one of all sizes "
         "counts. With `type = uniform` only the sections [size.NAME] count"},

    {.section = "meshing",
     .key = "method",
     .kind = OptionKind::word,
     .fallback = "hybrid",
     .choices = "distmesh cvt hybrid",
     .meaning = "how the points move: `distmesh`: by repulsive forces along the edges; `cvt`: to the centroids of "
                "their Voronoi cells (centroidal Voronoi tessellation; `cvd` means the same); `hybrid`: by both, and "
                "finally towards equilateral triangles"},
    {.section = "meshing",
     .key = "points",
     .kind = OptionKind::integer,
     .range = {3, most_points},
     .meaning = "total number of points; set either `points` or `edge_length`"},
    {.section = "meshing",
     .key = "edge_length",
     .range = positive,
     .meaning = "length of the edges, or their mean length if the size varies; set either `points` or `edge_length`"},
    {.section = "meshing",
     .key = "initial_fraction",
     .fallback = "auto",
     .choices = "auto",
     .range = {0, 1, true},
     .meaning = "share of the points that are placed before the first sweep; the others are inserted later where "
                "triangles are large; auto: the program chooses, and says why"},
    {.section = "meshing",
     .key = "fixed_points",
     .kind = OptionKind::path,
     .fallback = "none",
     .meaning = "a file of `x y` lines, or the points of a `.geojson`: the mesh has a point at exactly each of these "
                "places; those on the boundary "
                "become corners"},
    {.section = "meshing",
     .key = "fixed_points_normalize_with",
     .kind = OptionKind::text,
     .fallback = "none",
     .meaning = "name of a normalised contour; the fixed points are moved and scaled in the same way as this contour"},
    {.section = "meshing",
     .key = "start",
     .kind = OptionKind::path,
     .fallback = "none",
     .meaning =
         "a mesh file: its points in the new shape are the start of the new mesh, thinned and refilled where the "
         "wanted size differs; fewer sweeps than for a new mesh if shape and size differ little"},
    {.section = "meshing",
     .key = "corner_angle",
     .fallback = "30",
     .range = {0, 180, true},
     .meaning = "degrees; a vertex of the shape's boundary is a corner, and thus a vertex of the mesh, if the boundary "
                "turns there by more than this, or by more than 120 degrees in any case"},
    {.section = "meshing",
     .key = "keep_features",
     .kind = OptionKind::boolean,
     .fallback = "false",
     .meaning = "true: the mesh keeps every corner, island, lake and narrow part, however small, and the size is "
                "lowered around them. False: parts of the shape narrower than 0.5 h (h: the local size) are cut unless "
                "`connect` keeps them, islands and lakes with a perimeter below 3 h are dropped, and corners may be "
                "left out (see `feature_tolerance`). The report counts all these changes"},
    {.section = "meshing",
     .key = "simplify_within",
     .fallback = "0.5",
     .range = {0, 1},
     .meaning = "in units of h, the local size of the triangles: how far the boundary of the mesh may lie from that of "
                "the shape where the shape is narrower or rougher than the triangles. Smaller values simplify smaller "
                "features only, and 0 simplifies nothing. Ignored if keep_features = true"},
    {.section = "meshing",
     .key = "connect",
     .kind = OptionKind::word,
     .fallback = "keep",
     .choices = "keep cut",
     .meaning = "what happens to narrow parts that join or separate what is larger than the triangles (channels, "
                "straits, dams): `keep` lowers the size there, and moves the sides apart where they are nearer than "
                "0.35 h; `cut` cuts them. Ignored if keep_features = true"},
    {.section = "meshing",
     .key = "components",
     .kind = OptionKind::text,
     .fallback = "all",
     .meaning = "which components of the simplified shape are meshed: `all`; `largest`: the one with the largest area; "
                "`at X Y`: the one that holds this place, in the coordinates of the contour files. A warning says how "
                "many components are left out"},
    {.section = "meshing",
     .key = "split_ears",
     .kind = OptionKind::boolean,
     .fallback = "false",
     .meaning =
         "true: the clean-up divides triangles with two boundary edges, which some models of coasts do not like, "
         "where the corner of the shape has 60 degrees or more"},
    {.section = "meshing",
     .key = "max_loss",
     .fallback = "none",
     .choices = "none",
     .range = {0, 1},
     .meaning = "largest share of the shape's area that may be lost: if more is lost, the mesh file is marked as "
                "incomplete and the exit code is 5; none: any share"},
    {.section = "meshing",
     .key = "narrow",
     .kind = OptionKind::word,
     .fallback = "keep",
     .choices = "keep close",
     .meaning = "what happens to parts of the outside that are narrower than a third of the local size h (slits, "
                "cracks, walls): `keep` moves their sides apart; `close` fills them. Next to components with a "
                "perimeter below 5 h, narrow parts of the outside are always filled. Ignored if keep_features = true"},
    {.section = "meshing",
     .key = "refine_narrow",
     .kind = OptionKind::boolean,
     .fallback = "true",
     .meaning = "true: a uniform size is lowered where the shape is narrower than the triangles; false: a uniform size "
                "is the same everywhere"},
    {.section = "meshing",
     .key = "feature_tolerance",
     .fallback = "0.1",
     .range = {0, 0.3},
     .meaning = "in units of h, the local size of the triangles: a corner less than 2 h from the next corner may be "
                "left out if the boundary of the mesh passes it at no more than this distance"},
    {.section = "meshing",
     .key = "worst_alpha",
     .fallback = "5",
     .range = {1, 1e300},
     .meaning =
         "largest alpha (circumradius over twice the inradius) of a good mesh: if a triangle has a larger alpha, the "
         "file is marked as incomplete and the exit code is 5. Triangles within 3 edges of a corner below 60 degrees, "
         "or "
         "between its arms where these are less than an edge apart, are excused"},
    {.section = "meshing",
     .key = "seed",
     .kind = OptionKind::integer,
     .fallback = "1",
     .range = {0, 9007199254740992.0},
     .meaning = "seed of the random numbers"},
    {.section = "meshing",
     .key = "max_sweeps",
     .kind = OptionKind::integer,
     .fallback = "500",
     .range = {0, 1e6},
     .meaning = "largest number of sweeps; if a run needs more, its mesh is written and marked as incomplete, and the "
                "exit code is 5"},
    {.section = "meshing",
     .key = "stop_tolerance",
     .fallback = "auto",
     .choices = "auto",
     .range = positive,
     .meaning = "a method stops when six sweeps have lowered both the mean and the median of alpha - 1 by less than "
                "this share; auto: 0.04 for most final meshes, and other shares for coarse meshes and for the last "
                "method of `hybrid`"},

    {.section = "meshing",
     .key = "cleanup",
     .kind = OptionKind::boolean,
     .fallback = "true",
     .meaning = "true: after the sweeps, the program improves the worst triangles by moving, inserting and deleting "
                "points around them"},

    {.section = "parallel",
     .key = "setup_threads",
     .kind = OptionKind::integer,
     .fallback = "0",
     .range = {0, 4096},
     .meaning =
         "threads per rank while the program makes the shape and the size field; 0: as many as `mesh_threads` says"},
    {.section = "parallel",
     .key = "mesh_threads",
     .kind = OptionKind::integer,
     .fallback = "0",
     .range = {0, 4096},
     .meaning = "threads per rank after shape and size field are made; 0: OMP_NUM_THREADS if it is set, otherwise all "
                "cores that the rank may use"},

    {.section = "output",
     .key = "directory",
     .kind = OptionKind::path,
     .fallback = "out",
     .meaning =
         "directory of the output files, relative to the working directory; the program makes it if it is missing"},
    {.section = "output",
     .key = "name",
     .kind = OptionKind::text,
     .meaning = "stem of the file names; default: the stem of the config file"},
    {.section = "output",
     .key = "overwrite",
     .kind = OptionKind::boolean,
     .fallback = "false",
     .meaning = "true: the run replaces existing files, that is all files that an earlier run of this name has left"},
    {.section = "output",
     .key = "formats",
     .kind = OptionKind::words,
     .fallback = "vtkhdf xdmf",
     .choices = format_words(),
     .meaning = "`vtkhdf`: for ParaView and VTK; `xdmf`: for ParaView, FEniCS and PETSc; one file NAME.h5 serves both. "
                "`text`: the files of TriMe++, in the directory NAME. The other formats are for other programs; their "
                "files hold the final mesh and the names of its boundary"},
    {.section = "output",
     .key = "open_boundary",
     .kind = OptionKind::text,
     .fallback = "auto",
     .meaning = "names of the open parts of the boundary, for `fort14`, `gr3`, `slf` and `fvcom`, separated by commas. "
                "auto: parts with the word open, ocean or sea; none: no part is open"},
    {.section = "output",
     .key = "coordinates",
     .kind = OptionKind::word,
     .fallback = "plane",
     .choices = "plane degrees",
     .meaning =
         "coordinates in files of `fort14`, `gr3`, `fvcom` and `2dm`; plane: those of the mesh; degrees: longitude and "
         "latitude, for meshes of contours that have a projection"},
    {.section = "output",
     .key = "cells",
     .kind = OptionKind::word,
     .fallback = "voronoi",
     .choices = "voronoi whole triangles",
     .meaning =
         "cells in files of `mpas`, `disv`, `uge` and `tough`. `voronoi`: the Voronoi cells of all points, which "
         "the boundary cuts. `whole`, for `mpas`: those of the points inside, which no boundary cuts. "
         "`triangles`, for the other three: the triangles, with their circumcentres as centres"},
    {.section = "output",
     .key = "depth",
     .kind = OptionKind::text,
     .fallback = "none",
     .meaning = "depth at the points for coastal models, positive downwards, as a formula of x, y and data of "
                "[field.NAME], such as `-elevation`; none: the files of `fort14`, `gr3`, `slf`, `fvcom` and `2dm` have "
                "the depth 0"},
    {.section = "output",
     .key = "accept",
     .kind = OptionKind::words,
     .fallback = "none",
     .choices = accept_words(),
     .meaning = "models that will use the mesh: the mesh is measured by their rules, such as the "
                "least angle. A rule that makes the model refuse the mesh is a check, any other one gives a warning"},
    {.section = "output",
     .key = "time_step",
     .fallback = "none",
     .choices = "none",
     .range = positive,
     .meaning =
         "time step of the model that will use the mesh [s]: the report says how many triangles have a Courant "
         "number sqrt(9.81 depth) time_step / (shortest edge) above `courant`. The depth is the mean of those of the "
         "three corners; triangles where it is not positive are dry and do not count. Lengths are in metres"},
    {.section = "output",
     .key = "courant",
     .fallback = "1",
     .range = positive,
     .meaning = "largest Courant number that the model should have"},
    {.section = "output",
     .key = "interval",
     .kind = OptionKind::integer,
     .fallback = "-1",
     .range = {-2, 1e9},
     .meaning = "which meshes are written: 0: none; -1: the final one; -2: the first and the final one; n: the first, "
                "every n-th and the final one, each in a separate file"},

    {.section = "checkpoint",
     .key = "interval",
     .fallback = "0",
     .range = not_negative,
     .meaning = "seconds between two checkpoints; 0: checkpoints are written only on the signals USR1 and USR2"},
    {.section = "checkpoint",
     .key = "keep",
     .kind = OptionKind::integer,
     .fallback = "2",
     .range = {1, most_checkpoints},
     .meaning = "number of checkpoint files NAME.checkpoint-K.h5; the run overwrites the oldest one, and deletes all "
                "once the mesh is written"},
    {.section = "checkpoint",
     .key = "stop_file",
     .kind = OptionKind::text,
     .fallback = "none",
     .choices = "none",
     .meaning =
         "name of a file, relative to the working directory. A run that finds this file removes it, writes a "
         "checkpoint and stops with exit code 75. The key is meant for machines on which signals do not reach a job"},

    {.section = "log",
     .key = "level",
     .kind = OptionKind::word,
     .fallback = "summary",
     .choices = "debug info summary warning error silent",
     .meaning = "which messages are printed: `summary`: warnings, and a summary of at most 20 lines at the end; "
                "`info`: also what each phase does, some sweeps and the whole report (`--verbose`); `warning`: only "
                "warnings and errors (`--quiet`)"},
    {.section = "log",
     .key = "interval",
     .kind = OptionKind::integer,
     .fallback = "0",
     .range = {0, 1e9},
     .meaning = "prints a row for the first of every n sweeps, also on a terminal; 0: rows appear only with `level = "
                "info`, for fewer and fewer sweeps, and not on a terminal"},
};

void add_once(std::vector<std::string>& names, const char* name) {
  if (std::find(names.begin(), names.end(), name) == names.end())
    names.emplace_back(name);
}

std::vector<std::string> split_at(std::string_view separators, std::string_view text) {
  std::vector<std::string> words;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t first = text.find_first_not_of(separators, at);
    if (first == std::string_view::npos)
      break;
    at = std::min(text.find_first_of(separators, first), text.size());
    words.emplace_back(text.substr(first, at - first));
  }
  return words;
}

} // namespace

std::span<const Option> option_table() {
  return table;
}

std::string_view table_section(std::string_view section) {
  return section.starts_with("shape.")    ? part_section
         : section.starts_with("region.") ? region_section
         : section.starts_with("curve.")  ? curve_section
         : section.starts_with("field.")  ? field_section
         : section.starts_with("size.")   ? size_section
                                          : section;
}

const Option* find_option(std::string_view section, std::string_view key) {
  for (const Option& option : table)
    if (option.section == table_section(section) && option.key == key)
      return &option;
  return nullptr;
}

std::vector<std::string> section_names() {
  std::vector<std::string> names;
  for (const Option& option : table)
    add_once(names, option.section);
  return names;
}

std::vector<std::string> key_names(std::string_view section) {
  std::vector<std::string> names;
  for (const Option& option : table)
    if (option.section == table_section(section))
      add_once(names, option.key);
  return names;
}

std::vector<std::string> split_words(std::string_view text) {
  return split_at(" \t", text);
}

std::vector<std::string> split_list(std::string_view text) {
  return split_at(" \t,", text);
}

} // namespace trime::app
