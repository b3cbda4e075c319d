// SPDX-License-Identifier: BSD-3-Clause
// The wrap kernel with as many lanes as on AVX2 and AVX-512, compiled for any processor, so that every machine can test
// it.
#pragma once

#include "delaunay/wrap.hpp"

namespace trime::delaunay {

void wrap_8_lanes(WrapGroup& group);
void wrap_16_lanes(WrapGroup& group);

} // namespace trime::delaunay
