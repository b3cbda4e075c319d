// SPDX-License-Identifier: BSD-3-Clause
// CMake compiles this file once for each SIMD level, with TRIME_LANES doubles side by side and TRIME_LEVEL in names.
#include "core/simd_level.hpp"
#include "sweep/sweep_kernel_lanes.hpp"

namespace trime::sweep {

const SweepKernels TRIME_AT_LEVEL(kernels){sweep_lanes, certify_lanes, measure_lanes};

} // namespace trime::sweep
