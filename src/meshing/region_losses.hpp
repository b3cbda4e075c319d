// SPDX-License-Identifier: BSD-3-Clause
// Adds up what the regions of a shape lose to each other in the mesh.
#pragma once

#include "trime/geometry/boundary.hpp"
#include "trime/geometry/region_loss.hpp"

#include <vector>

namespace trime::meshing {

/// @brief Returns the losses added up by loser, winner and reason, in this order. Sums that are a negligible share of
/// the area of both regions are left out: these are rounding errors. Cost: O(n log n).
/// @param losses place by place, in any order that is the same on all ranks
std::vector<geometry::RegionLoss> summed_losses(std::vector<geometry::RegionLoss> losses,
                                                const geometry::Regions& regions);

} // namespace trime::meshing
