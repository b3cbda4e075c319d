// SPDX-License-Identifier: BSD-3-Clause
#include "cones/search_kernel_lanes.hpp"

namespace trime::cones {

SearchKernel search_kernel_avx2() {
  return {Search<4>::nearest, Search<4>::lowest};
}

} // namespace trime::cones
