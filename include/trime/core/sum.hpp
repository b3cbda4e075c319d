// SPDX-License-Identifier: BSD-3-Clause
// Sums whose value does not depend on the order of the terms: each term is rounded once to a multiple of 2^-32 and
// added as an integer. All sums that influence a mesh are computed this way, over threads and over ranks.
#pragma once

#include <bit>
#include <cstdint>

namespace trime {

/// Returns the nearest integer, ties to even, for |v| <= 2^51: adding 1.5 * 2^52 leaves no bits for the fraction. The
/// standard function would be a library call wherever the compiler cannot assume the processor's instruction.
inline double round_to_integer(double v) {
  return (v + 0x1.8p52) - 0x1.8p52;
}

/// Fixed-point sum of terms of magnitude below 2^18, exact to 2^-33 a term, 2^42 terms at most.
/// The value travels between ranks as two 64-bit integers (see split, join).
class FixedSum {
public:
  static constexpr double unit = 0x1p-32;

  void add(double term) { value_ += static_cast<std::int64_t>(round_to_integer(term * 0x1p32)); }
  void add(const FixedSum& other) { value_ += other.value_; }
  /// Returns the multiple of the unit that add(term) adds: at most 2^50. Loops over many terms may add these first.
  static std::int64_t units(double term) {
    // The integer is what differs in the last bits: this way processors have it for several terms at a time.
    return std::bit_cast<std::int64_t>(term * 0x1p32 + 0x1.8p52) - std::bit_cast<std::int64_t>(0x1.8p52);
  }
  /// Adds a multiple of the unit.
  void add_units(std::int64_t units) { value_ += units; }
  double value() const { return static_cast<double>(value_) * unit; }

  /// The low 32 bits and the rest. Both parts may be summed over ranks as plain integers before join.
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
