// SPDX-License-Identifier: BSD-3-Clause
#include "trime/sizing/expression_size.hpp"

#include "trime/core/error.hpp"

#include <algorithm>
#include <cmath>

namespace trime::sizing {

ExpressionSize::ExpressionSize(const Formula& formula, const geometry::Box& box) : formula_(formula), box_(box) {
  double largest = 0;
  for (int j = 0; j < check_points; ++j)
    for (int i = 0; i < check_points; ++i) {
      const double x = box.min.x + box.width() * i / (check_points - 1);
      const double y = box.min.y + box.height() * j / (check_points - 1);
      const double value = formula.evaluate(x, y);
      if (!std::isfinite(value) || value <= 0)
        throw ConfigError(
            fmt::format("{}: expected a positive size everywhere in the shape's bounding box, found {} at "
                        "{} for '{}'; wrap it in max(..., smallest size) if that place is outside",
                        formula.where(), value, Place(geometry::Vec2{x, y}, 0), formula.text()));
      largest = std::fmax(largest, value);
    }
  smallest_ = smallest_share * largest;
}

double ExpressionSize::size(geometry::Vec2 p) const {
  const double value =
      formula_.evaluate(std::clamp(p.x, box_.min.x, box_.max.x), std::clamp(p.y, box_.min.y, box_.max.y));
  return value > 0 && value < smallest_ ? smallest_ : value;
}

} // namespace trime::sizing
