// SPDX-License-Identifier: BSD-3-Clause
// What a user asks of the sweeps.
#pragma once

#include "trime/sweep/sweep_history.hpp"

#include <optional>

namespace trime::sweep {

struct SweepOptions {
  Method method;
  int max_sweeps;                       ///< moves of the whole run, all stages together
  std::optional<double> stop_tolerance; ///< least gain in six sweeps; empty: StopRules decide by rule and stage
  int density_exponent;                 ///< see CvdRule
  bool verify_stars = false;            ///< for tests: compares every star after every sweep with one computed anew
  bool stars_by_emptiness = false;      ///< for tests: certifies no star by those around it
};

} // namespace trime::sweep
