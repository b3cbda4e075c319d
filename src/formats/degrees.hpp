// SPDX-License-Identifier: BSD-3-Clause
// Converts the points of a mesh from the plane to longitude and latitude, for the formats that want these.
#pragma once

#include "formats/exchange_mesh.hpp"

#include <memory>
#include <string>
#include <vector>

namespace trime::formats {

/// Replaces places in the plane by longitude and latitude in degrees. Not collective.
/// @param crs reference system of the plane, as PROJ names it @param format its word, for the message
/// @throws FileError if a place has none
void to_degrees(std::vector<geometry::Vec2>& places, const std::string& crs, const char* format);

/// Longitude and latitude [degrees] of the points of this rank.
using LonLat = std::shared_ptr<const std::vector<geometry::Vec2>>;
/// @brief Returns the longitude and latitude of all points. Memory: 16 bytes for each point of this rank.
/// @pre the reference system is known @param format its word, for the message
/// @throws FileError on all ranks if a place has none @note Collective.
LonLat lon_lat_of(const ExchangeMesh& mesh, const char* format);

/// Says whether the third number of a point is positive downwards or upwards.
enum class Height { depth, elevation };

/// Says how a format writes a point.
struct PointStyle {
  std::string start;  ///< text before the number of the point
  const char* format; ///< word of the format, for messages
  Height height;
};

/// Returns rows of the points in the coordinates that Names::in_degrees asks for: "ID x y z" behind a `start`. Without
/// depths, z is 0.
/// @throws ConfigError if degrees are wanted and the reference system is unknown; FileError as to_degrees(); both on
/// all ranks @note Collective.
io::TextRows numbered_points(const ExchangeMesh& mesh, const PointStyle& style);

/// Refuses degrees where the reference system of the mesh is unknown. @throws ConfigError
void check_degrees(const Names& names);

} // namespace trime::formats
