// SPDX-License-Identifier: BSD-3-Clause
// 4 sites side by side on any processor.
#define TRIME_LANES 4
#include "sweep/sweep_kernel_lanes.hpp"
#include "unit/sweep/portable_sweep_kernels.hpp"

namespace trime::sweep {

const SweepKernels portable_kernels_of_4_lanes{sweep_lanes, certify_lanes, measure_lanes};

} // namespace trime::sweep
