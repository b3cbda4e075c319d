// SPDX-License-Identifier: BSD-3-Clause
// Makes the boundary of the shape from its parts and the expression that joins them.
#pragma once

#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/shape/part.hpp"
#include "trime/shape/region_shape.hpp"

#include <span>
#include <vector>

namespace trime::shape {

/// @brief Makes the boundary of a shape: cuts the boundaries of the parts at their crossings, and keeps the pieces that
/// have the inside of the shape on exactly one side.
///
/// Crossings are computed to a lattice step; everything else is combinatorial, without a grid. Features smaller than a
/// few lattice steps vanish. Loops are ordered by their lexicographically smallest start, where each begins; tags
/// follow this order from 1. In a periodic container, the shape covers all places where a periodic image of its parts
/// lies, and loops are unrolled (see Loop). Piece::part is an index into part_names, which are the names of `parts`,
/// then `domain` if the expression contains it. Cost: O(M log M) for M pieces.
/// @throws GeometryError if the shape is empty, leaves the container, or its boundary touches itself, or if a part
/// extends beyond a periodic side by more than one period
/// @param inner curves and regions inside the shape
geometry::Domain make_boundary(const Region& region, std::span<const Part> parts, const geometry::Frame& frame,
                               const InnerParts& inner = {});
/// Does the same, but frees the parts before loops are made, unless a periodic container or markers need them longer.
geometry::Domain make_boundary(const Region& region, std::vector<Part>&& parts, const geometry::Frame& frame,
                               const InnerParts& inner = {});

} // namespace trime::shape
