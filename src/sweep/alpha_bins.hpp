// SPDX-License-Identifier: BSD-3-Clause
// A small histogram of alpha - 1, for the median of every sweep: integers, so that ranks and threads can be summed in
// any order.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace trime::sweep {

/// Eight bins an octave from 2^-20 to 16; what lies outside goes to the first or last bin.
class AlphaBins {
public:
  static constexpr std::size_t size = 24 * 8;

  void add(double excess) { ++counts_[bin(excess)]; }
  void add(const AlphaBins& other) {
    for (std::size_t k = 0; k < size; ++k)
      counts_[k] += other.counts_[k];
  }
  const std::array<std::int64_t, size>& counts() const { return counts_; }
  std::array<std::int64_t, size>& counts() { return counts_; }

  /// Median of alpha - 1; 0 without values.
  double median() const { return quantile(0.5); }
  /// Value below which a share of all values lies, linear inside its bin; 0 without values.
  double quantile(double share) const {
    std::int64_t all = 0;
    for (const std::int64_t count : counts_)
      all += count;
    double before = 0;
    for (std::size_t k = 0; k < size; ++k) {
      const double here = static_cast<double>(counts_[k]), wanted = share * static_cast<double>(all);
      if (here > 0 && before + here >= wanted)
        return edge(k) + (edge(k + 1) - edge(k)) * (wanted - before) / here;
      before += here;
    }
    return 0;
  }

private:
  static constexpr int mantissa_bits = 3;
  static constexpr double lowest = 0x1p-20;
  /// The leading bits of a positive double grow with it: exponent, then the first bits of the mantissa.
  static std::size_t bin(double excess) {
    constexpr std::uint64_t origin = std::bit_cast<std::uint64_t>(lowest) >> (52 - mantissa_bits);
    const double v = std::clamp(excess, lowest, 15.9);
    return static_cast<std::size_t>((std::bit_cast<std::uint64_t>(v) >> (52 - mantissa_bits)) - origin);
  }
  static double edge(std::size_t k) {
    if (k == 0)
      return 0;
    constexpr std::uint64_t origin = std::bit_cast<std::uint64_t>(lowest) >> (52 - mantissa_bits);
    return std::bit_cast<double>((origin + k) << (52 - mantissa_bits));
  }

  std::array<std::int64_t, size> counts_{};
};

} // namespace trime::sweep
