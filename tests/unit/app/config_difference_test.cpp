// SPDX-License-Identifier: BSD-3-Clause
// Which keys of a checkpoint's config must be those of the run.
#include "app/config.hpp"
#include "app/config_difference.hpp"

#include <gtest/gtest.h>

namespace trime::app {
namespace {

const char* const config = "[shape]\ngeometry = domain\n[meshing]\npoints = 1000\n";

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

TEST(ConfigDifference, ComparesNumbersAsNumbers) {
  const std::vector<std::string> circle{"shape.disc.type=circle", "shape.disc.center=0.5 0.25", "shape.disc.radius=0.1",
                                        "sizing.gradation=0.1", "meshing.corner_angle=30"};
  const std::vector<std::string> again{"shape.disc.type=circle",    "shape.disc.center=5e-1  +0.250",
                                       "shape.disc.radius=.10",     "sizing.gradation=0.10",
                                       "meshing.corner_angle=30.0", "meshing.points=1e3"};
  EXPECT_TRUE(differing_keys(resolved(circle), resolved(again)).empty());
  std::vector<std::string> other = again;
  other[1] = "shape.disc.center=0.5 0.2500001";
  other[3] = "sizing.gradation=0.1000001";
  EXPECT_EQ(differing_keys(resolved(circle), resolved(other)),
            (std::vector<std::string>{"center in [shape.disc]: 0.5 0.25 then, 0.5 0.2500001 now",
                                      "gradation in [sizing]: 0.1 then, 0.1000001 now"}));
  EXPECT_EQ(differing_keys(resolved({"meshing.initial_fraction=0.5"}), resolved({})).size(), 1U); // a number and a word
}

TEST(ConfigDifference, LeavesOutWhatLeavesTheMeshAsItIs) {
  EXPECT_TRUE(differing_keys(resolved({}), resolved({"output.name=other", "log.level=debug", "parallel.mesh_threads=3",
                                                     "checkpoint.interval=10", "output.directory=elsewhere"}))
                  .empty());
}

} // namespace
} // namespace trime::app
