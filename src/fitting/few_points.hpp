// SPDX-License-Identifier: BSD-3-Clause
// What a search answers if the points are too few for the shape; and the error for bounds that forbid the edge length.
#pragma once

#include "fitting/layout_context.hpp"
#include "sites/stage.hpp"

#include <cmath>
#include <string>

namespace trime::fitting {

/// The points asked for are too few for the shape, at any size. The same on all ranks.
struct TooFewPoints {
  std::string reason; ///< a whole message for the user
};

/// The boundary that takes the fewest points among those tried, and where it takes most of them.
struct Fewest {
  double points = INFINITY;
  bool counted = true; ///< to the end; else there would be more
  geometry::Segment shortest{};

  /// @param all_counted the points of the trial were counted to the end
  void consider(const sites::Stage& stage, double trial_points, bool all_counted = true);
};

/// Returns the message for the user. @param counted to the end; else there would be more
TooFewPoints too_few_points(const LayoutContext& context, double fewest, bool counted = true);
TooFewPoints too_few_points(const LayoutContext& context, const Fewest& fewest);

/// The boundary takes too many points at one size, and at the next larger there are less than half of those asked for:
/// that is no mesh of so many points.
bool is_jump(double points, double wanted);

/// @throws ConfigError for bounds that the edge length itself breaks
void check_edge_length(const FitOptions& options);

} // namespace trime::fitting
