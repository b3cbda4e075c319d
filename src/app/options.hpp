// SPDX-License-Identifier: BSD-3-Clause
// All options of a run, as plain structs. The options are the content of a config
// file after it was read and checked.
#pragma once

#include "acceptance/solver_rules.hpp"
#include "formats/mesh_series.hpp"
#include "record/courant.hpp"
#include "sizing/boundary_distance.hpp"
#include "trime/core/log.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/geometry/vec2.hpp"
#include "trime/meshing/options.hpp"

#include <array>
#include <string>
#include <vector>

namespace trime::app {

/// Largest number of points of a mesh. Ids have 64 bits, and the start of a run adds up weights of 2^20 per point in
/// them, so 8e12 points would fit.
inline constexpr double most_points = 1e11;

/// One section [shape.NAME] of a config. Members that belong to other types of part keep their defaults.
struct PartOptions {
  std::string name;
  std::string type; ///< rectangle, circle, triangle, contour or expression
  geometry::Box box;
  geometry::Vec2 center;
  double radius = 0;
  std::array<geometry::Vec2, 3> corners;
  std::string file; ///< path of the contour file, relative to the working directory of the program or absolute
  bool file_is_relative = false; ///< true if the user gave the path relative to the config file
  std::string attribute;         ///< attribute of map features that names the boundary; empty: no attribute
  bool dissolve = false;         ///< polygons of a map that overlap or share borders are united
  bool repair = false;           ///< what has no area is left out of the contour
  bool normalize = false;
  std::string sdf; ///< formula of x and y
};

/// One section [region.NAME] of a config.
struct RegionOptions {
  std::string name;
  std::string geometry;          ///< the expression that joins the parts of the region; empty if there is a file
  std::string file;              ///< path, as PartOptions::file; empty: no file
  bool file_is_relative = false; ///< true if the user gave the path relative to the config file
  std::string attribute;         ///< attribute of map features that divides the file; empty: no attribute
  std::string normalize_with;    ///< name of the contour whose normalisation is applied; empty: no normalisation
  std::optional<double> size;    ///< largest size in the region
  bool area_limits = false;      ///< the largest areas in the file, see contours::Contour, bound the size
};

/// One section [curve.NAME] of a config.
struct CurveOptions {
  std::string name;
  std::string file;              ///< path, as PartOptions::file
  bool file_is_relative = false; ///< true if the user gave the path relative to the config file
  std::string attribute;         ///< attribute of map features that divides the curve; empty: no attribute
  bool clip = false;             ///< what lies outside of the shape is left out
  geometry::CurveKind kind{};    ///< whether it is split, and a weir
  std::string normalize_with;    ///< name of the contour whose normalisation is applied; empty: no normalisation
};

/// A formula of a config, already checked.
struct FormulaText {
  std::string text;
  std::string place; ///< its origin for messages: "config.ini:17: 'expression' in [sizing]"
};

/// One section [size.NAME] of a config.
struct NamedFormula {
  std::string name;
  FormulaText formula;
};

/// One section [field.NAME] of a config.
struct FieldOptions {
  std::string name;
  std::string file;              ///< path, as PartOptions::file
  bool file_is_relative = false; ///< true if the user gave the path relative to the config file
  std::string variable;          ///< name of the variable of a NetCDF file; empty: the only one
  std::string fill;              ///< `error`, `nearest`, or a number, which `fill_value` holds
  double fill_value = 0;
  bool outside_is_nearest = false;
  std::string coordinates; ///< auto, degrees or plane
  double smooth = 0;       ///< length over which gradients are smoothed; 0: they are not
};

/// The section [sizing] of a config. The absolute bounds of the size are in meshing::MeshOptions.
struct SizingOptions {
  std::string type = "uniform";           ///< uniform, automatic or expression
  double gradation = 0.1;                 ///< K of the type automatic; 0 makes the size uniform
  FormulaText expression;                 ///< formula of the size, if the type is expression
  std::vector<NamedFormula> more;         ///< the sections [size.NAME]; the smallest size of all counts
  bool uses_data = false;                 ///< whether a formula uses a field
  std::vector<sizing::NamedSize> size_at; ///< lengths on parts of the boundary
  std::string size_at_place;              ///< origin of `size_at` for messages
};

/// The file that the key `fixed_points` in [meshing] names.
struct FixedPointsFile {
  std::string file; ///< path relative to the working directory of the program or absolute; empty: no file
  bool file_is_relative = false;
  std::string
      normalize_with; ///< name of the contour whose normalisation is applied to the points; empty: no normalisation
};

/// The section [checkpoint] of a config.
struct CheckpointOptions {
  double interval = 0;   ///< seconds between checkpoints; 0: checkpoints are written only after a signal
  int keep = 2;          ///< number of checkpoint files, which are overwritten in turn
  std::string stop_file; ///< path of the stop file; empty: no stop file
};

struct RunOptions {
  std::vector<PartOptions> parts;
  std::vector<RegionOptions> regions; ///< in the order of their sections
  std::string rest;                   ///< name of what lies in no region; empty: the text of `geometry`
  bool regions_cover_all = false;     ///< whether a place in no region is an error
  std::vector<CurveOptions> curves;   ///< curves inside the shape
  std::string geometry;               ///< the expression that joins the parts of the shape
  std::string projection; ///< projection of contours: empty for none, `auto`, or a reference system that PROJ knows
  bool periodic_x = false, periodic_y = false; ///< whether opposite sides of the container are joined
  geometry::Box container = geometry::unit_square;
  bool container_is_automatic =
      false; ///< true if no side of the container is given: then it may become a box around the shape
  meshing::MeshOptions
      mesh; ///< options of the mesher, without the fixed points, which are read together with the shape
  FixedPointsFile fixed_points;
  std::string start_file;           ///< mesh file whose points are the start; empty: none
  std::vector<FieldOptions> fields; ///< data that a formula uses
  SizingOptions sizing;
  FormulaText depth;                      ///< formula of the depth at points; empty if none is asked for
  std::vector<acceptance::Solver> accept; ///< models whose rules the mesh is measured by
  record::CourantOptions courant;         ///< time step of the model that will use the mesh
  bool scale_is_automatic = false;        ///< true if the user does not say whether sizes are lengths
  int setup_threads = 0;         ///< threads per rank while shape and size field are made; 0: chosen from the machine
  int mesh_threads = 0;          ///< threads per rank during meshing; 0: chosen from the machine
  formats::SeriesOptions output; ///< options of the output, without the names of the parts, which the shape knows
  bool write = true;             ///< false if no file is written
  CheckpointOptions checkpoint;
  LogLevel log_level = LogLevel::summary;
  int log_interval = 0;
  std::string resolved;              ///< the whole config with all defaults, as a complete ini text
  std::vector<std::string> warnings; ///< warnings for the user, one sentence each
};

} // namespace trime::app
