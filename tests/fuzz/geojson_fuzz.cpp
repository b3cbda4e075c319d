// SPDX-License-Identifier: BSD-3-Clause
// GeoJSON, with and without an attribute that names the boundary.
#include "fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trime;
  for (const char* attribute : {"", "kind"})
    fuzz::survives([&] { fuzz::use(contours::parse_geojson(fuzz::text_of(data, size), "a.geojson", attribute)); });
  return 0;
}
