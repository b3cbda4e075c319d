// SPDX-License-Identifier: BSD-3-Clause
// The areas between arcs of circles and the chords that replace them.
#pragma once

#include "generalise/region_map.hpp"
#include "trime/geometry/region_loss.hpp"

#include <span>
#include <vector>

namespace trime::generalise {

/// @brief Adds what regions lose because chords replace arcs of circles, to losses that were counted with the triangles
/// of a map. The area between an arc and its chord goes to the region that the map has next to the chord now. Where the
/// triangles there have changed their region, that area was counted for the region on the wrong side of the arc; it is
/// taken off again. Cost: O(n).
/// @param stays by arc: 1 if the arc itself stays in the curves
void add_chord_losses(const RegionMap& map, std::span<const char> stays, std::vector<geometry::RegionLoss>& losses);

} // namespace trime::generalise
