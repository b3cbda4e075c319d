// SPDX-License-Identifier: BSD-3-Clause
// Finds on which side of a line a point lies after it is moved by (epsilon^2, epsilon), so that it is never on the
// line. Exact for points of one lattice.
#pragma once

#include "geometry/predicates.hpp"
#include "trime/geometry/segment.hpp"
#include "trime/geometry/vec2.hpp"

namespace trime::geometry {

/// Returns the side of a line of direction d to which the move leads; 0 only if d is zero.
inline int side_of_move(Vec2 d) {
  return d.x != 0 ? (d.x > 0 ? 1 : -1) : (d.y < 0) - (d.y > 0);
}

/// Returns the side of the line a-b on which the moved point q lies; 0 only if a == b.
inline int perturbed_side(const Segment& s, Vec2 q) {
  const int sign = orient2d(s.a, s.b, q);
  return sign != 0 ? sign : side_of_move(s.b - s.a);
}

/// Returns whether the segment crosses the way from p to q, where both are moved. By the even-odd rule, each segment of
/// closed polygons that crosses a way changes the side.
inline bool crosses_way(const Segment& s, Vec2 p, Vec2 q) {
  if (p == q || perturbed_side(s, p) == perturbed_side(s, q))
    return false;
  const auto side = [&](Vec2 end) { // side of the moved way; the end is moved back instead of the way
    const int sign = orient2d(p, q, end);
    return sign != 0 ? sign : -side_of_move(q - p);
  };
  return side(s.a) != side(s.b);
}

} // namespace trime::geometry
