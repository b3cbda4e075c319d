// SPDX-License-Identifier: BSD-3-Clause
// Which size a mesh will have, what its boundary will be, and at which size nothing of the shape would be simplified:
// about, and without making a mesh.
#pragma once

#include "fitting/layout.hpp"

namespace trime::fitting {

/// What a run has before it.
struct LaidOutlook {
  FittedStage laid;          ///< boundary sites at about the size of the mesh: neither guard nor state
  double points = 0;         ///< about so many
  double keeping_factor = 0; ///< the largest found at which nothing is simplified; else the least tried
  bool keeps = false;        ///< at that factor everything is kept

  /// About how many points a mesh with a size of this factor has.
  double points_at(double factor) const;
};

/// @brief The size is fitted for LayoutRules::outlook_points points at most and scaled from there. Then come at most
/// LayoutRules::outlook_trials simplifications of the boundary, down to the size at which it has
/// LayoutRules::outlook_sites sites. Collective.
/// @throws as PointScheme::first
LaidOutlook look_ahead(const LayoutContext& context);

} // namespace trime::fitting
