// SPDX-License-Identifier: BSD-3-Clause
// Which keys of a checkpoint's config must be those of the run.
#include "app/config.hpp"
#include "app/config_difference.hpp"

#include <gtest/gtest.h>

namespace trime::app {
namespace {

const char* const config = "[shape]\nregion = domain\n[meshing]\npoints = 1000\n";

std::string resolved(const std::vector<std::string>& overrides) {
  return parse_config(config, "c.ini", overrides).resolved;
}

TEST(ConfigDifference, TellsEachKeyThatMakesAnotherMesh) {
  const std::vector<std::string> lines =
      differing_keys(resolved({}), resolved({"meshing.points=2000", "sizing.type=automatic"}));
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0], "points in [meshing]: 1000 then, 2000 now");
  EXPECT_EQ(lines[1], "type in [sizing]: uniform then, automatic now");
}

TEST(ConfigDifference, TellsKeysThatOneOfThemHasAlone) {
  const std::vector<std::string> lines =
      differing_keys(resolved({}), resolved({"meshing.points=", "meshing.edge_length=0.1"}));
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0], "edge_length in [meshing]: nothing then, 0.1 now");
  EXPECT_EQ(lines[1], "points in [meshing]: 1000 then, nothing now");
}

TEST(ConfigDifference, LeavesOutWhatLeavesTheMeshAsItIs) {
  EXPECT_TRUE(differing_keys(resolved({}), resolved({"output.name=other", "log.level=debug", "parallel.mesh_threads=3",
                                                     "checkpoint.interval=10", "output.directory=elsewhere"}))
                  .empty());
}

} // namespace
} // namespace trime::app
