// SPDX-License-Identifier: BSD-3-Clause
// An error that the other ranks do not learn of ends the job, with its message and without a half file.
#include "io/lone_failure.hpp"

#include "trime/core/error.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>

namespace trime::io {
namespace {

using namespace std::chrono_literals;

TEST(LoneFailure, EndsTheJobWhereTheOthersDoNotCome) {
  ::testing::GTEST_FLAG(death_test_style) = "threadsafe";
  const std::string path = ::testing::TempDir() + "lone_failure_test.tmp";
  std::ofstream(path) << "half a file";
  EXPECT_EXIT(
      {
        LoneFailure failure(path, 10ms);
        failure.begin("cannot write /Mesh in mesh.h5: No space left on device");
        std::this_thread::sleep_for(60s); // the others wait elsewhere
      },
      ::testing::ExitedWithCode(static_cast<int>(ExitCode::file)), "error: cannot write /Mesh.*one rank alone");
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(LoneFailure, DoesNothingWhereTheyCome) {
  for (const bool fails : {false, true}) {
    LoneFailure failure("nowhere");
    if (fails)
      failure.begin("cannot write");
  }
}

} // namespace
} // namespace trime::io
