// SPDX-License-Identifier: BSD-3-Clause
// What the patches of a round may do with the number of sites.
#include "cleanup/cleanup_limits.hpp"

#include <gtest/gtest.h>

namespace trime::cleanup {
namespace {

constexpr GlobalId sites = 100000;
constexpr int last_stage = CleanupRules::stages;

TEST(CleanupLimits, APatchMayTakeLittleOfTheRoomAndLeavesAReserve) {
  EXPECT_EQ(CleanupLimits(sites, sites + 2000).budget(1, 1.1).may_insert, CleanupRules::patch_budget);
  constexpr GlobalId more = 607;
  const GlobalId reserve = 1 + static_cast<GlobalId>(CleanupRules::reserved * (sites + more));
  const CleanupLimits narrow(sites, sites + more);
  EXPECT_EQ(narrow.budget(1, 1.1).may_insert, more - reserve);
  EXPECT_LT(more - reserve, CleanupRules::patch_budget);
  EXPECT_EQ(narrow.budget(last_stage, 1.1).may_insert, CleanupRules::patch_budget) << "no reserve is left";
  EXPECT_EQ(narrow.budget(1, 1.1).may_refine, CleanupRules::most_refined);
  constexpr GlobalId few = 52;
  const GlobalId for_obtuse = static_cast<GlobalId>(CleanupRules::reserved_for_obtuse * (sites + few));
  EXPECT_EQ(CleanupLimits(sites, sites + few).budget(last_stage, 1.1).may_insert, few - for_obtuse);
  EXPECT_EQ(CleanupLimits(sites, sites + few).budget(last_stage, 1.1).may_refine, few - for_obtuse);
  EXPECT_EQ(CleanupLimits(sites, sites + few).budget(last_stage + 1, 1.1).may_insert, CleanupRules::patch_budget)
      << "what was reserved for obtuse triangles";
  EXPECT_EQ(narrow.budget(1, 1.1).may_delete, CleanupRules::patch_budget);
}

TEST(CleanupLimits, LaterStagesTryAgainAboveALimit) {
  const CleanupLimits limits(sites, 0);
  EXPECT_FALSE(limits.budget(1, 1.12).is_again);
  EXPECT_TRUE(limits.budget(2, 1.12).is_again);
  EXPECT_EQ(limits.budget(2, 1.12).again_alpha, 1.12);
  EXPECT_EQ(limits.budget(last_stage, 1.12).may_insert, CleanupRules::patch_budget) << "half a percent is allowed";
  EXPECT_EQ(limits.budget(last_stage, 1.12).deletion_handicap, 1);
}

TEST(CleanupLimits, ObtuseTrianglesCountInTheStagesThatFollowTheOthers) {
  const CleanupLimits limits(sites, 0);
  EXPECT_EQ(limits.budget(last_stage, 1.1).obtuse_weight, 0);
  double weight = 0;
  for (int k = 1; k <= CleanupRules::obtuse_stages; ++k) {
    const PatchBudget budget = limits.budget(last_stage + k, 1.1);
    EXPECT_GT(budget.obtuse_weight, weight) << "more from stage to stage";
    EXPECT_EQ(budget.is_last, k == CleanupRules::obtuse_stages);
    EXPECT_TRUE(budget.is_again);
    weight = budget.obtuse_weight;
  }
}

} // namespace
} // namespace trime::cleanup
