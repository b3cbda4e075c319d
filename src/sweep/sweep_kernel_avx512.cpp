// SPDX-License-Identifier: BSD-3-Clause
// 8 sites side by side.
#define TRIME_LANES 8
#include "sweep/quality_kernel_lanes.hpp"

namespace trime::sweep {

const SweepKernels avx512_kernels{sweep_lanes, certify_lanes, measure_lanes};

} // namespace trime::sweep
