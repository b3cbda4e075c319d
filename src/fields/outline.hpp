// SPDX-License-Identifier: BSD-3-Clause
// The boundary of a shape in the coordinates of a raster, and the values of the raster that the shape needs.
#pragma once

#include "fields/raster.hpp"
#include "fields/read_field.hpp"
#include "trime/geometry/boundary.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace trime::fields {

/// Closed chains of places in the coordinates of the file, at most half a cell apart. Longitudes go on across the seam.
struct Outline {
  std::vector<std::vector<geometry::Vec2>> loops, in_plane; ///< coordinates of the file, and of the mesh
  bool winds = false; ///< true if a loop goes around the Earth; then the shape holds a pole
  geometry::Box box;  ///< in the coordinates of the file
};

/// @brief Converts the boundary of a shape to the coordinates of a file.
/// @param cell sides of a cell of the raster; infinite: only ends of pieces and some places on arcs
/// @param period of x in the file, 0: none
/// @throws GeometryError with a place that has no coordinates in the file
Outline outline_of(const geometry::Boundary& boundary, const ToFile& to_file, geometry::Vec2 cell, double period);

/// @brief Checks that all places of the outline are at most half a cell away from centres.
/// @throws GeometryError with the first place that is farther away, and the share of the shape
void check_cover(const Outline& outline, const geometry::Box& cells, const std::string& path);

/// The values that a shape needs and that are NaN: their number, and where the first one lies in the raster.
struct MissingValues {
  std::int64_t count = 0, column = 0, row = 0;
};

/// Returns which values are missing among those between which the shape lies.
MissingValues missing_values(const Outline& outline, const Raster& raster);

} // namespace trime::fields
