// SPDX-License-Identifier: BSD-3-Clause
#include "cones/cone_kernel_lanes.hpp"

namespace trime::cones {

ConeKernel cone_kernel_portable() {
  return {Cones<2>::evaluate, Cones<2>::pass_on, Cones<2>::choose};
}

} // namespace trime::cones
