// SPDX-License-Identifier: BSD-3-Clause
// When the sweeps end: from maxima and fixed-point sums over all ranks only, never from times.
#pragma once

#include "trime/meshing/options.hpp"

#include <optional>
#include <vector>

namespace trime::meshing {

/// @brief Converged: no site moved by more than 0.005 h in the last sweep. Quality stalled: the mean of
/// alpha - 1 fell by less than `tolerance` of itself over the last five sweeps, checked from sweep 10 on. Sweep cap.
class StopRule {
public:
  StopRule(int max_sweeps, double tolerance) : max_sweeps_(max_sweeps), tolerance_(tolerance) {}
  /// @param history all sweeps so far, the same on every rank
  std::optional<StopReason> decide(const std::vector<SweepRecord>& history) const;

private:
  int max_sweeps_;
  double tolerance_;
};

} // namespace trime::meshing
