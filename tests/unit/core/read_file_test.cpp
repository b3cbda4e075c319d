// SPDX-License-Identifier: BSD-3-Clause
// Whole files: bytes as they are, and why a file cannot be read.
#include "core/read_file.hpp"

#include "support/temporary_directory.hpp"
#include "trime/core/error.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

namespace trime {
namespace {

std::string error_of(const std::string& path) {
  try {
    read_file(path);
    return "";
  } catch (const FileError& error) {
    return error.what();
  }
}

TEST(ReadFile, KeepsEveryByte) {
  const test::TemporaryDirectory directory;
  const std::string path = directory.path() + "/bytes";
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{1} << 16, std::size_t{200001}}) {
    std::string bytes;
    for (std::size_t k = 0; k < size; ++k)
      bytes += static_cast<char>(k * 7919 % 256);
    std::ofstream(path, std::ios::binary) << bytes;
    EXPECT_EQ(read_file(path), bytes) << size;
  }
}

TEST(ReadFile, SaysWhichFileAndWhy) {
  EXPECT_NE(error_of("no/such/file").find("no/such/file: No such file"), std::string::npos) << error_of("no/such/file");
  EXPECT_NE(error_of("/").find("cannot read /: Is a directory"), std::string::npos) << error_of("/");
}

TEST(ReadFile, RefusesWhatMayHaveNoEnd) {
  const test::TemporaryDirectory directory;
  const std::string pipe = directory.path() + "/pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_NE(error_of(pipe).find("expected a regular file"), std::string::npos) << error_of(pipe);
  EXPECT_NE(error_of("/dev/zero").find("expected a regular file"), std::string::npos);
}

TEST(ReadFile, SaysHowLargeAFileIsThatIsTooLarge) {
  const test::TemporaryDirectory directory;
  const std::string path = directory.path() + "/large";
  std::ofstream(path) << std::string(1000, 'x');
  EXPECT_EQ(read_file(path, "", 1000).size(), 1000u);
  try {
    read_file(path, "", 999);
    ADD_FAILURE();
  } catch (const FileError& error) {
    EXPECT_NE(std::string(error.what()).find("large has 1000 bytes or more; at most 999"), std::string::npos)
        << error.what();
  }
}

} // namespace
} // namespace trime
