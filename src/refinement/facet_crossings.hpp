// SPDX-License-Identifier: BSD-3-Clause
// Finds boundary edges that cross others: where two parts of the boundary lie close together, with outside in between,
// edges on the curve might.
#pragma once

#include "trime/geometry/lattice.hpp"
#include "trime/geometry/vec2.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace trime::refinement {

/// @brief Returns those of the segments `tried` (by index, ascending) that cross or touch one of `all` with which they
/// share no end. Exact. Cost: O(n log n) for n segments of both lists.
/// @param all segments that begin in the container; they may end in the next periodic image of it @param tried are
/// some of them
std::vector<std::size_t> crossing(std::span<const geometry::Segment> all, std::span<const geometry::Segment> tried,
                                  const geometry::Periods& periods);

} // namespace trime::refinement
