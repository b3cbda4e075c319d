// SPDX-License-Identifier: BSD-3-Clause
// Estimates how many points a mesh will have.
#pragma once

#include "fitting/layout_context.hpp"

namespace trime::fitting {

/// @brief Returns the number of points that was asked for, or about as many as the edge length or the absolute sizes
/// take. Cost: for absolute sizes an integral over the shape with 0.2 cells for each point, at most six times.
/// Collective.
/// @throws GeometryError on all ranks together if a size is not positive and finite; ConfigError if absolute sizes are
/// so small that no rank could hold the points on the boundary
double expected_points(const LayoutContext& context);

/// Returns how many of the points asked for are left to the clean-up, which inserts them along curves and interfaces
/// inside. Their edges are counted as if the size were uniform. 0 if no number was asked for. Cost: O(pieces).
GlobalId reserved_for_curves(const LayoutContext& context);

/// @brief Checks the number of points that absolute sizes take against the limit that the user has set.
/// @throws ConfigError if there are more points than the limit; equal on all ranks if `points` is
void check_point_limit(const FitOptions& options, double points);

} // namespace trime::fitting
