// SPDX-License-Identifier: BSD-3-Clause
// Numbers with twice the precision of double, stored as sums of two doubles. The elementary functions use them, and the
// compiler computes the tables of these functions with them.
#pragma once

namespace trime {

/// The number hi + lo, where hi is the sum rounded to nearest: about 106 bits.
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

/// @brief Returns a b exactly, if no part of it overflows or underflows. (Dekker 1971) It uses no fused multiply-add:
/// not every processor has one, and a function that replaces it is slow.
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

/// @brief Improves the quotient in double by one step of long division; the relative error is about 2^-102.
constexpr DoubleDouble operator/(DoubleDouble a, DoubleDouble b) {
  const double q = a.hi / b.hi;
  const DoubleDouble p = two_product(q, b.hi);
  return fast_two_sum(q, (((a.hi - p.hi) - p.lo) + (a.lo - q * b.lo)) / b.hi);
}

/// pi, and the natural logarithm of 2.
inline constexpr DoubleDouble pi_doubled{0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53};
inline constexpr DoubleDouble ln2_doubled{0x1.62e42fefa39efp-1, 0x1.abc9e3b39803fp-56};

} // namespace trime
