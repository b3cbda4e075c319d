// SPDX-License-Identifier: BSD-3-Clause
#include "core/angle.hpp"

#include <array>
#include <cmath>

namespace trime {

namespace {

// pi/2 in three parts; the first two have 33 bits, so that their products with a small integer are exact
// (reduction of Cody and Waite, 1980).
constexpr double half_pi_1 = 0x1.921fb544p+0, half_pi_2 = 0x1.0b4611a6p-34, half_pi_3 = 0x1.3198a2e037073p-69;

// Rounding errors of pi and pi/2 as doubles.
constexpr double pi_tail = 0x1.1a62633145c07p-53, half_pi_tail = 0x1.1a62633145c07p-54;

constexpr double factorial(int n) {
  return n < 2 ? 1.0 : n * factorial(n - 1);
}

/// 1/n! for n = 0 .. 18: not every compiler treats a factorial in the loop as a constant, and it took ten times as
/// long.
constexpr std::array<double, 19> inverse_factorial = [] {
  std::array<double, 19> list{};
  for (std::size_t n = 0; n < list.size(); ++n)
    list[n] = 1.0 / factorial(static_cast<int>(n));
  return list;
}();

/// Taylor series of sin and cos on [-pi/4, pi/4]: the first term left out is below 1e-19.
SinCos sin_cos_reduced(double r) {
  const double q = r * r;
  double s = 0, c = 0;
  for (std::size_t n = 17; n >= 3; n -= 2)
    s = inverse_factorial[n] - q * s;
  for (std::size_t n = 18; n >= 4; n -= 2)
    c = inverse_factorial[n] - q * c;
  // The loops end on the terms r^3 and r^4. Their sign alternates relative to the leading ones.
  return {r - r * q * s, 1.0 - q * (0.5 - q * c)};
}

// atan(i/8), rounded to nearest.
constexpr std::array<double, 9> atan_eighths = {
    0,
    0x1.fd5ba9aac2f6ep-4,
    0x1.f5b75f92c80ddp-3,
    0x1.6f61941e4def1p-2,
    0x1.dac670561bb4fp-2,
    0x1.1e00babdefeb4p-1,
    0x1.4978fa3269ee1p-1,
    0x1.700a7c5784634p-1,
    0x1.921fb54442d18p-1,
};

/// atan(small/large) for 0 <= small <= large, large > 0.
double atan_first_octant(double small, double large) {
  const int i = static_cast<int>(std::nearbyint(small / large * 8.0));
  // tan(a - b): the rest is at most 1/16, where six terms of the series suffice (the next is below 1e-18).
  const double tangent = i / 8.0;
  const double u = (small - tangent * large) / (large + tangent * small);
  const double q = u * u;
  const double series = q * (1.0 / 3 - q * (1.0 / 5 - q * (1.0 / 7 - q * (1.0 / 9 - q * (1.0 / 11 - q * (1.0 / 13))))));
  return atan_eighths[i] + (u - u * series);
}

} // namespace

SinCos sin_cos(double radians) {
  const double turns = std::nearbyint(radians * (2.0 / pi));
  const double reduced = ((radians - turns * half_pi_1) - turns * half_pi_2) - turns * half_pi_3;
  const SinCos r = sin_cos_reduced(reduced);
  switch (static_cast<int>(turns) & 3) {
  case 0:
    return r;
  case 1:
    return {r.cos, -r.sin};
  case 2:
    return {-r.sin, -r.cos};
  default:
    return {-r.cos, r.sin};
  }
}

double angle_of(double y, double x) {
  const double ax = std::fabs(x), ay = std::fabs(y);
  if (ax == 0 && ay == 0)
    return 0;
  double angle = ay <= ax ? atan_first_octant(ay, ax) : (pi / 2 - atan_first_octant(ax, ay)) + half_pi_tail;
  if (x < 0)
    angle = (pi - angle) + pi_tail;
  return y < 0 ? -angle : angle;
}

} // namespace trime
