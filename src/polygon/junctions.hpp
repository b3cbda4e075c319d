// SPDX-License-Identifier: BSD-3-Clause
// Which junctions of a loop's pieces are corners: for those who lay sites on them and for those who count them.
#pragma once

#include "trime/geometry/boundary.hpp"

#include <cstddef>

namespace trime::polygon {

/// Does another part of the shape begin with this piece? A facet across that place would belong to both.
inline bool changes_part(const geometry::Loop& loop, std::size_t piece) {
  return loop.pieces[piece > 0 ? piece - 1 : loop.pieces.size() - 1].part != loop.pieces[piece].part;
}

/// Is the start of a piece a corner, by its turn or by its part? Corners below the resolution may be left out.
inline bool is_corner(const geometry::Loop& loop, std::size_t piece, double corner_degrees) {
  return changes_part(loop, piece) || loop.turn_degrees(piece) > corner_degrees;
}

} // namespace trime::polygon
