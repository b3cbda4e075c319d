// SPDX-License-Identifier: BSD-3-Clause
// Inverse trigonometric functions: all of them are the angle of a vector.
#include "core/elementary.hpp"
#include "core/elementary_parts.hpp"

#include <algorithm>
#include <cmath>

namespace trime::elementary {
namespace {

constexpr int steps = 64; // of the table, from tangent 0 to 1

/// atan(i/64), from the differences of neighbours: tan(a - b) = (tan a - tan b) / (1 + tan a tan b).
constexpr std::array<DoubleDouble, steps + 1> arcs = [] {
  std::array<DoubleDouble, steps + 1> list{};
  for (int i = 0; i < steps; ++i) {
    const DoubleDouble t = DoubleDouble{steps, 0} / DoubleDouble{steps * steps + i * (i + 1.0), 0}, q = t * t;
    DoubleDouble sum{};
    for (int n = 21; n >= 1; n -= 2)
      sum = DoubleDouble{1, 0} / DoubleDouble{static_cast<double>(n), 0} - sum * q;
    list[static_cast<std::size_t>(i + 1)] = list[static_cast<std::size_t>(i)] + sum * t;
  }
  return list;
}();

constexpr DoubleDouble half_pi{pi_doubled.hi / 2, pi_doubled.lo / 2};

constexpr double small = 0x1p-28, large = 0x1p+60; // below and above, a tangent is its angle, or at a right angle

/// atan(y/x) for 0 <= y <= x, where y is 0 or at least 2^-400, and 2^-400 <= x <= 2^600.
DoubleDouble first_octant(DoubleDouble y, DoubleDouble x) {
  const double turns = nearest(y.hi / x.hi * steps), tangent = turns / steps;
  const DoubleDouble u = (y - x * tangent) / (x + y * tangent);
  const double q = u.hi * u.hi;
  const double series = q * (-1.0 / 3 + q * (1.0 / 5 + q * (-1.0 / 7 + q * (1.0 / 9))));
  const DoubleDouble arc = arcs[static_cast<std::size_t>(turns)], s = fast_two_sum(arc.hi, u.hi);
  return fast_two_sum(s.hi, s.lo + (arc.lo + (u.lo + u.hi * series)));
}

/// The angle of (x, y) in the first quadrant.
DoubleDouble first_quadrant(DoubleDouble y, DoubleDouble x) {
  return y.hi <= x.hi ? first_octant(y, x) : half_pi - first_octant(x, y);
}

/// sqrt(1 - x^2) for |x| < 1
DoubleDouble other_leg(double x) {
  return root(DoubleDouble{1, 0} - two_product(x, x));
}

} // namespace

double asin(double x) {
  const double a = std::fabs(x);
  if (a < small)
    return x;
  if (!(a < 1)) // with NaN
    return a == 1 ? std::copysign(half_pi.hi, x) : not_a_number;
  return std::copysign(first_quadrant({a, 0}, other_leg(a)).hi, x);
}

double acos(double x) {
  const double a = std::fabs(x);
  if (a < 0x1p-60)
    return half_pi.hi;
  if (!(a < 1)) // with NaN
    return x == 1 ? 0 : x == -1 ? pi_doubled.hi : not_a_number;
  const DoubleDouble angle = first_quadrant(other_leg(a), {a, 0});
  return x > 0 ? angle.hi : (pi_doubled - angle).hi;
}

double atan(double x) {
  const double a = std::fabs(x);
  if (!(a >= small)) // with NaN
    return x;
  return std::copysign(a > large ? half_pi.hi : first_quadrant({a, 0}, {1, 0}).hi, x);
}

double atan2(double y, double x) {
  if (x != x || y != y)
    return not_a_number;
  double a = std::fabs(x), b = std::fabs(y);
  if (a == infinity && b == infinity) { // C says: as if they were equal
    a = 1;
    b = 1;
  }
  const double longer = std::max(a, b), ratio = longer == 0 ? 0 : std::min(a, b) / longer;
  DoubleDouble angle;
  if (ratio < 1 / large) {
    if (b <= a && !std::signbit(x))
      return longer == 0 ? y : y / x;
    angle = b <= a ? DoubleDouble{} : half_pi;
  } else {
    const double scale = longer > 0x1p+500 ? 0x1p-600 : longer < 0x1p-300 ? 0x1p+600 : 1;
    angle = first_quadrant({b * scale, 0}, {a * scale, 0});
  }
  return std::copysign(std::signbit(x) ? (pi_doubled - angle).hi : angle.hi, y);
}

} // namespace trime::elementary
