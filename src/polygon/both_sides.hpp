// SPDX-License-Identifier: BSD-3-Clause
// Views the boundary and the curves inside a shape as closed walks around the faces between them.
#pragma once

#include "polygon/polygon.hpp"

namespace trime::polygon {

/// @brief Returns the sites with one entry for each side of a chord that faces the inside. The entries of the boundary
/// keep their numbers; then come two for each chord of a curve, one in each direction, so that a place may occur
/// several times. `next` and `previous` lead around the face on the left. Nodes are corners, except free ends of
/// curves. Cost: O(n + c log c) for n boundary sites and c chords of curves.
BoundarySites with_both_sides(const BoundarySites& boundary);

} // namespace trime::polygon
