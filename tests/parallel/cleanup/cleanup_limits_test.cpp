// SPDX-License-Identifier: BSD-3-Clause
// How the number of sites is counted over the ranks and kept within its limits.
#include "cleanup/cleanup_limits.hpp"

#include <gtest/gtest.h>

namespace trime::cleanup {
namespace {

constexpr GlobalId sites = 100000;
constexpr int last_stage = CleanupRules::stages;

TEST(CleanupLimits, WhatIsAllowedFollowsTheNumberOfSites) {
  CleanupLimits limits(sites, sites); // no room at all
  EXPECT_EQ(limits.budget(last_stage, 1.1).may_insert, 0);
  EXPECT_EQ(limits.budget(last_stage, 1.1).may_refine, 0);
  EXPECT_EQ(limits.budget(last_stage, 1.1).deletion_handicap, CleanupRules::handicap_if_crowded);
  std::vector<PatchResult> none;
  limits.count(comm::Communicator::world(), {0, 501}, {}, none);
  EXPECT_EQ(limits.budget(last_stage, 1.1).may_insert, CleanupRules::patch_budget);
  EXPECT_EQ(limits.budget(last_stage, 1.1).may_delete, 0);
  EXPECT_EQ(limits.budget(last_stage, 1.1).deletion_handicap, CleanupRules::handicap_if_scarce);
}

/// Each rank has a patch that adds 4 sites and one that adds 3: together beyond the limit but for one. Those that come
/// first stay.
TEST(CleanupLimits, EditsBeyondTheLimitAreTakenBack) {
  const comm::Communicator world = comm::Communicator::world();
  const GlobalId ranks = world.size();
  CleanupLimits limits(sites, sites + 3 * ranks + 2);
  SiteEdit insertion;
  insertion.kind = polygon::EditKind::insert;
  std::vector<PatchResult> results(2);
  results[0].edits.assign(4, insertion);
  results[1].edits.assign(3, insertion);
  const auto order = static_cast<std::uint64_t>(world.rank());
  const std::vector<ChosenContender> chosen{{{{0.1, 0.1}, 0.1, 1000 + order}, world.rank(), 0},
                                            {{{0.9, 0.9}, 0.1, order}, world.rank(), 1}};
  const CleanupLimits::Gains own = CleanupLimits::gains_of(results);
  EXPECT_EQ(own.added, 7);
  EXPECT_EQ(own.taken, 0);
  limits.count(world, {world.sum(own.added), world.sum(own.taken)}, chosen, results);
  EXPECT_TRUE(results[0].edits.empty());
  EXPECT_TRUE(results[0].put_off);
  EXPECT_EQ(results[1].edits.size(), 3u);
  EXPECT_EQ(limits.budget(last_stage + CleanupRules::obtuse_stages, 1.1).may_insert, 2);
  // The rest is reserved for the stages against obtuse triangles.
  EXPECT_EQ(limits.budget(last_stage, 1.1).may_insert, 0);
}

} // namespace
} // namespace trime::cleanup
