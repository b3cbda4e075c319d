// SPDX-License-Identifier: BSD-3-Clause
// Finds the nearest point of a boundary and of its periodic images.
#pragma once

#include "cones/cone_tree.hpp"
#include "trime/core/types.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/vec2.hpp"

#include <cmath>
#include <optional>
#include <vector>

namespace trime::sizing {

class Images {
public:
  /// @param period_x, period_y the periods; 0 in a direction that is not periodic
  Images(const geometry::Box& container, double period_x, double period_y)
      : container_(container), period_x_(period_x), period_y_(period_y) {}

  /// Returns the shifts that may bring an object into reach of the container, including the null shift. Objects lie in
  /// the container or at most two periods away.
  std::vector<geometry::Vec2> shifts() const {
    std::vector<geometry::Vec2> list;
    const int nx = period_x_ > 0 ? 3 : 0, ny = period_y_ > 0 ? 3 : 0;
    for (int j = -ny; j <= ny; ++j)
      for (int i = -nx; i <= nx; ++i)
        list.push_back({i * period_x_, j * period_y_});
    return list;
  }

  /// Returns whether an object in the box may be the nearest one to some point of the container. Always true if the
  /// container is not periodic.
  bool in_reach(const geometry::Box& box) const {
    return overlaps(box.min.x, box.max.x, container_.min.x, container_.max.x, period_x_) &&
           overlaps(box.min.y, box.max.y, container_.min.y, container_.max.y, period_y_);
  }

  /// Returns the image of p in the container along periodic axes; other coordinates stay.
  geometry::Vec2 wrap(geometry::Vec2 p) const {
    return {wrap(p.x, container_.min.x, period_x_), wrap(p.y, container_.min.y, period_y_)};
  }

  /// Returns whether p lies in the container or in one of its periodic images.
  bool in_container(geometry::Vec2 p) const {
    return (period_x_ > 0 || (p.x >= container_.min.x && p.x <= container_.max.x)) &&
           (period_y_ > 0 || (p.y >= container_.min.y && p.y <= container_.max.y));
  }

  const geometry::Box& container() const { return container_; }

private:
  static double wrap(double v, double from, double period) {
    return period > 0 ? v - period * std::floor((v - from) / period) : v;
  }
  static bool overlaps(double low, double high, double from, double to, double period) {
    return !(period > 0) || (high >= from - 0.5 * period && low <= to + 0.5 * period);
  }

  geometry::Box container_;
  double period_x_, period_y_;
};

/// Finds the nearest point of a boundary by a tree of boxes around runs of consecutive pieces. Immutable; queries are
/// thread-safe.
class PieceLocator {
public:
  /// Builds the tree in O(M) time for M pieces.
  PieceLocator(const geometry::Boundary& boundary, const Images& images);
  /// [1] Relative error by which the distance of the returned point may exceed the smallest distance. All segments of a
  /// circle are almost equally near to its centre, and examining each one would take too long.
  static constexpr double slack = 5e-4;
  /// A boundary point, and the segment on which it lies; on an arc, all three points are the boundary point.
  struct Nearest {
    geometry::Vec2 point, segment_start, segment_end;
  };
  /// Returns the boundary point nearest to p, if its distance is less than `reach`. Cost: O(log M) for curves.
  std::optional<Nearest> nearest(geometry::Vec2 p, double reach) const;

private:
  /// A circular piece or one of its periodic images.
  struct Arc {
    geometry::Piece piece;
    geometry::Vec2 shift;
    geometry::Box box;
  };
  std::vector<cones::SegmentLeaf> segments_;
  cones::BoxHierarchy segment_tree_;
  std::vector<Arc> arcs_;
  cones::BoxHierarchy arc_tree_;
  cones::SearchKernel kernel_;
};

} // namespace trime::sizing
