// SPDX-License-Identifier: BSD-3-Clause
// Projects the rings of maps into the plane of a mesh, by means of PROJ.
#pragma once

#include "config_text.hpp"

#include <optional>
#include <string>
#include <vector>

namespace trime_check {

/// Rings in the plane. Edges are straight in the coordinates of the file, so those that are curves in the plane have
/// more vertices than in the file.
struct ProjectedRings {
  std::vector<Ring> rings;
  bool bent = false;  ///< whether an edge was divided
  std::string reason; ///< why the rings cannot be projected; empty: they are here
};

/// How the rings of a map in degrees lie at the meridian of 180 degrees.
enum class DateLine {
  free,     ///< no edge runs along it, or the coordinates are not in degrees
  unrolled, ///< edges run along it; rings west of a free meridian lie 360 degrees farther east now
  closed,   ///< edges run along it, and there is no free meridian
};
/// @brief Moves the rings of a map that is cut at 180 degrees next to each other, so that the edges of the cut
/// coincide.
/// @param from reference system of the rings, as below
DateLine unroll(std::vector<Ring>& rings, const std::string& from);

/// @param from reference system of the rings; empty: longitude and latitude in degrees on WGS 84
/// @param to reference system of the plane
ProjectedRings project(const std::vector<Ring>& rings, const std::string& from, const std::string& to);

/// Returns the points in the plane, or nothing if one of them has no place there.
std::optional<std::vector<Point>> project(const std::vector<Point>& points, const std::string& from,
                                          const std::string& to);

} // namespace trime_check
