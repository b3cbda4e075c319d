// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/distance_size.hpp"

#include "sizing/formula_values.hpp"

#include <algorithm>

namespace trime::sizing {

DistanceSize::DistanceSize(const DistanceFormula& formula, const geometry::Box& box)
    : formula_(formula), box_(box), smallest_(ExpressionSize::smallest_share * largest_value(formula, box)) {}

double DistanceSize::size(geometry::Vec2 p) const {
  const double value =
      formula_.evaluate(std::clamp(p.x, box_.min.x, box_.max.x), std::clamp(p.y, box_.min.y, box_.max.y));
  return value > 0 && value < smallest_ ? smallest_ : value;
}

} // namespace trime::sizing
