// SPDX-License-Identifier: BSD-3-Clause
#include "cones/cone_kernel_lanes.hpp"

namespace trime::cones {

ConeKernel cone_kernel_avx512() {
  return {Cones<8>::evaluate, Cones<8>::pass_on, Cones<8>::choose};
}

} // namespace trime::cones
