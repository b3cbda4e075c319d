// SPDX-License-Identifier: BSD-3-Clause
// From the parts and the region to the boundary of the shape.
#pragma once

#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/shape/part.hpp"
#include "trime/shape/region_shape.hpp"

#include <span>
#include <vector>

namespace trime::shape {

/// @brief The boundary of a region: the parts' boundaries, cut at their crossings, and of those the pieces with the
/// region on one side only.
///
/// No grid and no tracing: crossings are computed to a lattice step, everything else is combinatorial. Features smaller
/// than a few lattice steps vanish. Loops are ordered by their lexicographically smallest start, where each begins;
/// tags follow that order from 1. In a periodic container the region is where any image of its parts lies, and loops
/// are unrolled (see Loop). Piece::part is an index into part_names: `parts`, then `domain` if the region has it.
/// O(M log M) for M pieces.
/// @throws GeometryError if the region is empty, leaves the container, or its boundary touches itself, or if a part
/// sticks out of a periodic side by more than one period
geometry::Domain make_boundary(const Region& region, std::span<const Part> parts, const geometry::Frame& frame);
/// Does the same, and frees the parts before it makes loops, unless a periodic container or markers need them longer.
geometry::Domain make_boundary(const Region& region, std::vector<Part>&& parts, const geometry::Frame& frame);

} // namespace trime::shape
