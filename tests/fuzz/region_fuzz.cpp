// SPDX-License-Identifier: BSD-3-Clause
// Region expressions over four parts, of which each point lies in some.
#include "fuzz.hpp"
#include "trime/shape/region_shape.hpp"

#include <array>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trime;
  static const std::array<std::string, 4> names{"a", "b", "spade", "hole_2"};
  constexpr std::array<geometry::Box, 5> boxes{
      {{{0, 0}, {1, 1}}, {{1, 1}, {2, 2}}, {{-1, 0}, {3, 1}}, {{0, 0}, {0, 0}}, {{0, 0}, {1, 1}}}};
  fuzz::survives([&] {
    const shape::Region region = shape::Region::parse(fuzz::text_of(data, size), names);
    for (unsigned parts = 0; parts < 1U << boxes.size(); ++parts) // in which of them, and in the domain
      region.contains([&](int part) { return (parts >> part & 1U) != 0; });
    for (const int part : region.parts())
      TRIME_ASSERT(part >= 0 && part < static_cast<int>(boxes.size()), "part {}", part);
    region.box(boxes);
  });
  return 0;
}
