// SPDX-License-Identifier: BSD-3-Clause
// Contours of maps: from longitude and latitude into the plane in which they are meshed.
#pragma once

#include "app/options.hpp"
#include "trime/contours/contour.hpp"
#include "trime/core/log.hpp"

#include <optional>
#include <span>
#include <string>

namespace trime::app {

/// Which place of the Earth a coordinate of the container is; all empty: unknown.
struct MapSystem {
  std::string crs{};             ///< reference system, as PROJ names it
  std::string well_known_text{}; ///< its complete definition
  std::string crs_of_files{};    ///< reference system of the contour files
};

/// @brief Projects the contours as [shape] projection says; without it only asks which system their files name.
///
/// Files that name none have longitude and latitude on WGS 84. Straight lines between vertices stay straight in the
/// plane.
/// @throws ConfigError if PROJ does not know a system; GeometryError `source:line: ...` for a vertex that cannot be
/// projected
/// @note Serial.
MapSystem project_contours(const RunOptions& options, std::span<contours::Contour> contours, Log& log);

/// @brief Projects one contour and keeps the places in its file in ContourRing::in_file. @throws as project_contours
void project_contour(contours::Contour& contour, const std::string& plane);

/// Returns longitude and latitude of a place of the mesh, in degrees; nothing if it is in no plane that PROJ knows.
std::optional<geometry::Vec2> on_earth(const MapSystem& map, geometry::Vec2 place);

} // namespace trime::app
