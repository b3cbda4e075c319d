// SPDX-License-Identifier: BSD-3-Clause
// Measures edge lengths and triangle quality after a sweep: sums over the stars of the inner sites, for the history of
// the run and for the update rules. The sums of a tile are kept while the tile does not change.
#pragma once

#include "sites/site_state.hpp"
#include "sweep/sweep_kernel.hpp"
#include "trime/core/sum.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace trime::sweep {

/// A histogram of alpha - 1 with eight bins per octave from 2^-20 to 16. Smaller values are counted in the first bin,
/// larger values in the last.
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

  /// Returns the median of alpha - 1; 0 if no value was added.
  double median() const { return quantile(0.5); }
  /// Returns the value below which the given share of all values lies, by linear interpolation in its bin; 0 if no
  /// value was added.
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
  /// Returns the bin of a value. The bin follows from the leading bits of the double (exponent, then mantissa), which
  /// increase with the value.
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

/// Sums over the inner sites of a rank after one sweep. All sums are integers, so the order of the terms does not
/// matter.
struct SweepSums {
  FixedSum squared_length_ratio; ///< L^2 / h_ref^2, summed over the edges of length L from each inner site
  FixedSum squared_size_ratio; ///< h^2 / h_ref^2, summed over the same edges, where h is the mean of the target length
                               ///< at both ends
  FixedSum excess_alpha;       ///< alpha - 1, summed over the triangles with an inner site, each counted once
  AlphaBins alpha_bins;        ///< histogram of alpha - 1 over the same triangles
  std::int64_t triangles = 0;
  double max_alpha = 1;
  FixedSum
      power; ///< power of the last move: sum of -move . (move + lead before the move) / h^2, each term at most 2^10

  void add(const SweepSums& other);
  /// Returns whether the sums of both are the same, the power left out.
  bool has_same_measures(const SweepSums& other) const;
};

/// Adds the edges and triangles around the inner site i.
void measure_star(const sites::StarView& view, LocalIndex i, double reference_size, SweepSums& sums);

/// Returns the sums over the inner owned sites. Threads work on different tiles.
/// @param reference_size h_ref, any typical target edge length
SweepSums measure(const sites::StarView& view, double reference_size);

/// SweepSums of one tile without the power, with counts of 16 bits: a quarter of the memory.
class TileSums {
public:
  /// Returns whether the counts of these sums fit.
  static bool can_keep(const SweepSums& sums) { return sums.triangles <= std::numeric_limits<std::uint16_t>::max(); }
  TileSums() = default;
  /// @pre can_keep(sums)
  explicit TileSums(const SweepSums& sums);
  /// Adds these sums to those of other tiles.
  void add_to(SweepSums& sums) const;

private:
  FixedSum squared_length_ratio_, squared_size_ratio_, excess_alpha_;
  double max_alpha_ = 1;
  std::array<std::uint16_t, AlphaBins::size> alpha_counts_{};
  std::uint16_t triangles_ = 0;
};

/// Measures the stars tile by tile, most of them by the vector kernel.
class StarMeasures {
public:
  /// Forgets the sums of all tiles. Must be called after each sorting of the sites.
  void reset();
  /// Notes that sites or stars of owned tile t have changed. May be called concurrently.
  void forget(std::size_t t) {
    if (!is_measured_.empty())
      std::atomic_ref(is_measured_[t]).store(0, std::memory_order_relaxed);
  }
  /// Returns the sums over the stars of the inner owned sites. The result equals that of sweep::measure, and takes less
  /// time to compute. Threads work on different tiles.
  /// @param task the kernel input for these sites; it needs no update rule
  SweepSums measure(const SweepTask& task, const sites::StarView& view, double reference_size);

private:
  std::vector<TileSums> of_tile_;         // by owned tile; empty if they would take too much memory
  std::vector<std::uint8_t> is_measured_; // by owned tile: whether it was measured and has not changed since
};

} // namespace trime::sweep
