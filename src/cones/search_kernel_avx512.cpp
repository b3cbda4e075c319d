// SPDX-License-Identifier: BSD-3-Clause
#include "cones/search_kernel_lanes.hpp"

namespace trime::cones {

SearchKernel search_kernel_avx512() {
  return {Search<8>::nearest, Search<8>::lowest};
}

} // namespace trime::cones
