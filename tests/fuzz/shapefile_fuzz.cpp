// SPDX-License-Identifier: BSD-3-Clause
// Shapefiles: the input is the length of NAME.shp and of NAME.shx in two bytes each, these files, and NAME.dbf.
#include "contours/contour_text.hpp"
#include "fuzz.hpp"
#include "support/temporary_directory.hpp"

#include <algorithm>
#include <fstream>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trime;
  static const test::TemporaryDirectory directory;
  constexpr std::size_t head = 4;
  if (size < head)
    return -1; // of no use for the corpus
  std::string_view rest = fuzz::text_of(data, size);
  rest.remove_prefix(head);
  const std::string stem = directory.path() + "/a";
  const auto write = [&](const char* ending, std::size_t length) {
    std::ofstream(stem + ending, std::ios::binary) << rest.substr(0, length);
    rest.remove_prefix(std::min(length, rest.size()));
  };
  write(".shp", data[0] + 256U * data[1]);
  write(".shx", data[2] + 256U * data[3]);
  write(".dbf", rest.size());
  for (const char* attribute : {"", "kind"})
    fuzz::survives(
        [&] { fuzz::use(contours::read_shapefile(stem + ".shp", "", attribute, contours::Faults::repair)); });
  return 0;
}
