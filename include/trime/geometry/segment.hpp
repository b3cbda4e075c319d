// SPDX-License-Identifier: BSD-3-Clause
// A straight segment, and the one formula for the distance to it.
#pragma once

#include "trime/geometry/vec2.hpp"

namespace trime::geometry {

/// A straight segment from a to b.
struct Segment {
  Vec2 a, b;
};

/// Returns the squared distance from p to the segment; a == b is allowed.
inline double squared_distance(Vec2 p, const Segment& segment) {
  const Vec2 d = segment.b - segment.a, q = p - segment.a;
  const double along = dot(q, d), whole = squared_length(d);
  if (along <= 0)
    return squared_length(q);
  if (along >= whole)
    return squared_length(p - segment.b);
  const double across = cross(d, q);
  return across * across / whole;
}

} // namespace trime::geometry
