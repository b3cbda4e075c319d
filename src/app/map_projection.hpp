// SPDX-License-Identifier: BSD-3-Clause
// Projects contours of maps from longitude and latitude into the plane in which they are meshed.
#pragma once

#include "app/options.hpp"
#include "trime/contours/contour.hpp"
#include "trime/core/log.hpp"

#include <optional>
#include <span>
#include <string>

namespace trime::app {

/// A key of the config with a length, and the length; 0 if the config has none.
struct GivenLength {
  const char* key = "edge_length";
  double length = 0;
};

/// Returns the smallest length that the config gives for the edges of some place; min_size only if no other one is
/// given.
GivenLength length_of(const RunOptions& options);

/// How coordinates of the container correspond to places on the Earth. All members are empty if that is unknown.
struct MapSystem {               ///< name of the reference system, as PROJ knows it
  std::string crs{};             ///< reference system, as PROJ names it
  std::string well_known_text{}; ///< complete definition of the reference system
  std::string crs_of_files{};    ///< name of the reference system of the contour files
  bool may_be_degrees = false;   ///< a warning says that coordinates seem to be degrees, and lengths metres
};

/// @brief Projects the contours if the config has the key `projection` in [shape]. Otherwise only finds out which
/// reference system their files name.
///
/// If a file names no reference system, its coordinates are longitude and latitude on WGS 84. Polygons that meet at the
/// date line are joined, see contours::join_at_date_line. Long edges are divided, see projection::divide_long_edges:
/// edges are straight in the coordinates of their file.
/// @param contours one for each part of the options, without rings if the part is not a contour
/// @throws ConfigError if PROJ does not know a system; GeometryError `source:line: ...` for a vertex that cannot be
/// projected
/// @note Serial.
MapSystem project_contours(const RunOptions& options, std::span<contours::Contour> contours, Log& log);

/// @brief Projects one contour and keeps the original coordinates in ContourRing::in_file.
/// @throws the errors of project_contours
void project_contour(contours::Contour& contour, const std::string& plane);

/// Returns the name of the reference system for people: of a definition as WKT only the name inside.
std::string name_of(const MapSystem& map);

/// Returns longitude and latitude, in degrees, of a place in the mesh; nothing if PROJ does not know its reference
/// system.
std::optional<geometry::Vec2> on_earth(const MapSystem& map, geometry::Vec2 place);

} // namespace trime::app
