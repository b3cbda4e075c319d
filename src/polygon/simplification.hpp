// SPDX-License-Identifier: BSD-3-Clause
// Counts how the curves of a shape were simplified before the sites of a stage were laid on them. Plain data.
#pragma once

#include "trime/geometry/boundary.hpp"

#include <algorithm>
#include <cstdint>

namespace trime::polygon {

/// Counts of changes to a boundary over all passes.
struct Simplification {
  std::int64_t cut = 0;      ///< narrow parts of the shape that were removed
  std::int64_t filled = 0;   ///< filled holes with a small perimeter
  std::int64_t closed = 0;   ///< narrow parts of the outside that were filled
  std::int64_t widened = 0;  ///< narrow parts of the outside, and thin components, whose sides were moved apart, in the
                             ///< pass with most of them
  std::int64_t thinned = 0;  ///< pieces of ragged runs that were replaced by fewer pieces
  std::int64_t smoothed = 0; ///< vertices of ragged runs that were replaced by others
  double cut_area = 0, closed_area = 0; ///< areas in squared units of the coordinates
  double largest_move = 0;              ///< longest move of a vertex, over h
  double coarseness = 1;                ///< h for which this was done, over h of the mesh

  void add(const Simplification& other) {
    cut += other.cut;
    filled += other.filled;
    closed += other.closed;
    widened = std::max(widened, other.widened); // later passes may widen the same parts a little more
    thinned += other.thinned;
    smoothed += other.smoothed;
    cut_area += other.cut_area;
    closed_area += other.closed_area;
    largest_move = std::max(largest_move, other.largest_move);
  }
};

/// Returns the number of pieces of all loops.
inline std::int64_t piece_count(const geometry::Boundary& boundary) {
  std::int64_t count = 0;
  for (const geometry::Loop& loop : boundary.loops)
    count += static_cast<std::int64_t>(loop.pieces.size());
  return count;
}

} // namespace trime::polygon
