// SPDX-License-Identifier: BSD-3-Clause
// The diametral disc of a segment is the smallest disc through its ends. If it contains no other site (Gabriel), the
// segment is an edge of the Delaunay triangulation.
#pragma once

#include "trime/geometry/vec2.hpp"

namespace trime::geometry {

/// @brief Returns -1 if p lies strictly inside the circle with diameter a-b, 0 on it, +1 outside: the sign of
/// (a-p).(b-p). Exact for points of one lattice, by the argument of orient2d.
inline int diametral_side(Vec2 a, Vec2 b, Vec2 p) {
  const double apx = a.x - p.x, apy = a.y - p.y, bpx = b.x - p.x, bpy = b.y - p.y;
  const double left = apx * bpx, right = -(apy * bpy);
  if (left > right)
    return 1;
  if (left < right)
    return -1;
  const double left_error = std::fma(apx, bpx, -left), right_error = std::fma(-apy, bpy, -right);
  return (left_error > right_error) - (left_error < right_error);
}

} // namespace trime::geometry
