// SPDX-License-Identifier: BSD-3-Clause
// Options of the sweeps.
#pragma once

#include "trime/sweep/sweep_history.hpp"

#include <optional>

namespace trime::sweep {

struct SweepOptions {
  Method method;
  int max_sweeps;                       ///< largest number of moves of the whole run, over all stages
  std::optional<double> stop_tolerance; ///< least gain in six sweeps; empty: StopRules decide by rule and stage
  int density_exponent;                 ///< see CvdRule
  StarTests star_tests = {};
};

} // namespace trime::sweep
