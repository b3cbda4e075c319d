// SPDX-License-Identifier: BSD-3-Clause
// 2 sites side by side.
#define TRIME_LANES 2
#include "sweep/quality_kernel_lanes.hpp"

namespace trime::sweep {

const SweepKernels portable_kernels{sweep_lanes, certify_lanes, measure_lanes};

} // namespace trime::sweep
