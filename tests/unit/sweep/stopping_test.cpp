// SPDX-License-Identifier: BSD-3-Clause
// When the sweeps end, and why.
#include "sweep/stopping.hpp"

#include <optional>

#include <gtest/gtest.h>

namespace trime::sweep {
namespace {

/// History whose mean of alpha - 1 shrinks by `factor` a sweep.
std::vector<SweepRecord> history(int n, double factor, double max_move = 0.1) {
  std::vector<SweepRecord> records;
  double excess = 0.2;
  for (int k = 0; k < n; ++k, excess *= factor) {
    SweepRecord record;
    record.sweep = k;
    record.mean_alpha = 1 + excess;
    record.median_alpha = 1 + excess / 2;
    record.max_move = k == 0 ? 0 : max_move;
    records.push_back(record);
  }
  return records;
}

TEST(StopRule, TheStartHasNotMovedButIsNotConverged) {
  EXPECT_EQ(StopRule(100, {0.04}).decide(history(1, 1)), std::nullopt);
  EXPECT_EQ(StopRule(100, {0.04}).decide(history(2, 1, 0.0049)), StopReason::converged);
  EXPECT_EQ(StopRule(100, {0.04}).decide(history(2, 1, 0.0051)), std::nullopt);
}

TEST(StopRule, QualityStallsWhenSixSweepsBringLessThanTheTolerance) {
  const StopRule rule(100, {0.04});
  EXPECT_EQ(rule.decide(history(9, 1)), std::nullopt) << "too early to tell";
  EXPECT_EQ(rule.decide(history(10, 1)), StopReason::quality_stalled);
  EXPECT_EQ(rule.decide(history(10, 0.99)), std::nullopt) << "5.9 % better over six sweeps";
  EXPECT_EQ(rule.decide(history(10, 0.995)), StopReason::quality_stalled) << "3 % better";
  EXPECT_EQ(rule.decide(history(10, 1.1)), StopReason::quality_stalled) << "worse";
  EXPECT_EQ(StopRule(100, {0}).decide(history(10, 0.999)), std::nullopt);
}

TEST(StopRule, CountsInSweepsHoweverManyAreRecorded) {
  std::vector<SweepRecord> records;
  for (const SweepRecord& record : history(13, 0.99))
    if (record.sweep % 3 == 0)
      records.push_back(record);
  EXPECT_EQ(StopRule(100, {0.04}).decide(records), std::nullopt);
  EXPECT_EQ(StopRule(100, {0.07}).decide(records), StopReason::quality_stalled);
  records.resize(3); // sweep 6
  EXPECT_EQ(StopRule(100, {0.07}).decide(records), std::nullopt) << "too early to tell";
}

TEST(StopRule, TheSweepCapCountsMoves) {
  EXPECT_EQ(StopRule(0, {0.04}).decide(history(1, 0.5)), StopReason::sweep_cap);
  EXPECT_EQ(StopRule(3, {0.04}).decide(history(3, 0.5)), std::nullopt);
  EXPECT_EQ(StopRule(3, {0.04}).decide(history(4, 0.5)), StopReason::sweep_cap);
}

TEST(MedianStalled, WhenSixSweepsBringLessThanThreeTenths) {
  EXPECT_FALSE(median_stalled(history(6, 1)));
  EXPECT_TRUE(median_stalled(history(7, 0.95)));
  EXPECT_FALSE(median_stalled(history(7, 0.93)));
  EXPECT_TRUE(median_stalled(history(3, 0.05))) << "nothing left to gain";
}

TEST(StopRule, EndsWhereTheGainIsTooSmallToBeSeen) {
  std::vector<SweepRecord> records = history(10, 1);
  for (SweepRecord& record : records) // a tenth in six sweeps, of nearly nothing
    record.mean_alpha = 1 + 4e-4 * (1 - 0.018 * record.sweep);
  EXPECT_EQ(StopRule(100, {0.04, 6, false}).decide(records), StopReason::quality_stalled);
  for (SweepRecord& record : records)
    record.mean_alpha = 1 + 10 * (record.mean_alpha - 1);
  EXPECT_EQ(StopRule(100, {0.04, 6, false}).decide(records), std::nullopt);
}

TEST(StopRule, PatienceMayBeShortAndLookAtTheMeanAlone) {
  std::vector<SweepRecord> records = history(7, 1);
  EXPECT_EQ(StopRule(100, {0.07, 6, false}).decide(records), StopReason::quality_stalled);
  EXPECT_EQ(StopRule(100, {0.07, 7, false}).decide(records), std::nullopt);
  records.back().median_alpha = 1 + 0.5 * (records.front().median_alpha - 1);
  EXPECT_EQ(StopRule(100, {0.07, 6, false}).decide(records), StopReason::quality_stalled);
  EXPECT_EQ(StopRule(100, {0.07, 6, true}).decide(records), std::nullopt) << "the median still falls";
}

/// Decides and carries it out, as the mesher does.
SweepDecision follow(SweepControl& control) {
  const SweepDecision decision = control.decide();
  if (decision.next)
    control.switch_to(*decision.next);
  return decision;
}

/// Feeds a history line by line; notes after how many triangulations the stage ended, and when bars and cells were
/// left.
struct StagedRun {
  StagedRun(Method method, bool inserts, bool is_last, double factor) {
    const SweepOptions options{method, 60, {}, SweepRules::density_exponent};
    std::vector<SweepRecord> records;
    SweepControl control(options, records);
    control.begin_stage(inserts, is_last);
    started_with_bars = control.mover() == Mover::bars;
    for (const SweepRecord& record : history(100, factor)) {
      records.push_back(record);
      reason = follow(control).stop;
      if (control.mover() != Mover::bars && left_bars < 0)
        left_bars = record.sweep;
      if (control.mover() == Mover::triangles && left_cells < 0)
        left_cells = record.sweep;
      if (reason)
        break;
    }
    triangulations = static_cast<int>(records.size());
  }
  bool started_with_bars = false;
  int left_bars = -1, left_cells = -1, triangulations = 0;
  std::optional<StopReason> reason;
};

TEST(SweepControl, MethodsKeepToTheirRules) {
  EXPECT_TRUE(StagedRun(Method::distmesh, false, true, 0.98).started_with_bars);
  EXPECT_EQ(StagedRun(Method::distmesh, false, true, 0.98).left_bars, -1);
  EXPECT_FALSE(StagedRun(Method::cvd, false, true, 0.98).started_with_bars);
  EXPECT_EQ(StagedRun(Method::cvd, false, true, 0.995).left_cells, -1);
}

TEST(SweepControl, HybridGoesOverWhenTheMedianStalls) {
  const StagedRun run(Method::hybrid, false, true, 0.995);
  EXPECT_TRUE(run.started_with_bars);
  EXPECT_EQ(run.left_bars, 6);
  EXPECT_EQ(run.left_cells, 6 + 9) << "nine sweeps of their own before the cells may stall";
  EXPECT_EQ(run.triangulations, 6 + 9 + 6 + 1) << "and six for the triangles";
  EXPECT_EQ(run.reason, StopReason::quality_stalled);
}

TEST(SweepControl, HybridKeepsBarsWhilePointsAreStillInserted) {
  const StagedRun run(Method::hybrid, true, false, 0.999);
  EXPECT_EQ(run.left_bars, -1);
  EXPECT_EQ(run.reason, StopReason::quality_stalled);
}

TEST(SweepControl, HybridHasOnlyTrianglesAfterADivision) {
  const SweepOptions options{Method::hybrid, 500, {}, SweepRules::density_exponent};
  std::vector<SweepRecord> records;
  SweepControl control(options, records);
  control.begin_stage(false, false);
  for (const SweepRecord& record : history(60, 0.999)) {
    records.push_back(record);
    if (follow(control).stop)
      break;
  }
  EXPECT_EQ(control.mover(), Mover::triangles);
  const std::size_t before = records.size();
  EXPECT_LT(before, 30U);
  control.begin_stage(false, true);
  std::optional<StopReason> reason;
  for (const SweepRecord& record : history(60, 0.97)) { // 17 % in six sweeps
    records.push_back(record);
    EXPECT_EQ(control.mover(), Mover::triangles);
    reason = follow(control).stop;
    if (reason)
      break;
  }
  EXPECT_EQ(reason, std::nullopt);
  records.push_back(records.back());
  records.back().mean_alpha = records[records.size() - 8].mean_alpha;
  EXPECT_EQ(control.decide().stop, StopReason::quality_stalled);
}

TEST(SweepControl, TheCapEndsWhateverRuns) {
  for (const Method method : {Method::distmesh, Method::cvd, Method::hybrid})
    EXPECT_EQ(StagedRun(method, false, true, 0.9).reason, StopReason::sweep_cap);
}

TEST(StopRule, ReasonsHaveNames) {
  EXPECT_EQ(to_string(StopReason::converged), "converged");
  EXPECT_EQ(to_string(StopReason::quality_stalled), "quality stalled");
  EXPECT_EQ(to_string(StopReason::sweep_cap), "sweep cap");
}

} // namespace
} // namespace trime::sweep
