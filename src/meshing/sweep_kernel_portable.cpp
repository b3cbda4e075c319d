// SPDX-License-Identifier: BSD-3-Clause
// 2 sites side by side.
#define TRIME_LANES 2
#include "meshing/sweep_kernel_lanes.hpp"

namespace trime::meshing {

SweepTally sweep_portable(const SweepTask& task, LocalIndex begin, LocalIndex end, SweepLeftovers& leftovers) {
  return sweep_lanes(task, begin, end, leftovers);
}

} // namespace trime::meshing
