// SPDX-License-Identifier: BSD-3-Clause
// CMake compiles this file once for each SIMD level, with TRIME_LANES doubles side by side and TRIME_LEVEL in names.
#include "cones/cone_kernel_lanes.hpp"
#include "core/simd_level.hpp"

namespace trime::cones {

SearchKernel TRIME_AT_LEVEL(search_kernel)() {
  return {Search<TRIME_LANES>::nearest, Search<TRIME_LANES>::lowest};
}

ConeKernel TRIME_AT_LEVEL(cone_kernel)() {
  return {Cones<TRIME_LANES>::evaluate, Cones<TRIME_LANES>::pass_on, Cones<TRIME_LANES>::choose};
}

} // namespace trime::cones
