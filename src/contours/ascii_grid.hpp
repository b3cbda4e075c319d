// SPDX-License-Identifier: BSD-3-Clause
// Reads rasters in the text format of ESRI (ARC/INFO ASCII grid), which GDAL writes as AAIGrid.
#pragma once

#include "trime/geometry/vec2.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace trime::contours {

/// A raster of cells. Row 0 is the northernmost one.
struct AsciiGrid {
  int columns = 0, rows = 0;
  geometry::Vec2 corner;      ///< lower left corner of the lower left cell
  geometry::Vec2 cell;        ///< width and height of a cell
  std::vector<double> values; ///< by row, then by column; NaN: no data
  int first_line = 0;         ///< line of the first row in the file

  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
  }
};

/// @brief Reads the head (`ncols`, `nrows`, `xllcorner` or `xllcenter`, `yllcorner` or `yllcenter`, `cellsize` or `dx`
/// and `dy`, and `NODATA_value` if it is given) and the values. A line may hold any number of values.
/// @throws GeometryError `source:line: ...` for any other text, and for more than 2^26 cells
/// Cost: O(cells).
AsciiGrid read_ascii_grid(std::string_view text, const std::string& source);

} // namespace trime::contours
