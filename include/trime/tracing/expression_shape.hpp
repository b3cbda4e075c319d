// SPDX-License-Identifier: BSD-3-Clause
// A shape from a formula of the user.
#pragma once

#include "trime/core/formula.hpp"
#include "trime/tracing/shape.hpp"

namespace trime::tracing {

/// The shape where a formula of x and y is negative.
class ExpressionShape final : public Shape {
public:
  /// @pre `formula` outlives this object
  explicit ExpressionShape(const Formula& formula) : formula_(formula) {}
  explicit ExpressionShape(const Formula&&) = delete;
  double signed_distance(geometry::Vec2 p) const override { return formula_.evaluate(p.x, p.y); }

private:
  const Formula& formula_;
};

} // namespace trime::tracing
