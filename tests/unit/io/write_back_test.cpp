// SPDX-License-Identifier: BSD-3-Clause
// A hint to the system: all that can be asked of it is that it harms nobody.
#include "io/write_back.hpp"

#include "support/temporary_directory.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

namespace trime::io {
namespace {

TEST(WriteBack, LeavesTheFileAsItIsWhileItGrows) {
  const test::TemporaryDirectory directory;
  const std::string path = directory.path() + "/file";
  constexpr int pieces = 300, piece = 10000;
  {
    std::ofstream file(path);
    WriteBack write_back(path);
    for (int k = 0; k < pieces; ++k) {
      file << std::string(piece, static_cast<char>('a' + k % 26)) << std::flush;
      write_back.request();
    }
  }
  std::ifstream file(path);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  ASSERT_EQ(text.size(), std::size_t{pieces} * piece);
  for (int k = 0; k < pieces; ++k)
    ASSERT_EQ(text[static_cast<std::size_t>(k) * piece + piece - 1], static_cast<char>('a' + k % 26));
}

TEST(WriteBack, EndsWithoutARequestOrAFile) {
  { const WriteBack unused("/nowhere/at/all"); }
  WriteBack without_file("/nowhere/at/all");
  without_file.request();
  without_file.request();
}

} // namespace
} // namespace trime::io
