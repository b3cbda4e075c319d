// SPDX-License-Identifier: BSD-3-Clause
// Joins the boundary edges of a mesh to closed loops. Serial.
#pragma once

#include "trime/core/types.hpp"
#include "trime/geometry/vec2.hpp"

#include <vector>

namespace trime::formats {

/// A boundary edge with the interior on its left.
struct LoopEdge {
  GlobalId first = 0, second = 0;
  std::int64_t tag = 0;
  geometry::Vec2 place; ///< position of the point `first`
};

struct LoopVertex {
  GlobalId id = 0;
  geometry::Vec2 place;
};

/// Returns the periodic image of `p` that is nearest to `near`. A period of 0 means that the direction is not periodic.
geometry::Vec2 nearest_image(geometry::Vec2 p, geometry::Vec2 near, geometry::Vec2 period);

/// @brief Returns all loops, ordered by tag and then by lowest vertex. Each loop starts at its lowest vertex, which is
/// not repeated at the end, and runs counter-clockwise, even around holes. A loop that winds around a periodic
/// container has no such direction; it keeps the interior on its left. Every edge is in exactly one loop; an edge
/// without successor ends its loop. Cost: O(edges log edges).
std::vector<std::vector<LoopVertex>> boundary_loops(std::vector<LoopEdge> edges, geometry::Vec2 period);

} // namespace trime::formats
