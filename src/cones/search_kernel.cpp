// SPDX-License-Identifier: BSD-3-Clause
#include "cones/search_kernel.hpp"

namespace trime::cones {

SearchKernel search_kernel(SimdLevel level) {
  switch (level) {
  case SimdLevel::avx512:
    return search_kernel_avx512();
  case SimdLevel::avx2:
    return search_kernel_avx2();
  case SimdLevel::portable:
    break;
  }
  return search_kernel_portable();
}

} // namespace trime::cones
