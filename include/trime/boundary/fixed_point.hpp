// SPDX-License-Identifier: BSD-3-Clause
// A point that the user wants to find in the mesh.
#pragma once

#include "trime/geometry/vec2.hpp"

#include <string>

namespace trime::boundary {

/// A point that is to be a vertex of the mesh.
struct FixedPoint {
  geometry::Vec2 position;
  std::string label; ///< where the point comes from, for messages, such as `points.xy:7`
};

} // namespace trime::boundary
