// SPDX-License-Identifier: BSD-3-Clause
// A size given by a formula of x, y and distances to parts of the boundary.
#pragma once

#include "core/distance_formula.hpp"
#include "trime/sizing/size_field.hpp"

namespace trime::sizing {

/// The size of a DistanceFormula. It has the rules of ExpressionSize.
class DistanceSize final : public SizeField {
public:
  /// @pre `formula` outlives this object
  /// @param box the bounding box of the shape
  /// @throws ConfigError that names the place and the value if the formula is not positive and finite on the grid
  DistanceSize(const DistanceFormula& formula, const geometry::Box& box);
  double size(geometry::Vec2 p) const override;

private:
  const DistanceFormula& formula_;
  geometry::Box box_;
  double smallest_;
};

} // namespace trime::sizing
