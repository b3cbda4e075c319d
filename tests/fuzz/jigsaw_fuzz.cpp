// SPDX-License-Identifier: BSD-3-Clause
// The `.msh` files of JIGSAW.
#include "fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trime;
  fuzz::survives([&] { fuzz::use(contours::parse_jigsaw(fuzz::text_of(data, size), "a.msh")); });
  return 0;
}
