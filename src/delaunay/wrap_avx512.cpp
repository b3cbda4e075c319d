// SPDX-License-Identifier: BSD-3-Clause
#include "delaunay/wrap_kernel.hpp"

namespace trime::delaunay {

void wrap_avx512(WrapGroup& group) {
  Wrap<16, 4>(group).run();
}

} // namespace trime::delaunay
