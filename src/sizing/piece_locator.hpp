// SPDX-License-Identifier: BSD-3-Clause
// Nearest point of a boundary and of its periodic images.
#pragma once

#include "sizing/box_tree.hpp"
#include "sizing/images.hpp"
#include "trime/core/types.hpp"
#include "trime/geometry/boundary.hpp"

#include <array>
#include <optional>
#include <vector>

namespace trime::sizing {

/// Boxes around runs of consecutive pieces, and around those. Immutable; queries are thread-safe.
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
  struct Item {
    geometry::Vec2 a, b;  ///< of a segment
    geometry::Vec2 shift; ///< of an arc, already added to a segment
    LocalIndex arc;       ///< into arcs_, or -1 for a segment
  };
  /// The segments a + t d, 0 <= t <= 1, of a leaf; arcs are marked by NaN.
  struct alignas(64) Run {
    std::array<double, BoxTree::width> a_x, a_y, d_x, d_y, inverse_square;
    bool has_arcs;
  };
  struct Best {
    geometry::Vec2 point;
    double squared_distance;
  };
  void add_run(std::size_t first);
  void visit(std::size_t first, std::size_t last, geometry::Vec2 p, Best& best) const;

  std::vector<Item> items_;
  std::vector<geometry::Piece> arcs_;
  std::vector<Run> runs_; // of items
  BoxTree tree_;
};

} // namespace trime::sizing
