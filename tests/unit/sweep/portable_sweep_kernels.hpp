// SPDX-License-Identifier: BSD-3-Clause
// The sweep kernels with more lanes than in the portable build, compiled for any processor, so that every machine can
// test them.
#pragma once

#include "sweep/sweep_kernel.hpp"

namespace trime::sweep {

extern const SweepKernels portable_kernels_of_4_lanes, portable_kernels_of_8_lanes;

} // namespace trime::sweep
