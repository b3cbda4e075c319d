// SPDX-License-Identifier: BSD-3-Clause
// Errors for points that are too few for the shape, and for bounds of the size that forbid the edge length.
#pragma once

#include "fitting/layout.hpp"

#include <cmath>

namespace trime::fitting {

/// The boundary that takes the fewest points among those tried, and where it takes most of them.
struct Fewest {
  double points = INFINITY;
  bool counted = true; ///< to the end; else there would be more
  geometry::Segment shortest{};

  /// @param all_counted the points of the trial were counted to the end
  void consider(const sites::Stage& stage, double trial_points, bool all_counted = true);
};

/// @param counted to the end; else there would be more @throws ConfigError always
[[noreturn]] void fail_for_few_points(const LayoutContext& context, double fewest, bool counted = true);
[[noreturn]] void fail_for_few_points(const LayoutContext& context, const Fewest& fewest);

/// The boundary takes too many points at one size, and at the next larger there are less than half of those asked for:
/// that is no mesh of so many points.
bool is_jump(double points, double wanted);

/// @throws ConfigError for bounds that the edge length itself breaks
void check_edge_length(const FitOptions& options);

} // namespace trime::fitting
