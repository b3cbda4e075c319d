// SPDX-License-Identifier: BSD-3-Clause
// A size field that a formula of the user defines.
#pragma once

#include "trime/core/formula.hpp"
#include "trime/sizing/size_field.hpp"

namespace trime::sizing {

/// @brief A relative size as a formula of x and y. Only ratios count, because the mesher scales the size by one factor.
class ExpressionSize final : public SizeField {
public:
  /// Positive sizes below this share of the largest one seen on the grid are raised to it.
  static constexpr double smallest_share = 1e-6;
  /// Number of points of the checking grid along each axis.
  static constexpr int check_points = 65;

  /// @brief Evaluates the formula on a grid over `box`, about 65^2 times.
  /// @pre `formula` outlives this object
  /// @param box the shape's bounding box
  /// @throws ConfigError that names the place and the value if the formula is not positive and finite on the grid
  ExpressionSize(const Formula& formula, const geometry::Box& box);
  ExpressionSize(const Formula&&, const geometry::Box&) = delete;

  /// @brief Returns the value of the formula, or the smallest share if that is larger. Outside the box it uses the
  /// nearest point of the box. Between the points of the grid the formula may fail: then the invalid value is returned,
  /// and the mesher reports it.
  double size(geometry::Vec2 p) const override;

private:
  const Formula& formula_;
  geometry::Box box_;
  double smallest_ = 0;
};

} // namespace trime::sizing
