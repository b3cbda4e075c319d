// SPDX-License-Identifier: BSD-3-Clause
// A hint to the system: it must harm nobody, neither the file nor the process.
#include "io/write_back.hpp"

#include "support/temporary_directory.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>

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

/// How many files this process has open.
std::ptrdiff_t open_files() {
  const std::filesystem::directory_iterator first("/proc/self/fd");
  return std::distance(begin(first), end(first));
}

TEST(WriteBack, LeavesNoFileBehindAndNoneOpen) {
  static_assert(noexcept(std::declval<WriteBack&>().request())); // the thread that writes must not be stopped by a hint
  const test::TemporaryDirectory directory;
  const std::string path = directory.path() + "/file";
  const std::ptrdiff_t before = open_files();
  { const WriteBack unused(path); }
  for (const bool there : {false, true}) {
    if (there)
      std::ofstream(path) << "text";
    WriteBack write_back(path);
    write_back.request();
    write_back.request();
  }
  EXPECT_EQ(std::filesystem::file_size(path), 4u);
  std::filesystem::remove(path);
  {
    WriteBack without_file(path);
    without_file.request();
  }
  EXPECT_FALSE(std::filesystem::exists(path)); // a hint creates nothing
  EXPECT_EQ(open_files(), before);
}

} // namespace
} // namespace trime::io
