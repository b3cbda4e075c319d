// SPDX-License-Identifier: BSD-3-Clause
// The tuned numbers of the module tracing, which turns functions into polygons.
#pragma once

#include <cstddef>

namespace trime::tracing {

/// The numbers of tracing and thinning the zero set of a function.
struct TracingRules {
  /// [halvings] The coarse grid, which is examined first, is halved this many times to get the fine grid. Not measured.
  static constexpr int grid_levels = 2;
  /// [cells] Smallest number of cells of the coarse grid along a side. Not measured.
  static constexpr int fewest_coarse_cells = 16;
  /// [cells] Largest number of cells of the coarse grid along a side. This limit bounds time and memory. Not measured.
  static constexpr int most_coarse_cells = 4096;
  /// [1] Largest deviation of the curve from a chord, divided by the length of the chord. This limit keeps turns of the
  /// polygon below 9 degrees.
  static constexpr double stray_share = 0.02;
};

} // namespace trime::tracing
