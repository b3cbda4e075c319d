// SPDX-License-Identifier: BSD-3-Clause
// The result of a search if the points are too few for the shape, and the error if bounds forbid the edge length.
#pragma once

#include "fitting/layout_context.hpp"
#include "sites/stage.hpp"

#include <cmath>
#include <optional>
#include <string>

namespace trime::fitting {

/// Says that the points asked for are too few for the shape at any size. It is the same on all ranks.
struct TooFewPoints {
  std::string reason; ///< a whole message for the user
};

/// The boundary with the fewest points among those tried, and where it needs most of them.
struct Fewest {
  double points = INFINITY;
  bool counted = true; ///< if false, counting ended early, and there are more
  geometry::Segment shortest{};

  /// @param all_counted if true, all points of the trial were counted
  void consider(const sites::Stage& stage, double trial_points, bool all_counted = true);
};

/// Returns the message for the user. @param counted if false, counting ended early, and there are more
TooFewPoints too_few_points(const LayoutContext& context, double fewest, bool counted = true);
TooFewPoints too_few_points(const LayoutContext& context, const Fewest& fewest);

/// @brief Says so if the shape is so thin nearly everywhere that the simplified curves of the stage enclose several
/// times its area: then the mesh would be of another shape.
std::optional<TooFewPoints> too_thin(const LayoutContext& context, const sites::Stage& stage);

/// Returns true if a trial has less than half of the points asked for, while the boundary needs too many at the next
/// smaller size. Then there is no mesh with this number of points.
bool is_jump(double points, double wanted);

/// @throws ConfigError if the edge length is outside the bounds of the size
void check_edge_length(const FitOptions& options);

} // namespace trime::fitting
