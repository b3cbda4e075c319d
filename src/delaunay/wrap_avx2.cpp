// SPDX-License-Identifier: BSD-3-Clause
#include "delaunay/wrap_kernel.hpp"

namespace trime::delaunay {

void wrap_avx2(WrapGroup& group) {
  Wrap<8, 2>(group).run();
}

} // namespace trime::delaunay
