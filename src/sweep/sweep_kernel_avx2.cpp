// SPDX-License-Identifier: BSD-3-Clause
// 4 sites side by side.
#define TRIME_LANES 4
#include "sweep/quality_kernel_lanes.hpp"

namespace trime::sweep {

const SweepKernels avx2_kernels{sweep_lanes, certify_lanes, measure_lanes};

} // namespace trime::sweep
