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

constexpr Option table[] = {
    {.section = "domain",
     .key = "x_min",
     .fallback = "auto",
     .choices = "auto",
     .range = coordinate,
     .meaning =
         "left side of the container, a rectangle a little larger than the shape; auto: 0, or around a shape that "
         "does not fit into the unit square"},
    {.section = "domain",
     .key = "x_max",
     .fallback = "auto",
     .choices = "auto",
     .range = coordinate,
     .meaning = "right side; auto: 1, or likewise"},
    {.section = "domain",
     .key = "y_min",
     .fallback = "auto",
     .choices = "auto",
     .range = coordinate,
     .meaning = "lower side; auto: 0, or likewise"},
    {.section = "domain",
     .key = "y_max",
     .fallback = "auto",
     .choices = "auto",
     .range = coordinate,
     .meaning = "upper side; auto: 1, or likewise"},
    {.section = "domain",
     .key = "periodic_x",
     .kind = OptionKind::boolean,
     .fallback = "false",
     .meaning = "left and right side are the same"},
    {.section = "domain",
     .key = "periodic_y",
     .kind = OptionKind::boolean,
     .fallback = "false",
     .meaning = "lower and upper side are the same"},
    {.section = "domain",
     .key = "cells_x",
     .kind = OptionKind::integer,
     .fallback = "auto",
     .choices = "auto",
     .range = {1, 1e6},
     .meaning = "columns of the container grid; auto: about 3.3 points a cell"},
    {.section = "domain",
     .key = "cells_y",
     .kind = OptionKind::integer,
     .fallback = "auto",
     .choices = "auto",
     .range = {1, 1e6},
     .meaning = "rows of the container grid"},

    {.section = "shape",
     .key = "region",
     .kind = OptionKind::text,
     .meaning =
         "the shape, made of named parts: a name, `domain` for the container itself, or `union`, `intersection`, "
         "`difference` of two or more, nested: `difference(spade, union(hole, slot))`"},
    {.section = "shape",
     .key = "projection",
     .kind = OptionKind::text,
     .fallback = "none",
     .meaning = "the plane in which contours in longitude and latitude are meshed: `auto` for a local one in metres, "
                "or one that PROJ knows, such as `EPSG:32633`; none: coordinates are taken as they are"},
    {.section = "shape.NAME",
     .key = "type",
     .kind = OptionKind::word,
     .choices = "rectangle circle triangle contour expression",
     .meaning = "what the part NAME is; one section per part"},
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
     .meaning = "rings: `.xy`, one `x y` a line, a blank line or `>` ends a ring, `#` comments; the polygons of a "
                "`.geojson` or `.shp`; `.poly` of Triangle; `.msh` of JIGSAW; holes by even-odd nesting"},
    {.section = "shape.NAME",
     .key = "attribute",
     .part_type = "contour",
     .kind = OptionKind::text,
     .fallback = "none",
     .meaning = "attribute of the features of a `.geojson` or `.shp` that names the boundary, e.g. `name`: texts make "
                "parts `NAME.TEXT`, integers are markers"},
    {.section = "shape.NAME",
     .key = "normalize",
     .part_type = "contour",
     .kind = OptionKind::boolean,
     .fallback = "false",
     .meaning = "centre the bounding box in the container and scale its longer side to 0.8 of the container's shorter "
                "side"},
    {.section = "shape.NAME",
     .key = "sdf",
     .part_type = "expression",
     .kind = OptionKind::text,
     .meaning = "signed distance as a formula of x and y, negative inside, e.g. `sqrt((x-0.5)^2+(y-0.5)^2)-0.3`"},

    {.section = "sizing",
     .key = "type",
     .kind = OptionKind::word,
     .fallback = "uniform",
     .choices = "uniform automatic expression",
     .meaning = "relative size of the elements"},
    {.section = "sizing",
     .key = "gradation",
     .fallback = "0.1",
     .range = {0, 2},
     .meaning =
         "largest gradient of the automatic size, TriMe++'s K; 0: uniform; above 0.5 triangles can hardly follow"},
    {.section = "sizing",
     .key = "expression",
     .kind = OptionKind::text,
     .fallback = "none",
     .meaning = "relative size as a formula of x and y, e.g. `1+3*x+3*y`, for type expression"},
    {.section = "sizing",
     .key = "min_size",
     .fallback = "none",
     .choices = "none",
     .range = positive,
     .meaning = "no edge is asked to be shorter; a length, as `edge_length`"},
    {.section = "sizing",
     .key = "max_size",
     .fallback = "none",
     .choices = "none",
     .range = positive,
     .meaning = "no edge is asked to be longer"},

    {.section = "meshing",
     .key = "method",
     .kind = OptionKind::word,
     .fallback = "hybrid",
     .choices = "distmesh cvd hybrid",
     .meaning =
         "how points move: repulsive bars, centroidal Voronoi cells, or both and then towards equilateral triangles"},
    {.section = "meshing",
     .key = "points",
     .kind = OptionKind::integer,
     .range = {3, most_points},
     .meaning = "total number of points; exactly one of `points` and `edge_length`"},
    {.section = "meshing",
     .key = "edge_length",
     .range = positive,
     .meaning = "edge length, the mean one if sizes differ; exactly one of `points` and `edge_length`"},
    {.section = "meshing",
     .key = "initial_fraction",
     .fallback = "auto",
     .choices = "auto",
     .range = {0, 1, true},
     .meaning = "share of the points placed before the first sweep; the others are inserted where triangles are large; "
                "auto: the program chooses and says why"},
    {.section = "meshing",
     .key = "fixed_points",
     .kind = OptionKind::path,
     .fallback = "none",
     .meaning =
         "file of `x y` lines: points that are kept exactly and never move; on the boundary they become corners"},
    {.section = "meshing",
     .key = "fixed_points_normalize_with",
     .kind = OptionKind::text,
     .fallback = "none",
     .meaning = "normalised contour NAME whose normalisation the fixed points undergo, too"},
    {.section = "meshing",
     .key = "corner_angle",
     .fallback = "30",
     .range = {0, 180, true},
     .meaning = "degrees; a corner is a vertex of the shape's boundary that turns by more than this, or by more than "
                "120: it becomes a vertex of the mesh"},
    {.section = "meshing",
     .key = "keep_features",
     .kind = OptionKind::boolean,
     .fallback = "false",
     .meaning = "true: every corner, island, lake and narrow part is kept, however small, and the size is lowered "
                "around it; false: parts of the shape narrower than 0.5 h (h: the local size) are cut, islands and "
                "lakes with a perimeter below 3 h are dropped, and corners may be left out, see `feature_tolerance`; "
                "the report counts them"},
    {.section = "meshing",
     .key = "simplify_within",
     .fallback = "0.5",
     .range = {0, 1},
     .meaning = "times h: how far the boundary of the mesh may lie from that of the shape, where that is narrower or "
                "rougher than the triangles; with 0.25 only what is half as large is simplified, with 0 nothing; means "
                "nothing with `keep_features`"},
    {.section = "meshing",
     .key = "narrow",
     .kind = OptionKind::word,
     .fallback = "keep",
     .choices = "keep close",
     .meaning = "parts of the outside that are narrower than a third of h (slits, cracks, walls): keep: their sides "
                "are moved apart; close: they are filled, as they always are beside components with a perimeter below "
                "5 h; means nothing with `keep_features`"},
    {.section = "meshing",
     .key = "refine_narrow",
     .kind = OptionKind::boolean,
     .fallback = "true",
     .meaning = "true: a uniform size is lowered where the shape is narrower than the triangles; false: it is the same "
                "everywhere"},
    {.section = "meshing",
     .key = "feature_tolerance",
     .fallback = "0.1",
     .range = {0, 0.3},
     .meaning = "a corner less than 2 h from the next may be left out if the boundary of the mesh passes within this "
                "times h of it"},
    {.section = "meshing",
     .key = "worst_alpha",
     .fallback = "5",
     .range = {1, 1e300},
     .meaning = "a mesh with a worse triangle ends with exit code 5, written and marked, unless a corner of less than "
                "60 degrees is within 3 edges of it"},
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
     .meaning = "most sweeps of a run; one that needs more ends with exit code 5, and its mesh is written and marked"},
    {.section = "meshing",
     .key = "stop_tolerance",
     .fallback = "auto",
     .choices = "auto",
     .range = positive,
     .meaning =
         "a rule has stalled once six sweeps lower alpha - 1, its mean and its median, by less than this share; auto: "
         "0.04 for most final meshes, and other shares for coarse meshes and for the last rule of `hybrid`"},

    {.section = "meshing",
     .key = "cleanup",
     .kind = OptionKind::boolean,
     .fallback = "true",
     .meaning = "after the sweeps, mend the worst triangles: move, insert and delete points around them"},

    {.section = "parallel",
     .key = "setup_threads",
     .kind = OptionKind::integer,
     .fallback = "0",
     .range = {0, 4096},
     .meaning = "threads of a rank while shape and size field are made; 0: as for `mesh_threads`"},
    {.section = "parallel",
     .key = "mesh_threads",
     .kind = OptionKind::integer,
     .fallback = "0",
     .range = {0, 4096},
     .meaning = "threads of a rank from then on; 0: OMP_NUM_THREADS, else all cores that the rank may use"},

    {.section = "output",
     .key = "directory",
     .kind = OptionKind::path,
     .fallback = "out",
     .meaning = "where the files go, relative to the working directory; made if missing"},
    {.section = "output",
     .key = "name",
     .kind = OptionKind::text,
     .meaning = "stem of the file names; without it that of the config file"},
    {.section = "output",
     .key = "overwrite",
     .kind = OptionKind::boolean,
     .fallback = "false",
     .meaning = "replace existing files: all that an older run of this name has left"},
    {.section = "output",
     .key = "formats",
     .kind = OptionKind::words,
     .fallback = "vtkhdf xdmf",
     .choices = "vtkhdf xdmf text gmsh gmsh2 medit freefem triangle vtu 2dm fort14 geojson",
     .meaning =
         "`vtkhdf`: for ParaView and VTK; `xdmf`: for ParaView, FEniCS, PETSc; both lie in one file NAME.h5. "
         "`text`: the files of TriMe++, in the folder NAME. The others are for other programs and hold the final "
         "mesh with the names of its boundary"},
    {.section = "output",
     .key = "interval",
     .kind = OptionKind::integer,
     .fallback = "-1",
     .range = {-2, 1e9},
     .meaning = "0: no mesh; -1: the final mesh; -2: the first and the final one; n: the first, every n-th and the "
                "final one, one file each"},

    {.section = "checkpoint",
     .key = "interval",
     .fallback = "0",
     .range = not_negative,
     .meaning = "seconds from one checkpoint to the next; 0: only on the signals USR1 and USR2"},
    {.section = "checkpoint",
     .key = "keep",
     .kind = OptionKind::integer,
     .fallback = "2",
     .range = {1, most_checkpoints},
     .meaning = "files NAME.checkpoint-K.h5 that are written in turn; all go once the mesh is written"},
    {.section = "checkpoint",
     .key = "stop_file",
     .kind = OptionKind::text,
     .fallback = "none",
     .choices = "none",
     .meaning = "a run that finds this file, relative to the working directory, removes it and stops at a checkpoint "
                "(exit code 75): for sites where no signal comes through"},

    {.section = "log",
     .key = "level",
     .kind = OptionKind::word,
     .fallback = "summary",
     .choices = "debug info summary warning error silent",
     .meaning = "the least important messages that are printed: `summary`: warnings, and at most 20 lines at the end; "
                "`info`: also what each phase does, rows of the sweeps and the whole report, as with `--verbose`; "
                "`warning`: only warnings and errors, as with `--quiet`"},
    {.section = "log",
     .key = "interval",
     .kind = OptionKind::integer,
     .fallback = "0",
     .range = {0, 1e9},
     .meaning = "rows of the table of sweeps: the first of every n sweeps, on a terminal too, above the live line; 0: "
                "sparse rows, none on a terminal"},
};

void add_once(std::vector<std::string>& names, const char* name) {
  if (std::find(names.begin(), names.end(), name) == names.end())
    names.emplace_back(name);
}

} // namespace

std::span<const Option> option_table() {
  return table;
}

std::string_view table_section(std::string_view section) {
  return section.starts_with("shape.") ? part_section : section;
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
  std::vector<std::string> words;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t first = text.find_first_not_of(" \t", at);
    if (first == std::string_view::npos)
      break;
    at = std::min(text.find_first_of(" \t", first), text.size());
    words.emplace_back(text.substr(first, at - first));
  }
  return words;
}

} // namespace trime::app
