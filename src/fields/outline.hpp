// SPDX-License-Identifier: BSD-3-Clause
// The boundary of a shape in the coordinates of a raster, and which cells of the raster the shape needs.
#pragma once

#include "fields/raster.hpp"
#include "fields/read_field.hpp"
#include "trime/geometry/boundary.hpp"

#include <optional>
#include <vector>

namespace trime::fields {

/// Closed chains of places in the coordinates of the file, at most half a cell apart. Longitudes go on across the seam.
struct Outline {
  std::vector<std::vector<geometry::Vec2>> loops, in_plane; ///< coordinates of the file, and of the mesh
  bool winds = false; ///< true if a loop goes around the Earth; then the shape holds a pole
  geometry::Box box;  ///< in the coordinates of the file
};

Outline outline_of(const geometry::Boundary& boundary, const ToFile& to_file, geometry::Vec2 cell, double period);

/// @brief Checks that all places of the outline are at most half a cell away from centres.
/// @throws GeometryError with the first place that is farther away, and the share of the shape
void check_cover(const Outline& outline, const geometry::Box& cells, const std::string& path);

/// @brief Checks that the raster has all values between which the shape lies.
/// @param origin the raster's first cell in the file @param file for row numbers
/// @throws GeometryError with file, row, column, place and number of the values that are missing
void check_values(const Outline& outline, const Raster& raster, const Window& window, const RasterFile& file,
                  const std::string& path);

} // namespace trime::fields
