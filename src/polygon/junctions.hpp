// SPDX-License-Identifier: BSD-3-Clause
// Decides which junctions between pieces of a loop are corners.
#pragma once

#include "trime/geometry/boundary.hpp"

#include <cstddef>

namespace trime::polygon {

/// Returns whether another part of the shape begins with this piece. Then a facet across the junction would belong to
/// both parts.
inline bool changes_part(const geometry::Loop& loop, std::size_t piece) {
  return loop.pieces[piece > 0 ? piece - 1 : loop.pieces.size() - 1].part != loop.pieces[piece].part;
}

/// Returns whether the start of a piece is a corner, because the boundary turns there or another part begins. Corners
/// below the resolution may be left out later.
inline bool is_corner(const geometry::Loop& loop, std::size_t piece, double corner_degrees) {
  return changes_part(loop, piece) || loop.turn_degrees(piece) > corner_degrees;
}

} // namespace trime::polygon
