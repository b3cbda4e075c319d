// SPDX-License-Identifier: BSD-3-Clause
#include "trime/sizing/size_field.hpp"

#include "trime/core/error.hpp"

#include <algorithm>
#include <cmath>

namespace trime::sizing {

void fail_for_size(geometry::Vec2 p, double size) {
  throw GeometryError(fmt::format("the size field at {}: expected a positive finite size, found {}; the field "
                                  "must be positive in the whole shape",
                                  Place(p, 0), size));
}

ExpressionSize::ExpressionSize(const Formula& formula, const geometry::Box& box) : formula_(formula), box_(box) {
  double largest = 0;
  for (int j = 0; j < check_points; ++j)
    for (int i = 0; i < check_points; ++i) {
      const double x = box.min.x + box.width() * i / (check_points - 1);
      const double y = box.min.y + box.height() * j / (check_points - 1);
      const double value = formula.evaluate(x, y);
      if (!std::isfinite(value) || value <= 0)
        throw ConfigError(
            fmt::format("{}: expected a positive size everywhere in the bounding box of the shape, found {:.6g} at "
                        "{} for '{}'; if the size is wrong outside the shape only, write "
                        "max(FORMULA, SMALLEST SIZE)",
                        formula.where(), std::isnan(value) ? std::fabs(value) : value, Place(geometry::Vec2{x, y}, 6),
                        formula.text()));
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
