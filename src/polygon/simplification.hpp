// SPDX-License-Identifier: BSD-3-Clause
// Counts of the changes to the curves of a shape before the sites of a stage were laid on them. Plain data.
#pragma once

#include "trime/geometry/boundary.hpp"

#include <algorithm>
#include <cstdint>

namespace trime::polygon {

/// Narrow parts of a boundary, and what became of them, over all passes.
struct Simplification {
  std::int64_t cut = 0;    ///< narrow parts of the shape that were taken away
  std::int64_t filled = 0; ///< holes with a small perimeter
  std::int64_t closed = 0; ///< narrow parts of the outside that were filled
  std::int64_t widened =
      0; ///< narrow parts of the outside and thin components, sides moved apart; in the pass with most
  std::int64_t thinned = 0;             ///< pieces of ragged runs that others stand for
  std::int64_t smoothed = 0;            ///< vertices of ragged runs that others stand for
  double cut_area = 0, closed_area = 0; ///< in the units of the coordinates, squared
  double largest_move = 0;              ///< of a vertex, over h
  double coarseness = 1;                ///< the h that this was done for, over that of the mesh
  std::int64_t severed = 0;             ///< of what was cut or closed: parts that joined or separated what stays
  double widest_severed = 0;            ///< [h] the least width of the widest of them
  geometry::Vec2 severed_place;         ///< where that is
  std::int64_t held = 0;                ///< narrow parts that stay since they join or separate; in the pass with most

  void add(const Simplification& other) {
    cut += other.cut;
    filled += other.filled;
    closed += other.closed;
    widened = std::max(widened, other.widened); // what a pass widens, the next ones may widen a little more
    thinned += other.thinned;
    smoothed += other.smoothed;
    cut_area += other.cut_area;
    closed_area += other.closed_area;
    largest_move = std::max(largest_move, other.largest_move);
    severed += other.severed;
    if (other.widest_severed > widest_severed) {
      widest_severed = other.widest_severed;
      severed_place = other.severed_place;
    }
    held = std::max(held, other.held);
  }
};

/// Number of pieces of all loops.
inline std::int64_t piece_count(const geometry::Boundary& boundary) {
  std::int64_t count = 0;
  for (const geometry::Loop& loop : boundary.loops)
    count += static_cast<std::int64_t>(loop.pieces.size());
  return count;
}

} // namespace trime::polygon
