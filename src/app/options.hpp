// SPDX-License-Identifier: BSD-3-Clause
// All options of a run, as plain structs: the content of the config file after it was read and checked.
#pragma once

#include "formats/mesh_series.hpp"
#include "trime/core/log.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/geometry/vec2.hpp"
#include "trime/meshing/options.hpp"

#include <array>
#include <string>
#include <vector>

namespace trime::app {

/// That a mesh may have. Ids have 64 bits, and the start counts weights of 2^20 per point in them: 8e12 would fit.
inline constexpr double most_points = 1e11;

/// One section [shape.NAME]; the fields of other types keep their defaults.
struct PartOptions {
  std::string name;
  std::string type; ///< rectangle, circle, triangle, contour, expression
  geometry::Box box;
  geometry::Vec2 center;
  double radius = 0;
  std::array<geometry::Vec2, 3> corners;
  std::string file;              ///< path as the program can open it
  bool file_is_relative = false; ///< the user wrote it relative to the config file
  std::string attribute;         ///< attribute of map features that names the boundary; empty if not used
  bool normalize = false;
  std::string sdf; ///< formula of x and y
};

/// Section [sizing]; the absolute bounds are among the options of the mesher.
struct SizingOptions {
  std::string type = "uniform"; ///< uniform, automatic, expression
  double gradation = 0.1;       ///< automatic: 0 makes it uniform
  std::string expression;       ///< a valid formula if the type is expression
  std::string expression_place; ///< for messages: "config.ini:17: 'expression' in [sizing]"
};

/// The file of [meshing] fixed_points.
struct FixedPointsFile {
  std::string file; ///< path as the program can open it; empty: none
  bool file_is_relative = false;
  std::string normalize_with; ///< name of the contour whose normalisation they undergo; empty: none
};

/// Section [checkpoint].
struct CheckpointOptions {
  double interval = 0;   ///< seconds; 0: only on a signal
  int keep = 2;          ///< files in turn
  std::string stop_file; ///< empty: none
};

struct RunOptions {
  std::vector<PartOptions> parts;
  std::string geometry;   ///< the expression that joins the parts
  std::string projection; ///< projection of contours: empty, `auto`, or a reference system that PROJ knows
  bool periodic_x = false, periodic_y = false; ///< sides of the container, for the frame in which the shape is made
  geometry::Box container = geometry::unit_square;
  bool container_is_automatic = false; ///< no side is given: the container may become one around the shape
  meshing::MeshOptions mesh;           ///< without the fixed points, which are read when the shape is
  FixedPointsFile fixed_points;
  SizingOptions sizing;
  int setup_threads = 0;         ///< per rank, while shape and size field are made; 0: chosen from the machine
  int mesh_threads = 0;          ///< per rank, from then on; 0: chosen from the machine
  formats::SeriesOptions output; ///< without the names, which the shape knows
  bool write = true;             ///< false: nothing is written
  CheckpointOptions checkpoint;
  LogLevel log_level = LogLevel::summary;
  int log_interval = 0;
  std::string resolved;              ///< the whole config with all defaults, as a complete ini
  std::vector<std::string> warnings; ///< one sentence each
};

} // namespace trime::app
