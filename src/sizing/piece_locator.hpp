// SPDX-License-Identifier: BSD-3-Clause
// Nearest point of a boundary and of its periodic images.
#pragma once

#include "sizing/images.hpp"
#include "trime/core/types.hpp"
#include "trime/geometry/boundary.hpp"

#include <optional>
#include <vector>

namespace trime::sizing {

/// Boxes around runs of consecutive pieces, in a binary hierarchy. Immutable; queries are thread-safe.
class PieceLocator {
public:
  /// O(M) time for M pieces.
  PieceLocator(const geometry::Boundary& boundary, const Images& images);
  /// Share by which a point that is taken for the nearest may be farther: from the centre of a circle of many segments
  /// all are nearly as near, and to look at each would take for ever.
  static constexpr double slack = 5e-4;
  /// Nearest boundary point to p that is nearer than `reach`, if there is any. O(log M) for curves.
  std::optional<geometry::Vec2> nearest(geometry::Vec2 p, double reach) const;

private:
  static constexpr std::size_t run_length = 4;
  struct Item {
    geometry::Vec2 a, b;  ///< of a segment
    geometry::Vec2 shift; ///< of an arc, already added to a segment
    LocalIndex arc;       ///< into arcs_, or -1 for a segment
  };
  struct Best {
    geometry::Vec2 point;
    double squared_distance;
  };
  void visit(std::size_t run, geometry::Vec2 p, Best& best) const;

  std::vector<Item> items_;
  std::vector<geometry::Piece> arcs_;
  std::vector<geometry::Box> boxes_; // heap order: the root is 1; the runs are the leaves
};

} // namespace trime::sizing
