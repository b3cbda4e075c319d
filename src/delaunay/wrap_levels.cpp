// SPDX-License-Identifier: BSD-3-Clause
// CMake compiles this file once for each SIMD level, with TRIME_LANES doubles side by side and TRIME_LEVEL in names.
#include "core/simd_level.hpp"
#include "delaunay/wrap_kernel.hpp"

namespace trime::delaunay {

void TRIME_AT_LEVEL(wrap)(WrapGroup& group) {
  Wrap<2 * TRIME_LANES, TRIME_LANES == 8 ? 4 : 2>(group).run(); // of floats
}

} // namespace trime::delaunay
