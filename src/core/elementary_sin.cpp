// SPDX-License-Identifier: BSD-3-Clause
// sin, cos and tan: multiples of pi/64 from a table, the rest by Taylor's series.
#include "core/elementary.hpp"
#include "core/elementary_parts.hpp"

#include <cmath>

namespace trime::elementary {
namespace {

constexpr int turn = 128, quarter = turn / 4; // multiples of pi/64

/// sin(k pi/64): the first ones by adding angles, the others by symmetry.
constexpr std::array<DoubleDouble, turn> sines = [] {
  const DoubleDouble t = pi_doubled * (1.0 / 64), q = t * t;
  DoubleDouble sine{1, 0}, cosine{1, 0};
  for (int n = 20; n >= 2; n -= 2) {
    sine = DoubleDouble{1, 0} - sine * q / DoubleDouble{n * (n + 1.0), 0};
    cosine = DoubleDouble{1, 0} - cosine * q / DoubleDouble{n * (n - 1.0), 0};
  }
  sine = sine * t;
  std::array<DoubleDouble, turn> list{};
  DoubleDouble s{0, 0}, c{1, 0};
  for (std::size_t k = 0; k <= quarter / 2; ++k) {
    list[k] = s;
    list[quarter - k] = c;
    const DoubleDouble next = s * cosine + c * sine;
    c = c * cosine - s * sine;
    s = next;
  }
  for (std::size_t k = 1; k <= quarter; ++k) {
    list[quarter + k] = list[quarter - k];
    list[(2 * quarter + k) % turn] = -list[k];
    list[(turn - k) % turn] = -list[k];
  }
  list[0] = {0, 0};
  return list;
}();

/// An angle: turns pi/64 + rest, where |rest| is at most a little more than pi/128.
struct Reduced {
  int turns = 0;
  DoubleDouble rest;
};

// pi/64 in four parts; the first three have 28 bits, so that their products with an integer of 25 bits are exact.
constexpr double part_1 = 0x1.921fb54000000p-5, part_2 = 0x1.10b4610000000p-35, part_3 = 0x1.a626330000000p-63,
                 part_4 = 0x1.45c06e0e68948p-91;
constexpr double per_radian = 64 / pi_doubled.hi;
constexpr double moderate = 0x1p+19; // up to here the four parts suffice

/// 64 bits of zero, then the bits of 2/pi behind the binary point.
constexpr std::array<std::uint64_t, 21> two_over_pi = {
    0,
    0xa2f9836e4e441529u,
    0xfc2757d1f534ddc0u,
    0xdb6295993c439041u,
    0xfe5163abdebbc561u,
    0xb7246e3a424dd2e0u,
    0x06492eea09d1921cu,
    0xfe1deb1cb129a73eu,
    0xe88235f52ebb4484u,
    0xe99c7026b45f7e41u,
    0x3991d639835339f4u,
    0x9c845f8bbdf9283bu,
    0x1ff897ffde05980fu,
    0xef2f118b5a0a6d1fu,
    0x6d367ecf27cb09b7u,
    0x4f463f669e5fea2du,
    0x7527bac7ebe5f17bu,
    0x3d0739f78a5292eau,
    0x6bfb5fb11f8d5d08u,
    0x56033046fc7b6babu,
    0xf0cfbc209af4361du,
};

/// 64 bits from place `first` on; place 0 is the first one of the table.
std::uint64_t bits_from(int first) {
  const auto word = static_cast<std::size_t>(first / 64);
  const int offset = first % 64;
  return offset == 0 ? two_over_pi[word] : (two_over_pi[word] << offset) | (two_over_pi[word + 1] >> (64 - offset));
}

/// The upper 64 bits of a b.
std::uint64_t upper_product(std::uint64_t a, std::uint64_t b) {
  const std::uint64_t low = 0xffffffffu, a0 = a & low, a1 = a >> 32, b0 = b & low, b1 = b >> 32;
  const std::uint64_t middle = a1 * b0 + ((a0 * b0) >> 32), other = a0 * b1 + (middle & low);
  return a1 * b1 + (middle >> 32) + (other >> 32);
}

/// Any finite x >= 1: x 64/pi modulo 128 in integers, by those bits of 2/pi that matter (Payne and Hanek, 1983). No
/// double lies nearer to a multiple of pi/64 than 2^-66 of it, and 132 bits behind the point are right.
Reduced reduced_exactly(double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const std::uint64_t mantissa = (bits & 0x000fffffffffffffu) | 0x0010000000000000u;
  const int exponent = static_cast<int>(bits >> 52) - 1075; // x = mantissa 2^exponent
  const int first = exponent - 2 + 64;                      // bits before this one make whole turns
  const std::uint64_t w0 = bits_from(first), w1 = bits_from(first + 64), w2 = bits_from(first + 128);
  // The product modulo 2^192: 7 bits of a whole number, then 185 of a fraction.
  const std::uint64_t p2 = mantissa * w2, part = mantissa * w1, p1 = part + upper_product(mantissa, w2);
  const std::uint64_t p0 = mantissa * w0 + upper_product(mantissa, w1) + (p1 < part ? 1 : 0);
  const bool up = ((p0 >> 56) & 1) != 0;
  std::uint64_t f0 = (p0 << 7) | (p1 >> 57), f1 = (p1 << 7) | (p2 >> 57);
  if (up) { // to the nearest whole number: the fraction is negative
    f1 = ~f1 + 1;
    f0 = ~f0 + (f1 == 0 ? 1 : 0);
  }
  const int zeros = f0 == 0 ? 64 : std::countl_zero(f0);
  if (zeros == 64) {
    f0 = f1;
    f1 = 0;
  } else if (zeros > 0) {
    f0 = (f0 << zeros) | (f1 >> (64 - zeros));
    f1 <<= zeros;
  }
  const double scale = power_of_two(-zeros - 64);
  const auto hi = static_cast<double>(f0 & ~std::uint64_t{0x7ff}), lo = static_cast<double>((f0 << 53) | (f1 >> 11));
  DoubleDouble fraction{hi * scale, lo * 0x1p-53 * scale};
  if (up)
    fraction = -fraction;
  return {static_cast<int>(p0 >> 57) + (up ? 1 : 0), pi_doubled * (1.0 / 64) * fast_two_sum(fraction.hi, fraction.lo)};
}

/// Any finite x.
Reduced reduced(double x) {
  if (std::fabs(x) >= moderate) {
    const Reduced r = reduced_exactly(std::fabs(x));
    return x > 0 ? r : Reduced{-r.turns, -r.rest};
  }
  const double turns = nearest(x * per_radian);
  const DoubleDouble s = two_sum(x - turns * part_1, -turns * part_2), t = two_sum(s.hi, -turns * part_3);
  return {static_cast<int>(turns), fast_two_sum(t.hi, (s.lo + t.lo) - turns * part_4)};
}

/// sin(turns pi/64 + rest)
DoubleDouble sine(int turns, DoubleDouble rest) {
  const DoubleDouble s = sines[static_cast<std::size_t>(turns & (turn - 1))];
  const DoubleDouble c = sines[static_cast<std::size_t>((turns + quarter) & (turn - 1))];
  const double r = rest.hi, q = r * r;
  // sin(r) - r and cos(r) - 1; the next terms are below 2^-61 and 2^-75.
  const double sine_more = r * q * (-1.0 / 6 + q * (1.0 / 120 + q * (-1.0 / 5040)));
  const double cosine_more = q * (-0.5 + q * (1.0 / 24 + q * (-1.0 / 720 + q * (1.0 / 40320))));
  const DoubleDouble p = two_product(c.hi, r), sum = two_sum(s.hi, p.hi);
  const double tail = (s.lo + p.lo + sum.lo) + (c.lo * r + c.hi * rest.lo) - s.hi * (r * rest.lo);
  return fast_two_sum(sum.hi, tail + (c.hi * sine_more + s.hi * cosine_more));
}

constexpr double small = 0x1p-28; // below, the second term of the series is less than half a unit

} // namespace

double sin(double x) {
  const double a = std::fabs(x);
  if (a < small)
    return x;
  if (!(a < infinity)) // with NaN
    return not_a_number;
  const Reduced r = reduced(x);
  return sine(r.turns, r.rest).hi;
}

double cos(double x) {
  if (!(std::fabs(x) < infinity)) // with NaN
    return not_a_number;
  const Reduced r = reduced(x);
  return sine(r.turns + quarter, r.rest).hi;
}

double tan(double x) {
  const double a = std::fabs(x);
  if (a < small)
    return x;
  if (!(a < infinity)) // with NaN
    return not_a_number;
  const Reduced r = reduced(x);
  return (sine(r.turns, r.rest) / sine(r.turns + quarter, r.rest)).hi;
}

} // namespace trime::elementary
