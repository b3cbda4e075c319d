// SPDX-License-Identifier: BSD-3-Clause
#include "trime/sizing/size_field.hpp"

#include "sizing/formula_values.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <cmath>

namespace trime::sizing {

void fail_for_size(geometry::Vec2 p, double size) {
  throw GeometryError(fmt::format("the size field at {}: expected a positive finite size, found {}; the field "
                                  "must be positive in the whole shape",
                                  Place(p, 0), size));
}

void SizeField::sizes(std::span<const geometry::Vec2> places, std::span<double> values) const {
  for (std::size_t k = 0; k < values.size(); ++k)
    values[k] = size(places[k]);
}

void ScaledSize::sizes(std::span<const geometry::Vec2> places, std::span<double> values) const {
  field_.sizes(places, values);
  for (double& value : values)
    if (is_valid_size(value))
      value = scaled(value);
}

ExpressionSize::ExpressionSize(const Formula& formula, const geometry::Box& box) : formula_(formula), box_(box) {
  smallest_ = smallest_share * largest_value(formula, box);
}

double ExpressionSize::size(geometry::Vec2 p) const {
  const double value =
      formula_.evaluate(std::clamp(p.x, box_.min.x, box_.max.x), std::clamp(p.y, box_.min.y, box_.max.y));
  return value > 0 && value < smallest_ ? smallest_ : value;
}

} // namespace trime::sizing
