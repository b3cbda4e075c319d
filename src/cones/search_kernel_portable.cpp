// SPDX-License-Identifier: BSD-3-Clause
#include "cones/search_kernel_lanes.hpp"

namespace trime::cones {

SearchKernel search_kernel_portable() {
  return {Search<2>::nearest, Search<2>::lowest};
}

} // namespace trime::cones
