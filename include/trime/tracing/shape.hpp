// SPDX-License-Identifier: BSD-3-Clause
// The seam for shapes of a user's own: a function that is negative inside.
#pragma once

#include "trime/geometry/vec2.hpp"

namespace trime::tracing {

/// @brief A shape given by a function: derive from it to mesh a shape of one's own, see traced() and traced_part().
/// Called concurrently, and must give the same bits on every rank.
class Shape {
public:
  virtual ~Shape() = default;
  /// @brief Negative inside, positive outside, finite in the whole container. Only the zero set becomes the shape; near
  /// it the function should be Lipschitz with about the same constant everywhere, best of all the distance itself.
  virtual double signed_distance(geometry::Vec2 p) const = 0;
};

} // namespace trime::tracing
