// SPDX-License-Identifier: BSD-3-Clause
#include "cones/cone_kernel_lanes.hpp"

namespace trime::cones {

ConeKernel cone_kernel_avx2() {
  return {Cones<4>::evaluate, Cones<4>::pass_on, Cones<4>::choose};
}

} // namespace trime::cones
