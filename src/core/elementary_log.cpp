// SPDX-License-Identifier: BSD-3-Clause
// Logarithms, the inverse hyperbolic functions, and pow: log(c) from a table, log(x c) by Taylor's series.
#include "core/elementary.hpp"
#include "core/elementary_parts.hpp"

#include <cmath>

namespace trime::elementary {
namespace {

/// A simple c near to 1/z, and -log(c).
struct Entry {
  double c = 1, head = 0, tail = 0;
};

// z lies in [0.6875, 1.375), which has 128 intervals of equal length in the bits of z: 80 below 1 and 48 above.
constexpr int intervals = 128, below_one = 80;

// Heads, and the head of log(2), are multiples of 2^-42: sums of them and 11-bit multiples are exact.
constexpr double coarse = 0x1.8p+10;
constexpr double ln2_head = (ln2_doubled.hi + coarse) - coarse;
constexpr double ln2_tail = (ln2_doubled.hi - ln2_head) + ln2_doubled.lo;

/// log(c) for 0.5 < c < 2: the series of the inverse hyperbolic tangent.
constexpr DoubleDouble log_slowly(double c) {
  const DoubleDouble s = DoubleDouble{c - 1, 0} / DoubleDouble{c + 1, 0}, q = s * s;
  DoubleDouble sum{};
  for (int n = 51; n >= 1; n -= 2)
    sum = sum * q + DoubleDouble{1, 0} / DoubleDouble{static_cast<double>(n), 0};
  return sum * s * 2.0;
}

constexpr std::array<Entry, intervals> entries = [] {
  std::array<Entry, intervals> list{};
  for (int i = 0; i < intervals; ++i) {
    if (i == below_one - 1 || i == below_one) // near 1: c = 1, so that nothing cancels
      continue;
    const double middle = i < below_one ? 1 + (i + 0.5 - below_one) / 256 : 1 + (i + 0.5 - below_one) / 128;
    const double c = static_cast<double>(static_cast<int>(512 / middle + 0.5)) / 512;
    const DoubleDouble minus_log = -log_slowly(c);
    const double head = (minus_log.hi + coarse) - coarse;
    list[static_cast<std::size_t>(i)] = {c, head, (minus_log.hi - head) + minus_log.lo};
  }
  return list;
}();

// (log(1 + r) - r + r^2/2) / r^3, for |r| < 2^-7.
constexpr std::array<double, 8> log_series{1.0 / 3, -1.0 / 4, 1.0 / 5, -1.0 / 6, 1.0 / 7, -1.0 / 8, 1.0 / 9, -1.0 / 10};

constexpr DoubleDouble one{1, 0};
constexpr DoubleDouble per_ln2 = one / ln2_doubled;
constexpr DoubleDouble per_ln10 = one / (log_slowly(1.25) + ln2_doubled * 3.0);

constexpr double small = 0x1p-28, large = 0x1p+30; // see asinh
constexpr double series_end = 0.125;

/// (asinh(x) - x) / x^3 as a series in x^2.
constexpr std::array<double, 10> asinh_series = [] {
  std::array<double, 10> list{};
  double binomial = 1;
  for (int n = 1; n <= 10; ++n) {
    binomial *= -(2.0 * n - 1) / (2.0 * n);
    list[static_cast<std::size_t>(n - 1)] = binomial / (2.0 * n + 1);
  }
  return list;
}();

/// (atanh(x) - x) / x^3 as a series in x^2.
constexpr std::array<double, 10> atanh_series = [] {
  std::array<double, 10> list{};
  for (int n = 1; n <= 10; ++n)
    list[static_cast<std::size_t>(n - 1)] = 1 / (2.0 * n + 1);
  return list;
}();

/// log(z) for normal z > 0
DoubleDouble log_of(DoubleDouble z) {
  const DoubleDouble l = log_parts(z.hi);
  return fast_two_sum(l.hi, l.lo + z.lo / z.hi);
}

/// Does the logarithm of x need no computation? If so, sets its value.
bool special_log(double x, double& value) {
  if (x > 0 && x < infinity)
    return false;
  value = x == 0 ? -infinity : x > 0 ? x : not_a_number;
  return true;
}

} // namespace

DoubleDouble root(DoubleDouble a) {
  const double s = std::sqrt(a.hi);
  const DoubleDouble p = two_product(s, s);
  return fast_two_sum(s, (((a.hi - p.hi) - p.lo) + a.lo) / (2 * s));
}

DoubleDouble log_parts(double x) {
  int shift = 0;
  if (x < 0x1p-1022) {
    x *= 0x1p+54;
    shift = -54;
  }
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const std::uint64_t above = bits - 0x3fe6000000000000u; // 0.6875
  const double k = static_cast<int>(static_cast<std::int64_t>(above) >> 52) + shift;
  const std::uint64_t z_bits = bits - (above & 0xfff0000000000000u);
  const Entry& entry = entries[(above >> 45) & (intervals - 1)];
  // z c - 1 exactly: c has 10 bits, the head of z 32 and its tail 21.
  const double z_head = std::bit_cast<double>(z_bits & ~std::uint64_t{0x1fffff}),
               z_tail = std::bit_cast<double>(z_bits) - z_head;
  const DoubleDouble r = fast_two_sum(z_head * entry.c - 1, z_tail * entry.c);
  const DoubleDouble square = two_product(r.hi, r.hi);
  const DoubleDouble s = two_sum(k * ln2_head + entry.head, r.hi), t = two_sum(s.hi, -0.5 * square.hi);
  const double tails = (k * ln2_tail + entry.tail) + (r.lo - r.hi * r.lo) + (s.lo + t.lo - 0.5 * square.lo);
  return fast_two_sum(t.hi, tails + r.hi * square.hi * polynomial(log_series, r.hi));
}

double log(double x) {
  double value = 0;
  return special_log(x, value) ? value : log_parts(x).hi;
}

double log2(double x) {
  double value = 0;
  return special_log(x, value) ? value : (log_parts(x) * per_ln2).hi;
}

double log10(double x) {
  double value = 0;
  return special_log(x, value) ? value : (log_parts(x) * per_ln10).hi;
}

double asinh(double x) {
  const double a = std::fabs(x), q = a * a;
  if (!(a >= small && a < infinity)) // with NaN
    return x;
  if (a < series_end)
    return x + x * (q * polynomial(asinh_series, q));
  const DoubleDouble value =
      a < large ? log_of(DoubleDouble{a, 0} + root(two_product(a, a) + one)) : log_parts(a) + ln2_doubled;
  return std::copysign(value.hi, x);
}

double acosh(double x) {
  if (!(x > 1 && x < infinity)) // with NaN
    return x == 1 ? 0 : x > 1 ? x : not_a_number;
  if (x >= large)
    return (log_parts(x) + ln2_doubled).hi;
  return log_of(DoubleDouble{x, 0} + root(two_product(x, x) - one)).hi;
}

double atanh(double x) {
  const double a = std::fabs(x), q = a * a;
  if (!(a >= small)) // with NaN
    return x;
  if (a < series_end)
    return x + x * (q * polynomial(atanh_series, q));
  if (a >= 1)
    return a == 1 ? std::copysign(infinity, x) : not_a_number;
  return std::copysign(0.5 * log_of(two_sum(1, a) / two_sum(1, -a)).hi, x);
}

} // namespace trime::elementary
