// SPDX-License-Identifier: BSD-3-Clause
#include "delaunay/wrap.hpp"

namespace trime::delaunay {

WrapKernel wrap_kernel(SimdLevel level) {
  switch (level) {
  case SimdLevel::avx512:
    return {wrap_avx512, 16};
  case SimdLevel::avx2:
    return {wrap_avx2, 8};
  case SimdLevel::portable:
    break;
  }
  return {wrap_portable, 4};
}

} // namespace trime::delaunay
