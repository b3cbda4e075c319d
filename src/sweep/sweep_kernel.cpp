// SPDX-License-Identifier: BSD-3-Clause
#include "sweep/sweep_kernel.hpp"

#include "core/simd_level.hpp"

namespace trime::sweep {

const SweepKernels& sweep_kernels() {
#if defined(__x86_64__)
  switch (simd_level()) {
  case SimdLevel::avx512:
    return avx512_kernels;
  case SimdLevel::avx2:
    return avx2_kernels;
  case SimdLevel::portable:
    break;
  }
#endif
  return portable_kernels;
}

} // namespace trime::sweep
