// SPDX-License-Identifier: BSD-3-Clause
// What the patches of a round may do with the number of sites.
#include "cleanup/cleanup_limits.hpp"

#include <gtest/gtest.h>

namespace trime::cleanup {
namespace {

constexpr GlobalId sites = 100000;
constexpr int last_stage = CleanupRules::stages;

TEST(CleanupLimits, PatchesShareTheRoomButForAReserve) {
  const CleanupLimits limits(sites, sites + 2000);
  const GlobalId reserve = 1 + static_cast<GlobalId>(CleanupRules::reserved * (sites + 2000));
  EXPECT_EQ(limits.budget(1, 1, 1.1).may_insert, 2000 - reserve);
  EXPECT_EQ(limits.budget(10, 1, 1.1).may_insert, (2000 - reserve) / 10);
  EXPECT_EQ(limits.budget(10, last_stage, 1.1).may_insert, 200) << "no reserve is left";
  EXPECT_EQ(limits.budget(1000000, 1, 1.1).may_insert, CleanupRules::least_budget);
  EXPECT_EQ(limits.budget(0, 1, 1.1).may_refine, CleanupRules::most_refined) << "a round without patches";
  EXPECT_EQ(limits.budget(1, 1, 1.1).may_delete, 501);
}

TEST(CleanupLimits, WhatIsAllowedFollowsTheNumberOfSites) {
  CleanupLimits limits(sites, sites); // no room at all
  EXPECT_EQ(limits.budget(1, last_stage, 1.1).may_insert, 0);
  EXPECT_EQ(limits.budget(1, last_stage, 1.1).may_refine, 0);
  EXPECT_EQ(limits.budget(1, last_stage, 1.1).deletion_handicap, CleanupRules::handicap_if_crowded);
  limits.add(-501);
  EXPECT_EQ(limits.budget(1, last_stage, 1.1).may_insert, 501);
  EXPECT_EQ(limits.budget(1, last_stage, 1.1).may_delete, 0);
  EXPECT_EQ(limits.budget(1, last_stage, 1.1).deletion_handicap, CleanupRules::handicap_if_scarce);
}

TEST(CleanupLimits, LaterStagesTryAgainAboveALimit) {
  const CleanupLimits limits(sites, 0);
  EXPECT_FALSE(limits.budget(1, 1, 1.12).is_again);
  EXPECT_TRUE(limits.budget(1, 2, 1.12).is_again);
  EXPECT_EQ(limits.budget(1, 2, 1.12).again_alpha, 1.12);
  EXPECT_EQ(limits.budget(1, last_stage, 1.12).may_insert, 501) << "half a percent and one";
  EXPECT_EQ(limits.budget(1, last_stage, 1.12).deletion_handicap, 1);
}

} // namespace
} // namespace trime::cleanup
