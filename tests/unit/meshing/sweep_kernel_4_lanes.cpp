// SPDX-License-Identifier: BSD-3-Clause
// 4 sites side by side on any processor.
#define TRIME_LANES 4
#include "meshing/quality_kernel_lanes.hpp"
#include "unit/meshing/portable_sweep_kernels.hpp"

namespace trime::meshing {

const SweepKernels portable_kernels_of_4_lanes{sweep_lanes, certify_lanes, measure_lanes};

} // namespace trime::meshing
