// SPDX-License-Identifier: BSD-3-Clause
// Checks the values of a formula that gives a size.
#pragma once

#include "trime/core/error.hpp"
#include "trime/sizing/size_field.hpp"

#include <cmath>

namespace trime::sizing {

/// @brief Evaluates a Formula or DistanceFormula on the checking grid of ExpressionSize, and returns its largest value.
/// @throws ConfigError that names the place and the value if a value is not positive and finite
template <class AnyFormula>
double largest_value(const AnyFormula& formula, const geometry::Box& box) {
  constexpr int points = ExpressionSize::check_points;
  double largest = 0;
  for (int j = 0; j < points; ++j)
    for (int i = 0; i < points; ++i) {
      const double x = box.min.x + box.width() * i / (points - 1);
      const double y = box.min.y + box.height() * j / (points - 1);
      const double value = formula.evaluate(x, y);
      const Place place(geometry::Vec2{x, y}, 6);
      if (std::isnan(value))
        throw ConfigError(fmt::format(
            "{}: expected a positive size everywhere in the bounding box of the shape, but '{}' is not a number at {}; "
            "bound the argument of the root, logarithm, power or quotient, such as sqrt(max(depth, 1)). "
            "max(FORMULA, SIZE) does not help there",
            formula.where(), formula.text(), place));
      if (!std::isfinite(value) || value <= 0)
        throw ConfigError(
            fmt::format("{}: expected a positive size everywhere in the bounding box of the shape, found {:.6g} at "
                        "{} for '{}'; if the size is wrong outside the shape only, write "
                        "max(FORMULA, SMALLEST SIZE)",
                        formula.where(), value, place, formula.text()));
      largest = std::fmax(largest, value);
    }
  return largest;
}

} // namespace trime::sizing
