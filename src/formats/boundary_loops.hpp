// SPDX-License-Identifier: BSD-3-Clause
// Boundary edges of a mesh put one after the other into closed loops. Serial.
#pragma once

#include "trime/core/types.hpp"
#include "trime/geometry/vec2.hpp"

#include <vector>

namespace trime::formats {

/// Boundary edge, interior on the left.
struct LoopEdge {
  GlobalId first = 0, second = 0;
  std::int64_t tag = 0;
  geometry::Vec2 place; ///< of the first point
};

struct LoopVertex {
  GlobalId id = 0;
  geometry::Vec2 place;
};

/// The point among the periodic images of `p` that is nearest to `near`; period 0: there are no images.
geometry::Vec2 nearest_image(geometry::Vec2 p, geometry::Vec2 near, geometry::Vec2 period);

/// @brief All loops, by tag, then by lowest vertex; each starts at its lowest vertex, which is not repeated, and runs
/// counter-clockwise (holes too). A loop that winds round a periodic container has no such sense: it keeps the interior
/// on its left. Every edge comes in exactly one loop; an edge without successor ends its loop. O(edges log edges).
std::vector<std::vector<LoopVertex>> boundary_loops(std::vector<LoopEdge> edges, geometry::Vec2 period);

} // namespace trime::formats
