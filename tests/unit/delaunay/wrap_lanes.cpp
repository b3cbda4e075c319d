// SPDX-License-Identifier: BSD-3-Clause
#include "unit/delaunay/wrap_lanes.hpp"

#include "delaunay/wrap_kernel.hpp"

namespace trime::delaunay {

void wrap_8_lanes(WrapGroup& group) {
  Wrap<8, 2>(group).run();
}

void wrap_16_lanes(WrapGroup& group) {
  Wrap<16, 4>(group).run();
}

} // namespace trime::delaunay
