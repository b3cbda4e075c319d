// SPDX-License-Identifier: BSD-3-Clause
// exp and the hyperbolic functions: 2^(k/128) from a table, the rest by Taylor's series.
#include "core/elementary.hpp"
#include "core/elementary_parts.hpp"

#include <algorithm>
#include <cmath>

namespace trime::elementary {
namespace {

constexpr int steps = 128; // of the table of powers, from 1 to 2

constexpr double inverse_factorial(int n) {
  double product = 1;
  for (int k = 2; k <= n; ++k)
    product *= k;
  return 1 / product;
}

/// 1/n! for n = first, first + stride, ...
template <std::size_t count>
constexpr std::array<double, count> inverse_factorials(int first, int stride) {
  std::array<double, count> list{};
  for (std::size_t k = 0; k < count; ++k)
    list[k] = inverse_factorial(first + stride * static_cast<int>(k));
  return list;
}

/// 2^(i/128)
constexpr std::array<DoubleDouble, steps> powers = [] {
  const DoubleDouble t = ln2_doubled * (1.0 / steps);
  DoubleDouble ratio{1, 0};
  for (int n = 16; n >= 1; --n) // Horner's scheme of exp(t)
    ratio = DoubleDouble{1, 0} + ratio * t / DoubleDouble{static_cast<double>(n), 0};
  std::array<DoubleDouble, steps> list{};
  list[0] = {1, 0};
  for (std::size_t i = 1; i < steps; ++i)
    list[i] = list[i - 1] * ratio;
  return list;
}();

// log(2)/128 in two parts; the first has 33 bits, so that its product with an integer of 20 bits is exact.
constexpr double part_1 = 0x1.62e42fefp-8, part_2 = (ln2_doubled.hi - 0x1.62e42fefp-1) / steps + ln2_doubled.lo / steps;

constexpr double small = 0x1p-28; // below, the second term of every odd series is less than half a unit
constexpr double series_end = 0.125;
constexpr double saturated = 22; // exp(-2 x) is below 2^-63

/// exp(x) as a sum, for 0 <= x < 25.
DoubleDouble exp_sum(double x) {
  const Scaled s = exp_parts({x, 0});
  const double scale = power_of_two(s.exponent);
  return {s.value.hi * scale, s.value.lo * scale};
}

// (sinh(x) - x) / x^3 and (cosh(x) - 1) / x^2 as series in x^2, for x <= series_end.
constexpr auto sinh_series = inverse_factorials<7>(3, 2);
constexpr auto cosh_series = inverse_factorials<8>(2, 2);

} // namespace

double rounded(const Scaled& s) {
  const double value = s.value.hi + s.value.lo;
  const int n = s.exponent;
  if (n >= -1021 && n <= 1022)
    return value * power_of_two(n);
  if (n > 1022)
    return value * 0x1p+1022 * power_of_two(std::min(n - 1022, 1000));
  if (n < -1080)
    return 0;
  if ((n == -1022 && value >= 1) || (n == -1023 && value >= 2))
    return value * 0x1p-1000 * power_of_two(n + 1000);
  // Added to this number, the last place of a double is that of the result.
  const double beside = power_of_two(-1022 - n), sum = beside + s.value.hi;
  const double rest = (s.value.hi - (sum - beside)) + s.value.lo;
  return ((sum + rest) - beside) * power_of_two(n + 200) * 0x1p-200;
}

Scaled exp_parts(DoubleDouble a) {
  constexpr double per_unit = steps / ln2_doubled.hi;
  const double turns = nearest(a.hi * per_unit);
  const double head = a.hi - turns * part_1, tail = a.lo - turns * part_2;
  const double r = head + tail, rest = (head - r) + tail;
  const double more = rest + r * r * (0.5 + r * (1.0 / 6 + r * (1.0 / 24 + r * (1.0 / 120))));
  const int k = static_cast<int>(turns);
  const DoubleDouble power = powers[static_cast<std::size_t>(k & (steps - 1))];
  return {fast_two_sum(power.hi, power.lo + power.hi * (r + more)), k >> 7};
}

double exp(double x) {
  if (!(std::fabs(x) < 708)) { // with NaN
    if (x > 710 || x < -746 || x != x)
      return x > 0 ? infinity : x < 0 ? 0.0 : x;
    return rounded(exp_parts({x, 0}));
  }
  const Scaled s = exp_parts({x, 0});
  return s.value.hi * power_of_two(s.exponent);
}

double sinh(double x) {
  const double a = std::fabs(x), q = a * a;
  if (!(a >= small)) // with NaN
    return x;
  if (a < series_end)
    return x + x * (q * polynomial(sinh_series, q));
  if (a > 711)
    return std::copysign(infinity, x);
  double value = 0;
  if (a < saturated) {
    const DoubleDouble e = exp_sum(a);
    value = 0.5 * (e - DoubleDouble{1, 0} / e).hi;
  } else {
    Scaled s = exp_parts({a, 0});
    --s.exponent;
    value = rounded(s);
  }
  return std::copysign(value, x);
}

double cosh(double x) {
  const double a = std::fabs(x);
  if (!(a <= 711)) // with NaN
    return a * infinity;
  if (a < saturated) {
    const DoubleDouble e = exp_sum(a);
    return 0.5 * (e + DoubleDouble{1, 0} / e).hi;
  }
  Scaled s = exp_parts({a, 0});
  --s.exponent;
  return rounded(s);
}

double tanh(double x) {
  const double a = std::fabs(x), q = a * a;
  if (!(a >= small)) // with NaN
    return x;
  if (a >= saturated)
    return std::copysign(1.0, x);
  DoubleDouble over, under;
  if (a < series_end) {
    over = fast_two_sum(a, a * (q * polynomial(sinh_series, q)));
    under = fast_two_sum(1, q * polynomial(cosh_series, q));
  } else {
    const DoubleDouble e = exp_sum(2 * a);
    over = e - DoubleDouble{1, 0};
    under = e + DoubleDouble{1, 0};
  }
  return std::copysign((over / under).hi, x);
}

} // namespace trime::elementary
