// SPDX-License-Identifier: BSD-3-Clause
// The wrap kernel with as many lanes as AVX2 and AVX-512 give it, compiled for any processor: so every machine tests
// them.
#pragma once

#include "delaunay/wrap.hpp"

namespace trime::delaunay {

void wrap_8_lanes(WrapGroup& group);
void wrap_16_lanes(WrapGroup& group);

} // namespace trime::delaunay
