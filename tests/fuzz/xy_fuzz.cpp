// SPDX-License-Identifier: BSD-3-Clause
// Contours and lists of points as `.xy` text.
#include "fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trime;
  const std::string_view text = fuzz::text_of(data, size);
  fuzz::survives([&] { fuzz::use(contours::parse_xy(text, "a.xy")); });
  fuzz::survives([&] { fuzz::use_curves(contours::parse_curves(text, "a.xy")); });
  fuzz::survives([&] { contours::parse_points(text, "points.xy"); });
  return 0;
}
