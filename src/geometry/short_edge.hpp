// SPDX-License-Identifier: BSD-3-Clause
// An edge that is shorter than the user allows.
#pragma once

#include "trime/geometry/vec2.hpp"

namespace trime::geometry {

/// An edge of the mesh, or the line between two sites on the boundary.
struct ShortEdge {
  Vec2 middle; ///< position in the container
  double length;
};

} // namespace trime::geometry
