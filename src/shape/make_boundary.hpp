// SPDX-License-Identifier: BSD-3-Clause
// Makes the boundary of the shape from the parts and the region.
#pragma once

#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/shape/part.hpp"
#include "trime/shape/region_shape.hpp"

#include <span>
#include <vector>

namespace trime::shape {

/// @brief Makes the boundary of a region: cuts the boundaries of the parts at their crossings, and keeps the pieces
/// with the region on one side only.
///
/// It uses no grid and no tracing. Crossings are computed to a lattice step, and everything else is combinatorial.
/// Features smaller than a few lattice steps vanish. Loops are ordered by their lexicographically smallest start, where
/// each begins; tags follow that order from 1. In a periodic container the region is where any image of its parts lies,
/// and loops are unrolled (see Loop). Piece::part is an index into part_names: `parts`, then `domain` if the region has
/// it. O(M log M) for M pieces.
/// @throws GeometryError if the region is empty, leaves the container, or its boundary touches itself, or if a part
/// sticks out of a periodic side by more than one period
geometry::Domain make_boundary(const Region& region, std::span<const Part> parts, const geometry::Frame& frame);
/// As above, but frees the parts before it makes loops, unless a periodic container or markers need them longer.
geometry::Domain make_boundary(const Region& region, std::vector<Part>&& parts, const geometry::Frame& frame);

} // namespace trime::shape
