// SPDX-License-Identifier: BSD-3-Clause
#include "app/checkpoint_names.hpp"

#include "support/temporary_directory.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace trime::app {
namespace {

TEST(CheckpointNames, AreThoseOfThisRunAlone) {
  EXPECT_EQ(checkpoint_slot("m.checkpoint-1.h5", "m"), 1);
  EXPECT_EQ(checkpoint_slot("m.checkpoint-1000.h5", "m"), most_checkpoints);
  for (const char* other : {"m.checkpoint-0.h5", "m.checkpoint-1001.h5", "m.checkpoint-99999999999999999999.h5",
                            "m.checkpoint-01.h5", "m.checkpoint-+1.h5", "m.checkpoint--1.h5", "m.checkpoint-.h5",
                            "m.checkpoint-1.h5.tmp-7-0f", "n.checkpoint-1.h5", "m.checkpoint-1", "m.h5"})
    EXPECT_EQ(checkpoint_slot(other, "m"), 0) << other;
}

TEST(CheckpointNames, AreFoundInTheDirectoryByNumber) {
  const test::TemporaryDirectory directory;
  const io::MeshFileOptions output{.directory = directory.path(), .name = "m"};
  for (const int slot : {10, 2, 1000})
    std::ofstream(checkpoint_path(output, slot)) << slot;
  std::ofstream(output.path(".checkpoint-1001.h5")) << "of nobody";
  EXPECT_EQ(checkpoint_files(output),
            (std::vector{checkpoint_path(output, 2), checkpoint_path(output, 10), checkpoint_path(output, 1000)}));
  EXPECT_TRUE(checkpoint_files({.directory = directory.path() + "/none", .name = "m"}).empty());
}

} // namespace
} // namespace trime::app
