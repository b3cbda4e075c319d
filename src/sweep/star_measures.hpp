// SPDX-License-Identifier: BSD-3-Clause
// Sums over all stars of a rank, which are kept for tiles that do not change.
#pragma once

#include "sweep/sweep_kernel.hpp"
#include "sweep/sweep_sums.hpp"

#include <atomic>
#include <vector>

namespace trime::sweep {

/// Measures the stars tile by tile, most of them by the vector kernel.
class StarMeasures {
public:
  /// Forgets all tiles; to be called after sites were sorted.
  void reset();
  /// Sites or stars of owned tile t change. May be called concurrently.
  void forget(std::size_t t) {
    if (!is_measured_.empty())
      std::atomic_ref(is_measured_[t]).store(0, std::memory_order_relaxed);
  }
  /// Sums over the stars of the inner owned sites: the same as sweep::measure, in less time. Threads over tiles.
  /// @param task without a rule, of these sites
  SweepSums measure(const SweepTask& task, const sites::StarView& view, double reference_size);

private:
  std::vector<SweepSums> of_tile_;        // by owned tile, if there is room for that
  std::vector<std::uint8_t> is_measured_; // by owned tile: and nothing has changed since
};

} // namespace trime::sweep
