// SPDX-License-Identifier: BSD-3-Clause
#include "tracing/level_function.hpp"

#include <algorithm>

namespace trime::tracing {
using geometry::length;
using geometry::Vec2;

void LevelFunction::build_wall(double slope, double lowest, double width) {
  slope_ = slope;
  steep_from_ = 0.5 * width;
  steep_slope_ = 4 * (std::fabs(lowest) / width + slope);
}

/// Searches by false position. To converge quickly, it halves the weight of an end that stays, and sometimes makes a
/// bisection. Each try is at least half a tolerance away from the ends, so that the bracket closes once one end is
/// near.
Vec2 LevelFunction::crossing(Vec2 a, double value_a, Vec2 b, double value_b, double tolerance) const {
  constexpr int most_tries = 120;
  const double whole = length(b - a), small = std::max(0x1p-51, tolerance / whole);
  double low = 0, high = 1, low_value = value_a, high_value = value_b;
  int stayed = 0; // which end stayed in the last try: -1 the upper, 1 the lower
  for (int k = 0; k < most_tries && high - low > small; ++k) {
    const double linear = low + (high - low) * (low_value / (low_value - high_value));
    const double wanted = k % 4 == 3 ? 0.5 * (low + high) : linear;
    const double t = std::clamp(wanted, low + 0.4 * small, high - 0.4 * small);
    const double value = (*this)(a + t * (b - a));
    if ((value < 0) == (value_a < 0)) {
      low = t;
      low_value = value;
      high_value *= stayed == -1 ? 0.5 : 1;
      stayed = -1;
    } else {
      high = t;
      high_value = value;
      low_value *= stayed == 1 ? 0.5 : 1;
      stayed = 1;
    }
  }
  return a + (0.5 * (low + high)) * (b - a);
}

void LevelFunction::report(const NotFinite& found) const {
  throw GeometryError(fmt::format("part '{}': expected a finite value everywhere in the container, found {} at "
                                  "({:.12g}, {:.12g})",
                                  name_, std::isnan(found.value) ? std::string("NaN") : fmt::format("{}", found.value),
                                  found.place.x, found.place.y));
}

} // namespace trime::tracing
