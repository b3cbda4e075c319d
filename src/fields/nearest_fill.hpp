// SPDX-License-Identifier: BSD-3-Clause
// Gives values to the cells of a raster that have none.
#pragma once

#include "fields/raster.hpp"

namespace trime::fields {

/// @brief Gives each NaN the value of the nearest centre that has one, and marks it in `filled`. Of several nearest
/// centres one in the westernmost column counts. Does nothing if no value is NaN, or if all are. Cost: O(values), and 4
/// bytes for each value while it works. The distance is Euclidean, in the coordinates of the raster (P. Felzenszwalb,
/// D. Huttenlocher, "Distance transforms of sampled functions", 2012, with places).
void fill_with_nearest(Raster& raster);

} // namespace trime::fields
