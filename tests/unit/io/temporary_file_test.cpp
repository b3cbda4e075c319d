// SPDX-License-Identifier: BSD-3-Clause
#include "io/temporary_file.hpp"

#include "trime/io/run_files.hpp"

#include "support/temporary_directory.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

namespace trime::io {
namespace {

std::string contents(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(TemporaryFile, ReplacesALargeFileThatOthersMayStillRead) {
  const test::TemporaryDirectory directory;
  const std::string path = directory.path() + "/mesh.h5";
  const std::string old_text(3 << 20, 'a'), new_text(2 << 20, 'b');
  write_text_file(path, old_text, nullptr);
  std::ifstream reader(path, std::ios::binary);
  for (int round = 0; round < 3; ++round)
    write_text_file(path, new_text, nullptr);
  EXPECT_EQ(contents(path), new_text);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(reader), {}), old_text);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(directory.path()), {}), 1);
}

TEST(TemporaryFile, IsKnownToASignalHandlerWhileItIsWritten) {
  const test::TemporaryDirectory directory;
  const std::string path = directory.path() + "/mesh.h5.tmp-1", final_path = directory.path() + "/mesh.h5";
  RunFiles files;
  {
    TemporaryFile temporary(path, &files);
    std::ofstream(path) << "half";
    files.remove_temporary();
    EXPECT_FALSE(std::filesystem::exists(path));
    std::ofstream(path) << "whole";
    temporary.publish(final_path);
    std::ofstream(path) << "of somebody else";
    files.remove_temporary();
    EXPECT_TRUE(std::filesystem::exists(path));
  }
  EXPECT_EQ(contents(final_path), "whole");
  EXPECT_FALSE(files.final_mesh_written());
}

} // namespace
} // namespace trime::io
