// SPDX-License-Identifier: BSD-3-Clause
// The even-odd rule: a point lies inside of rings if a ray from it crosses an odd number of their edges.
#pragma once

#include "geometry/predicates.hpp"
#include "trime/geometry/vec2.hpp"

#include <utility>

namespace trime::geometry {

/// Returns whether the ray from p in the direction of x crosses the edge from a to b. An edge contains its lower end
/// and not its upper one. Exact.
inline bool crosses_ray(Vec2 a, Vec2 b, Vec2 p) {
  if ((a.y > p.y) == (b.y > p.y))
    return false;
  if (a.y > b.y)
    std::swap(a, b);
  return orient2d(a, b, p) > 0;
}

} // namespace trime::geometry
