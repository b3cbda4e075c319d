// SPDX-License-Identifier: BSD-3-Clause
// Smooths a raster over a length, so that gradients do not follow the noise of its values.
#pragma once

#include "fields/raster.hpp"

#include <cstdint>
#include <functional>

namespace trime::fields {

/// The half width of the weights in cells, along rows and columns.
struct SmoothReach {
  std::function<double(std::int64_t)> in_row; ///< for each row: a degree of longitude is shorter in the north
  double in_column = 0;
};

/// @brief Returns the low-pass of a raster: each value becomes the mean of the values around it with the weights
/// max(0, 1 - |i| / a) max(0, 1 - |j| / b). Here i and j are the differences of columns and rows in cells, and b is
/// in_column; a is in_row of the row that has the averaged value. Filled values and places outside of the raster have
/// no weight; a value whose weights are all 0 stays. Waves shorter than the half width keep at most 5 % of their
/// height, waves of twice that length 41 %, and of four times 81 %. A plane stays a plane away from the border.
///
/// Strips of columns are smoothed one after the other, the rows of a strip by all threads. The result has the same bits
/// for any number of threads. Cost: O(values * (a + b)). Memory: the result, and 64 MB or 16 bytes for each row.
/// @pre both half widths are finite and not negative
Raster smoothed(const Raster& raster, const SmoothReach& reach);

} // namespace trime::fields
