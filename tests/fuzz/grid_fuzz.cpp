// SPDX-License-Identifier: BSD-3-Clause
// The ASCII grids of ESRI.
#include "fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trime;
  fuzz::survives([&] { fuzz::use(contours::parse_grid(fuzz::text_of(data, size), "a.asc")); });
  fuzz::survives([&] { fuzz::use(contours::parse_grid_regions(fuzz::text_of(data, size), "a.asc")); });
  return 0;
}
