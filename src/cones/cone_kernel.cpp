// SPDX-License-Identifier: BSD-3-Clause
#include "cones/cone_kernel.hpp"

namespace trime::cones {

ConeKernel cone_kernel(SimdLevel level) {
  switch (level) {
  case SimdLevel::avx512:
    return cone_kernel_avx512();
  case SimdLevel::avx2:
    return cone_kernel_avx2();
  case SimdLevel::portable:
    break;
  }
  return cone_kernel_portable();
}

} // namespace trime::cones
