// SPDX-License-Identifier: BSD-3-Clause
// Coordinate reference systems of maps, by PROJ: between longitude and latitude and a plane.
#pragma once

#include "trime/geometry/vec2.hpp"

#include <memory>
#include <optional>
#include <span>
#include <string>

namespace trime::projection {

/// Longitude and latitude in degrees, in this order, on WGS 84: what GeoJSON has.
inline constexpr const char* lon_lat = "OGC:CRS84";

/// @brief From one reference system to another. Systems are named as PROJ names them: `EPSG:32633`, `+proj=...`, WKT.
/// Longitude, or easting, comes first, whatever the system says. Not thread-safe; a few kilobytes.
class Transform {
public:
  /// @throws ConfigError if PROJ does not know a system, or no way between them
  Transform(const std::string& from, const std::string& to);
  ~Transform();
  Transform(const Transform&) = delete;
  Transform& operator=(const Transform&) = delete;

  /// Nothing where the transformation is not defined. About a microsecond.
  std::optional<geometry::Vec2> apply(geometry::Vec2 p) const;
  /// The inverse.
  std::optional<geometry::Vec2> undo(geometry::Vec2 p) const;

private:
  struct Handle;
  std::unique_ptr<Handle> handle_;
};

/// @brief Returns the factor by which lengths in the plane are longer than on the Earth. Not thread-safe.
class Distortion {
public:
  /// @throws ConfigError if PROJ does not know the system
  explicit Distortion(const std::string& plane);
  ~Distortion();
  Distortion(const Distortion&) = delete;
  Distortion& operator=(const Distortion&) = delete;

  /// @brief Length in the plane over that on the Earth, in the direction in which it differs most from 1; 1 where that
  /// is not known. Some microseconds. @param place longitude and latitude in degrees
  double scale(geometry::Vec2 place) const;

private:
  struct Handle;
  std::unique_ptr<Handle> handle_;
};

/// @brief Are its coordinates angles? @throws ConfigError if PROJ does not know it
bool is_geographic(const std::string& crs);

/// @brief Whole definition as WKT 2 of 2019. @throws ConfigError if PROJ does not know it
std::string well_known_text(const std::string& crs);

/// @brief Farthest that a point may be from the middle of local_plane's points, in degrees: lengths there are 1.17
/// times too long.
inline constexpr double farthest_degrees = 45;

/// @brief A plane around points on the Earth, metres from their middle, in which angles are right: the stereographic
/// projection. Lengths are right to 1 in 10^4 up to 127 km from the middle.
/// @param degrees_east_north longitude and latitude; at least one, finite
/// @throws GeometryError if a point is farther than farthest_degrees from the middle
std::string local_plane(std::span<const geometry::Vec2> degrees_east_north);

} // namespace trime::projection
