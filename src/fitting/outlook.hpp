// SPDX-License-Identifier: BSD-3-Clause
// Estimates, without making a mesh, the size of its triangles, its boundary, and the size below which no feature of the
// shape would be simplified.
#pragma once

#include "fitting/layout_context.hpp"
#include "sites/stage.hpp"

namespace trime::fitting {

/// The estimate of the option --dry-run.
struct LaidOutlook {
  double factor = 1;       ///< factor of the size
  double points = 0;       ///< about the number of points
  double placed_first = 0; ///< points on the boundary and fixed points among them
  /// Largest factor found at which nothing is simplified, otherwise the smallest factor tried.
  double keeping_factor = 0;
  bool keeps = false; ///< true if nothing is simplified at that factor

  /// Returns about how many points a mesh with the factor `other` has.
  double points_at(double other) const;
};

/// @brief Estimates factor and points placed first for `points` of the outlook. It fits the size for at most
/// LayoutRules::outlook_points points and scales it. Collective.
/// @return boundary sites at about the size of the mesh, without guard and state
/// @throws ConfigError if the points are too few for the shape, or the edge length is outside the bounds of the size
sites::Stage look_ahead(const LayoutContext& context, LaidOutlook& outlook);

/// Returns whether nothing is cut, closed, moved, thinned or dropped with this factor. Collective.
bool keeps_all(const LayoutContext& context, double factor);

/// @brief Finds the keeping factor. It simplifies the boundary at most LayoutRules::outlook_trials times, down to the
/// size at which it has LayoutRules::outlook_sites sites. Collective. @pre the other numbers of the outlook are set
void find_keeping_factor(const LayoutContext& context, LaidOutlook& outlook);

} // namespace trime::fitting
