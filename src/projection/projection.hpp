// SPDX-License-Identifier: BSD-3-Clause
// Converts coordinates between reference systems of maps with PROJ, for example longitude and latitude to a plane.
#pragma once

#include "trime/geometry/vec2.hpp"

#include <memory>
#include <optional>
#include <span>
#include <string>

namespace trime::projection {

/// The reference system of GeoJSON: longitude and latitude in degrees, in this order, on WGS 84.
inline constexpr const char* lon_lat = "OGC:CRS84";

/// @brief Converts from one reference system to another. Systems are named as in PROJ: `EPSG:32633`, `+proj=...`, WKT.
/// The first coordinate is always longitude or easting. Not thread-safe; takes a few kilobytes.
class Transform {
public:
  /// @throws ConfigError if PROJ does not know one of the systems, or no conversion between them
  Transform(const std::string& from, const std::string& to);
  ~Transform();
  Transform(const Transform&) = delete;
  Transform& operator=(const Transform&) = delete;

  /// Returns the converted point, or nothing if the conversion is not defined there. Takes about a microsecond.
  std::optional<geometry::Vec2> apply(geometry::Vec2 p) const;
  /// Converts in the opposite direction.
  std::optional<geometry::Vec2> undo(geometry::Vec2 p) const;

private:
  struct Handle;
  std::unique_ptr<Handle> handle_;
};

/// @brief Measures the factor by which lengths in a plane are longer than on the Earth. Not thread-safe.
class Distortion {
public:
  /// @throws ConfigError if PROJ does not know the system
  explicit Distortion(const std::string& plane);
  ~Distortion();
  Distortion(const Distortion&) = delete;
  Distortion& operator=(const Distortion&) = delete;

  /// @brief Returns length in the plane divided by length on the Earth, in the direction in which this ratio differs
  /// most from 1; 1 if it is unknown. Takes a few microseconds.
  /// @param place longitude and latitude in degrees
  double scale(geometry::Vec2 place) const;

private:
  struct Handle;
  std::unique_ptr<Handle> handle_;
};

/// @brief Returns whether the coordinates of a reference system are angles.
/// @throws ConfigError if PROJ does not know the system
bool is_geographic(const std::string& crs);

/// @brief Returns the definition of a reference system as WKT 2 of 2019.
/// @throws ConfigError if PROJ does not know the system
std::string well_known_text(const std::string& crs);

/// @brief [degrees] Largest distance of a point from the middle of the points that local_plane accepts. At this
/// distance, lengths in the plane are 1.17 times too long.
inline constexpr double farthest_degrees = 45;

/// @brief Returns the reference system of a plane around points on the Earth: a stereographic projection, which
/// preserves angles, in metres from the middle of the points. The middle is that of the smallest box of longitude and
/// latitude around the points, to 0.01 degrees; the pole if this box is wider than 180 degrees. Lengths have errors
/// below 1 in 10^4 up to 127 km from the middle.
/// @param degrees_east_north longitude and latitude of each point; at least one point, finite
/// @throws GeometryError if a point is farther than farthest_degrees from the middle
std::string local_plane(std::span<const geometry::Vec2> degrees_east_north);

} // namespace trime::projection
