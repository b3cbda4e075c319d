// SPDX-License-Identifier: BSD-3-Clause
// Sums whose value does not depend on the order of their terms: each term is rounded once to a multiple of 2^-32 and
// added as an integer. All sums on which a mesh depends are computed this way, over threads and over ranks.
#pragma once

#include <bit>
#include <cstdint>

namespace trime {

/// Returns the nearest integer, ties to even, for |v| <= 2^51: adding 1.5 * 2^52 leaves no bits for the fraction.
/// std::nearbyint would be a library call on processors for which the compiler cannot assume a rounding instruction.
inline double round_to_integer(double v) {
  return (v + 0x1.8p52) - 0x1.8p52;
}

/// A fixed-point sum of at most 2^42 terms. Each term must be below 2^18 in magnitude, and is rounded with an error of
/// at most 2^-33. The sum travels between ranks as two 64-bit integers (see split, join).
class FixedSum {
public:
  static constexpr double unit = 0x1p-32;

  void add(double term) { value_ += static_cast<std::int64_t>(round_to_integer(term * 0x1p32)); }
  void add(const FixedSum& other) { value_ += other.value_; }
  /// Returns by how many units add(term) would raise the sum: at most 2^50. Loops over many terms may first add up
  /// these integers.
  static std::int64_t units(double term) {
    // Both doubles have the same exponent, so their bits differ by the integer; processors compute this for several
    // terms at a time.
    return std::bit_cast<std::int64_t>(term * 0x1p32 + 0x1.8p52) - std::bit_cast<std::int64_t>(0x1.8p52);
  }
  /// Adds this number of units to the sum.
  void add_units(std::int64_t units) { value_ += units; }
  double value() const { return static_cast<double>(value_) * unit; }

  /// The low 32 bits of the sum, and the rest. Each part may be summed over ranks as a plain integer before join.
  struct Parts {
    std::int64_t low, high;
  };
  Parts split() const {
    return {static_cast<std::int64_t>(value_ & 0xffffffff), static_cast<std::int64_t>(value_ >> 32)};
  }
  static FixedSum join(Parts parts) {
    FixedSum sum;
    sum.value_ = (static_cast<Wide>(parts.high) << 32) + parts.low;
    return sum;
  }

private:
  __extension__ using Wide = __int128;
  Wide value_ = 0;
};

} // namespace trime
