// SPDX-License-Identifier: BSD-3-Clause
// The kernels with more lanes than the portable build has, compiled for any processor: so every machine tests them.
#pragma once

#include "sweep/sweep_kernel.hpp"

namespace trime::sweep {

extern const SweepKernels portable_kernels_of_4_lanes, portable_kernels_of_8_lanes;

} // namespace trime::sweep
