// SPDX-License-Identifier: BSD-3-Clause
// Nearest point of a boundary and of its periodic images.
#pragma once

#include "cones/box_tree.hpp"
#include "sizing/images.hpp"
#include "trime/core/types.hpp"
#include "trime/geometry/boundary.hpp"

#include <optional>
#include <vector>

namespace trime::sizing {

/// Boxes around runs of consecutive pieces, and around those. Immutable; queries are thread-safe.
class PieceLocator {
public:
  /// O(M) time for M pieces.
  PieceLocator(const geometry::Boundary& boundary, const Images& images);
  /// Share by which the returned point may be farther than the nearest. From the centre of a circle of many segments
  /// all are nearly equally near, and examining each one would take too long.
  static constexpr double slack = 5e-4;
  /// A boundary point, and the segment it lies on; the same point three times if that is an arc.
  struct Nearest {
    geometry::Vec2 point, segment_start, segment_end;
  };
  /// Nearest boundary point to p that is nearer than `reach`, if there is any. O(log M) for curves.
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
