// SPDX-License-Identifier: BSD-3-Clause
// A size field from a formula of the user.
#pragma once

#include "trime/core/formula.hpp"
#include "trime/sizing/size_field.hpp"

namespace trime::sizing {

/// @brief Relative size at (x, y) as a formula says. Only its ratios count: the mesher scales it as a whole.
class ExpressionSize final : public SizeField {
public:
  /// Positive sizes below this share of the largest one seen on the grid are raised to it.
  static constexpr double smallest_share = 1e-6;
  /// Points of the checking grid along each axis.
  static constexpr int check_points = 65;

  /// @brief Evaluates the formula on a grid over `box`. About 65^2 evaluations.
  /// @pre `formula` outlives this object
  /// @param box the shape's bounding box
  /// @throws ConfigError that names the place and the value if the formula is not positive and finite on the grid
  ExpressionSize(const Formula& formula, const geometry::Box& box);

  /// @brief The value of the formula, or the smallest share if that is larger; outside the box, at the nearest point of
  /// it. Between the points of the grid the formula may fail: a value that is not positive and finite comes through,
  /// for the mesher to name.
  double size(geometry::Vec2 p) const override;

private:
  const Formula& formula_;
  geometry::Box box_;
  double smallest_ = 0;
};

} // namespace trime::sizing
