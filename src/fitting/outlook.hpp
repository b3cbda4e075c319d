// SPDX-License-Identifier: BSD-3-Clause
// Which size a mesh will have, what its boundary will be, and at which size nothing of the shape would be simplified:
// about, and without making a mesh.
#pragma once

#include "fitting/layout_context.hpp"
#include "sites/stage.hpp"

namespace trime::fitting {

/// What a run has before it.
struct LaidOutlook {
  sites::Stage stage;        ///< boundary sites at about the size of the mesh: neither guard nor state
  double factor = 1;         ///< of that size
  double points = 0;         ///< about so many
  double keeping_factor = 0; ///< the largest found at which nothing is simplified; else the least tried
  bool keeps = false;        ///< at that factor everything is kept

  /// About how many points a mesh with a size of another factor has.
  double points_at(double other) const;
};

/// @brief The size is fitted for LayoutRules::outlook_points points at most and scaled from there. Then come at most
/// LayoutRules::outlook_trials simplifications of the boundary, down to the size at which it has
/// LayoutRules::outlook_sites sites. Collective.
/// @throws ConfigError if the points are too few for the shape, or the edge length is outside the bounds of the size
LaidOutlook look_ahead(const LayoutContext& context);

} // namespace trime::fitting
