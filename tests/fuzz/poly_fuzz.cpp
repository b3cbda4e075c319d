// SPDX-License-Identifier: BSD-3-Clause
// The `.poly` files of Triangle; what follows the first zero byte is the `.node` file.
#include "fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trime;
  const std::string_view text = fuzz::text_of(data, size);
  const std::size_t end = text.find('\0');
  const std::string_view nodes = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
  fuzz::survives([&] { fuzz::use(contours::parse_poly(text.substr(0, end), "a.poly", nodes)); });
  fuzz::survives([&] { fuzz::use(contours::parse_poly_regions(text.substr(0, end), "a.poly", nodes)); });
  fuzz::survives([&] { fuzz::use(contours::parse_poly_lines(text.substr(0, end), "a.poly", nodes)); });
  return 0;
}
