// SPDX-License-Identifier: BSD-3-Clause
// The result of a search when a shape needs more points than were asked for, and the error when the limits of the size
// exclude the edge length.
#pragma once

#include "fitting/layout_context.hpp"
#include "sites/stage.hpp"
#include "sizing/lowered_size.hpp"

#include <cmath>
#include <optional>
#include <span>
#include <string>

namespace trime::fitting {

/// Says that the shape needs more points than were asked for, at any size. All ranks hold the same message.
struct TooFewPoints {
  std::string reason; ///< a whole message for the user
  double fewest = 0;  ///< the mesh would have at least about this number of points; 0 if that is not known
};

/// The boundary with the fewest points among all trials, and the place where its sites are closest together.
struct Fewest {
  double points = INFINITY;
  bool counted = true;          ///< if false, counting was stopped early, and there are more than `points`
  geometry::Segment shortest{}; ///< edge on the boundary or on a line inside
  bool inside = false;          ///< whether that edge lies on a line inside

  /// @param all_counted if true, all points of the trial were counted
  void consider(const sites::Stage& stage, double trial_points, bool all_counted = true);
};

/// Returns the message for the user. @param counted if false, counting was stopped early, and there are more than
/// `fewest`
TooFewPoints too_few_points(const LayoutContext& context, double fewest, bool counted = true);
TooFewPoints too_few_points(const LayoutContext& context, const Fewest& fewest);

/// @brief Says so if the size is so low at one of the places that the mesh has too many points.
/// @param places where the size is limited, at the largest factor that was tried
std::optional<TooFewPoints> too_small_size(const LayoutContext& context, std::span<const sizing::SizeLimit> places);

/// @brief Says so if the shape is so thin nearly everywhere that the simplified curves of the stage enclose several
/// times its area: then the mesh would be of another shape.
std::optional<TooFewPoints> too_thin(const LayoutContext& context, const sites::Stage& stage);

/// Returns true if a trial has less than half of the points asked for, while the boundary needs too many at the next
/// smaller size. Then there is no mesh with this number of points.
bool is_jump(double points, double wanted);

/// @throws ConfigError if the edge length is below min_size or above max_size
void check_edge_length(const FitOptions& options);

} // namespace trime::fitting
