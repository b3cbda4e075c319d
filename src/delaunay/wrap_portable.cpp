// SPDX-License-Identifier: BSD-3-Clause
#include "delaunay/wrap_kernel.hpp"

namespace trime::delaunay {

void wrap_portable(WrapGroup& group) {
  Wrap<4, 2>(group).run();
}

} // namespace trime::delaunay
