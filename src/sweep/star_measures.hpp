// SPDX-License-Identifier: BSD-3-Clause
// Computes sums over all stars of a rank, and reuses those of tiles that do not change.
#pragma once

#include "sweep/sweep_kernel.hpp"
#include "sweep/sweep_sums.hpp"

#include <atomic>
#include <vector>

namespace trime::sweep {

/// Measures the stars tile by tile, most of them by the vector kernel.
class StarMeasures {
public:
  /// Forgets all tiles. Must be called after sites were sorted.
  void reset();
  /// Notes that sites or stars of owned tile t change. May be called concurrently.
  void forget(std::size_t t) {
    if (!is_measured_.empty())
      std::atomic_ref(is_measured_[t]).store(0, std::memory_order_relaxed);
  }
  /// Returns the sums over the stars of the inner owned sites: those of sweep::measure, in less time. Threads work on
  /// tiles.
  /// @param task the task of these sites, without a rule
  SweepSums measure(const SweepTask& task, const sites::StarView& view, double reference_size);

private:
  std::vector<SweepSums> of_tile_;        // by owned tile, if there is enough memory
  std::vector<std::uint8_t> is_measured_; // by owned tile: whether it was measured and has not changed since
};

} // namespace trime::sweep
