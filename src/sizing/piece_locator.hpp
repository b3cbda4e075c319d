// SPDX-License-Identifier: BSD-3-Clause
// Finds the nearest point of a boundary and of its periodic images.
#pragma once

#include "cones/box_tree.hpp"
#include "sizing/images.hpp"
#include "trime/core/types.hpp"
#include "trime/geometry/boundary.hpp"

#include <optional>
#include <vector>

namespace trime::sizing {

/// A hierarchy of boxes around runs of consecutive pieces. Immutable; queries are thread-safe.
class PieceLocator {
public:
  /// Takes O(M) time for M pieces.
  PieceLocator(const geometry::Boundary& boundary, const Images& images);
  /// [1] Share by which the returned point may be farther away than the nearest. All segments of a circle are almost
  /// equally near to its centre, and examining each one would take too long.
  static constexpr double slack = 5e-4;
  /// A boundary point, and the segment on which it lies; on an arc, all three are the boundary point.
  struct Nearest {
    geometry::Vec2 point, segment_start, segment_end;
  };
  /// Returns the boundary point nearest to p, if one is nearer than `reach`. O(log M) for curves.
  std::optional<Nearest> nearest(geometry::Vec2 p, double reach) const;

private:
  /// A circular piece or one of its images.
  struct Arc {
    geometry::Piece piece;
    geometry::Vec2 shift;
    geometry::Box box;
  };
  std::vector<cones::SegmentLeaf> segments_;
  cones::BoxTree segment_tree_;
  std::vector<Arc> arcs_;
  cones::BoxTree arc_tree_;
  cones::SearchKernel kernel_;
};

} // namespace trime::sizing
