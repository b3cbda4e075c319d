// SPDX-License-Identifier: BSD-3-Clause
// Estimates, without making a mesh, the size of its triangles, its boundary, and the size below which no feature of the
// shape would be simplified.
#pragma once

#include "fitting/layout_context.hpp"
#include "sites/stage.hpp"

namespace trime::fitting {

/// The estimate of the option --dry-run.
struct LaidOutlook {
  sites::Stage stage; ///< boundary sites at about the size of the mesh, without guard and state
  double factor = 1;  ///< factor of that size
  double points = 0;  ///< about the number of points
  /// Largest factor found at which nothing is simplified, otherwise the smallest factor tried.
  double keeping_factor = 0;
  bool keeps = false; ///< true if nothing is simplified at that factor

  /// Returns about how many points a mesh with the factor `other` has.
  double points_at(double other) const;
};

/// @brief Makes the estimate. It fits the size for at most LayoutRules::outlook_points points and scales it. Then it
/// simplifies the boundary at most LayoutRules::outlook_trials times, down to the size at which it has
/// LayoutRules::outlook_sites sites. Collective.
/// @throws ConfigError if the points are too few for the shape, or the edge length is outside the bounds of the size
LaidOutlook look_ahead(const LayoutContext& context);

} // namespace trime::fitting
