// SPDX-License-Identifier: BSD-3-Clause
#include "meshing/relaxation.hpp"
#include "meshing/rules.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace trime::meshing {
namespace {

constexpr int points = 1000;

sweep::SweepOptions options_with_cap(int max_sweeps) {
  sweep::SweepOptions options{};
  options.max_sweeps = max_sweeps;
  return options;
}

/// Records of a stage every third sweep; a sweep takes a second, and alpha - 1 falls as a power of the sweeps.
std::vector<sweep::SweepRecord> history(int sweeps, double power, int stage = 0) {
  std::vector<sweep::SweepRecord> records;
  for (int k = 0; k <= sweeps; k += 3) {
    sweep::SweepRecord record;
    record.sweep = k;
    record.points = points;
    record.stage = stage;
    record.mean_alpha = 1 + 0.1 * std::pow(k + 1, -power);
    record.seconds = 10 + k;
    records.push_back(record);
  }
  return records;
}

TEST(Forecast, KnowsNothingBeforeTheFirstSweepsOfAStage) {
  EXPECT_LT(seconds_left(history(0, 1), {0, false, true, 0}, options_with_cap(500)), 0);
  std::vector<sweep::SweepRecord> records = history(30, 1);
  records.push_back(records.back());
  records.back().stage = 1;
  EXPECT_LT(seconds_left(records, {1, false, true, 1}, options_with_cap(500)), 0);
}

TEST(Forecast, SmallGainsMeanThatLittleIsLeft) {
  const double slow = seconds_left(history(30, 0.1), {0, false, true, 0}, options_with_cap(500));
  const double fast = seconds_left(history(30, 2), {0, false, true, 0}, options_with_cap(500));
  EXPECT_NEAR(slow, 3 + ForecastRules::after_sweeps, 1e-6); // a gain of 2 % has stalled: one measurement more
  EXPECT_GT(fast, 3 * slow);
}

TEST(Forecast, CountsFinerStagesByTheirPoints) {
  const double alone = seconds_left(history(9, 1), {0, false, true, 0}, options_with_cap(500));
  const double divided = seconds_left(history(9, 1), {0, false, false, 1}, options_with_cap(500));
  EXPECT_NEAR(divided - alone, 4 * ForecastRules::usual_sweeps + 3 * ForecastRules::after_sweeps, 1e-6);
}

TEST(Forecast, EndsWithTheSweepCap) {
  EXPECT_NEAR(seconds_left(history(30, 2), {0, false, true, 0}, options_with_cap(30)), ForecastRules::after_sweeps,
              1e-6);
}

} // namespace
} // namespace trime::meshing
