// SPDX-License-Identifier: BSD-3-Clause
// Makes curves from the regions of triangles: the interfaces between triangles of different regions.
#pragma once

#include "generalise/absorb_parts.hpp"
#include "generalise/region_map.hpp"

namespace trime::generalise {

/// @brief Returns the interfaces after some labels have changed, and the boundary with its regions and corners. Arcs
/// between the same nodes and regions as before stay as they are, in their order; the others follow. What the
/// simplification had taken from the left side of a changed arc is added to InnerCurves::losses. Changed arcs of
/// circles become chords. Cost: O(n log n).
/// @param map of these curves and this boundary
/// @param losses what regions have lost with the changed labels, as areas of triangles of the map; add_chord_losses()
/// corrects it, and InnerCurves::losses receives it
Partition curves_of_labels(const RegionMap& map, const geometry::InnerCurves& curves,
                           const geometry::Boundary& boundary, std::vector<geometry::RegionLoss> losses);

} // namespace trime::generalise
