// SPDX-License-Identifier: BSD-3-Clause
// A shape that is given by a function, which is negative inside: a class derived from Shape, or a formula.
#pragma once

#include "trime/core/formula.hpp"
#include "trime/geometry/vec2.hpp"

namespace trime::tracing {

/// @brief A shape given by a function. Derive from this class to mesh your own shape, see traced() and traced_part().
/// Threads call the function concurrently; it must give the same bits on every rank.
class Shape {
public:
  virtual ~Shape() = default;
  /// @brief Returns a value that is negative inside, positive outside, and finite in the whole container. Only its zero
  /// set matters. Near the zero set the function should be Lipschitz with about the same constant everywhere; the
  /// signed distance is best.
  virtual double signed_distance(geometry::Vec2 p) const = 0;
};

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
