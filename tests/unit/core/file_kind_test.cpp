// SPDX-License-Identifier: BSD-3-Clause
#include "core/read_file.hpp"

#include "support/temporary_directory.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>

namespace trime {
namespace {

TEST(FileKind, TellsWhatIsNoRegularFileThroughLinksToo) {
  const test::TemporaryDirectory directory;
  const std::string pipe = directory.path() + "/pipe", file = directory.path() + "/file",
                    link = directory.path() + "/link";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  std::ofstream(file) << "text";
  std::filesystem::create_symlink(pipe, link);
  EXPECT_EQ(irregular_kind(pipe), "a named pipe");
  EXPECT_EQ(irregular_kind(link), "a named pipe");
  EXPECT_EQ(irregular_kind(directory.path()), "a directory");
  EXPECT_EQ(irregular_kind("/dev/null"), "a device");
  EXPECT_EQ(irregular_kind(file), "");
  EXPECT_EQ(irregular_kind(directory.path() + "/nothing"), "");
}

} // namespace
} // namespace trime
