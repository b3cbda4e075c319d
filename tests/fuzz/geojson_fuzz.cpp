// SPDX-License-Identifier: BSD-3-Clause
// GeoJSON, with and without an attribute that names the boundary.
#include "fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trime;
  const std::string_view text = fuzz::text_of(data, size);
  for (const char* attribute : {"", "kind"}) {
    fuzz::survives([&] { fuzz::use(contours::parse_geojson(text, "a.geojson", attribute)); });
    fuzz::survives([&] { fuzz::use_curves(contours::parse_curves(text, "a.geojson", attribute)); });
  }
  return 0;
}
