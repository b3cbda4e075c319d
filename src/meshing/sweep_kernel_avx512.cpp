// SPDX-License-Identifier: BSD-3-Clause
// 8 sites side by side.
#define TRIME_LANES 8
#include "meshing/sweep_kernel_lanes.hpp"

namespace trime::meshing {

SweepTally sweep_avx512(const SweepTask& task, LocalIndex begin, LocalIndex end, SweepLeftovers& leftovers) {
  return sweep_lanes(task, begin, end, leftovers);
}

} // namespace trime::meshing
