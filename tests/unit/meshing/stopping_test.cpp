// SPDX-License-Identifier: BSD-3-Clause
// When the sweeps end, and why.
#include "meshing/stopping.hpp"

#include <gtest/gtest.h>

namespace trime::meshing {
namespace {

/// History whose mean of alpha - 1 shrinks by `factor` a sweep.
std::vector<SweepRecord> history(int n, double factor, double max_move = 0.1) {
  std::vector<SweepRecord> records;
  double excess = 0.2;
  for (int k = 0; k < n; ++k, excess *= factor) {
    SweepRecord record;
    record.sweep = k;
    record.mean_alpha = 1 + excess;
    record.max_move = k == 0 ? 0 : max_move;
    records.push_back(record);
  }
  return records;
}

TEST(StopRule, TheStartHasNotMovedButIsNotConverged) {
  EXPECT_EQ(StopRule(100, 0.04).decide(history(1, 1)), std::nullopt);
  EXPECT_EQ(StopRule(100, 0.04).decide(history(2, 1, 0.0049)), StopReason::converged);
  EXPECT_EQ(StopRule(100, 0.04).decide(history(2, 1, 0.0051)), std::nullopt);
}

TEST(StopRule, QualityStallsWhenFiveSweepsBringLessThanTheTolerance) {
  const StopRule rule(100, 0.04);
  EXPECT_EQ(rule.decide(history(9, 1)), std::nullopt) << "too early to tell";
  EXPECT_EQ(rule.decide(history(10, 1)), StopReason::quality_stalled);
  EXPECT_EQ(rule.decide(history(10, 0.99)), std::nullopt) << "4.9 % better over five sweeps";
  EXPECT_EQ(rule.decide(history(10, 0.995)), StopReason::quality_stalled) << "2.5 % better";
  EXPECT_EQ(rule.decide(history(10, 1.1)), StopReason::quality_stalled) << "worse";
  EXPECT_EQ(StopRule(100, 0).decide(history(10, 0.999)), std::nullopt);
}

TEST(StopRule, TheSweepCapCountsMoves) {
  EXPECT_EQ(StopRule(0, 0.04).decide(history(1, 0.5)), StopReason::sweep_cap);
  EXPECT_EQ(StopRule(3, 0.04).decide(history(3, 0.5)), std::nullopt);
  EXPECT_EQ(StopRule(3, 0.04).decide(history(4, 0.5)), StopReason::sweep_cap);
}

TEST(StopRule, ReasonsHaveNames) {
  EXPECT_EQ(to_string(StopReason::converged), "converged");
  EXPECT_EQ(to_string(StopReason::quality_stalled), "quality stalled");
  EXPECT_EQ(to_string(StopReason::sweep_cap), "sweep cap");
}

} // namespace
} // namespace trime::meshing
