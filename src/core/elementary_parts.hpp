// SPDX-License-Identifier: BSD-3-Clause
// Tools that the sources of the elementary functions share: numbers of twice the precision of double, stored as sums of
// two doubles, and exp and log with more bits than a double has.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <limits>

namespace trime {

/// The number hi + lo, where hi is this number rounded to nearest. Such a number has about 106 bits.
struct DoubleDouble {
  double hi = 0, lo = 0;
};

/// @brief Returns a + b exactly. (Dekker 1971) @pre a is 0, or |a| >= |b|
constexpr DoubleDouble fast_two_sum(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

/// @brief Returns a + b exactly. (Knuth 1969)
constexpr DoubleDouble two_sum(double a, double b) {
  const double sum = a + b, part = sum - a;
  return {sum, (a - (sum - part)) + (b - part)};
}

/// @brief Splits a into the sum of two doubles of at most 26 bits. (Veltkamp 1968) @pre |a| < 2^996
constexpr DoubleDouble halves(double a) {
  const double wide = a * 0x1.0000002p+27, high = wide - (wide - a);
  return {high, a - high};
}

/// @brief Returns a b exactly, if no partial product overflows or underflows (Dekker 1971). No fused multiply-add is
/// used, because some processors lack it and emulating it is slow.
constexpr DoubleDouble two_product(double a, double b) {
  const double product = a * b;
  const DoubleDouble s = halves(a), t = halves(b);
  return {product, ((s.hi * t.hi - product) + s.hi * t.lo + s.lo * t.hi) + s.lo * t.lo};
}

constexpr DoubleDouble operator-(DoubleDouble a) {
  return {-a.hi, -a.lo};
}

constexpr DoubleDouble operator+(DoubleDouble a, DoubleDouble b) {
  const DoubleDouble s = two_sum(a.hi, b.hi), t = two_sum(a.lo, b.lo);
  const DoubleDouble u = fast_two_sum(s.hi, s.lo + t.hi);
  return fast_two_sum(u.hi, u.lo + t.lo);
}

constexpr DoubleDouble operator-(DoubleDouble a, DoubleDouble b) {
  return a + -b;
}

constexpr DoubleDouble operator*(DoubleDouble a, DoubleDouble b) {
  const DoubleDouble p = two_product(a.hi, b.hi);
  return fast_two_sum(p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi));
}

constexpr DoubleDouble operator*(DoubleDouble a, double b) {
  const DoubleDouble p = two_product(a.hi, b);
  return fast_two_sum(p.hi, p.lo + a.lo * b);
}

/// @brief Divides in double precision and improves the quotient by one step of long division; the relative error is
/// about 2^-102.
constexpr DoubleDouble operator/(DoubleDouble a, DoubleDouble b) {
  const double q = a.hi / b.hi;
  const DoubleDouble p = two_product(q, b.hi);
  return fast_two_sum(q, (((a.hi - p.hi) - p.lo) + (a.lo - q * b.lo)) / b.hi);
}

/// pi, and the natural logarithm of 2.
inline constexpr DoubleDouble pi_doubled{0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53};
inline constexpr DoubleDouble ln2_doubled{0x1.62e42fefa39efp-1, 0x1.abc9e3b39803fp-56};

} // namespace trime

namespace trime::elementary {

inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// The number (value.hi + value.lo) 2^exponent.
struct Scaled {
  DoubleDouble value;
  int exponent = 0;
};

/// @brief Returns 2^n. @pre -1022 <= n <= 1023
constexpr double power_of_two(int n) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(n + 1023) << 52);
}

/// @brief Returns the nearest integer; halves are rounded to even.
/// @pre |x| < 2^51
inline double nearest(double x) {
  constexpr double shift = 0x1.8p+52;
  return (x + shift) - shift;
}

/// @brief Returns coefficient[0] + q (coefficient[1] + q (...)).
template <std::size_t count>
constexpr double polynomial(const std::array<double, count>& coefficient, double q) {
  double sum = coefficient[count - 1];
  for (std::size_t k = count - 1; k-- > 0;)
    sum = coefficient[k] + q * sum;
  return sum;
}

/// @brief Returns s as a double, rounded only once even if the result is denormal.
/// @pre 0.5 <= s.value < 4
double rounded(const Scaled& s);

/// @brief Returns exp(a) with a relative error of about 2^-60 and a `value` in [0.99, 2.01]. @pre |a| < 1200
Scaled exp_parts(DoubleDouble a);

/// @brief Returns log(x) with a relative error of about 2^-67. @pre x is finite, x > 0
DoubleDouble log_parts(double x);

/// @brief Returns the square root of a with a relative error of about 2^-100. @pre a is normal and positive
DoubleDouble root(DoubleDouble a);

} // namespace trime::elementary
