// SPDX-License-Identifier: BSD-3-Clause
// Sums whose value does not depend on the order of the terms: each term is rounded once to a multiple of 2^-32 and
// added as an integer. Everything that steers a run is summed this way, over threads and over ranks.
#pragma once

#include <cmath>
#include <cstdint>

namespace trime {

/// Fixed-point sum of terms of magnitude below 2^20, exact to 2^-33 a term, 2^42 terms at most.
/// The value travels between ranks as two 64-bit integers (see split, join).
class FixedSum {
public:
  static constexpr double unit = 0x1p-32;

  void add(double term) { value_ += static_cast<std::int64_t>(std::nearbyint(term * 0x1p32)); }
  void add(const FixedSum& other) { value_ += other.value_; }
  double value() const { return static_cast<double>(value_) * unit; }

  /// Low 32 bits and the rest: both parts may be summed over ranks as plain integers before join.
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
