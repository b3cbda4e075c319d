// SPDX-License-Identifier: BSD-3-Clause
// The sentence on what limits a run names the cause that costs most.
#include "app/run_limit.hpp"

#include <gtest/gtest.h>

namespace trime::app {
namespace {

/// Four ranks, ten seconds, nothing amiss.
Measurements good_run() {
  Measurements m;
  m.ranks = 4;
  m.total = 10;
  m.phases = {
      {"shape", 1, 0, 0.1, 0.1}, {"sweeps", 100, 0, 8, 8}, {"clean-up", 1, 0, 1.5, 1.5}, {"output", 1, 0, 0.4, 1}};
  m.counters[Counter::sites_swept] = {4000000, 1000000, 1000000};
  m.counters[Counter::points] = {40000, 10000, 10000};
  m.counters[Counter::densest_tile] = {4000, 900, 1000};
  m.counters[Counter::patches] = {400, 100, 100};
  m.counters[Counter::cleanup_rounds] = {40, 10, 10};
  m.counters[Counter::passes] = {400, 100, 100};
  m.counters[Counter::collectives] = {800, 200, 200};
  m.counters[Counter::messages] = {800, 200, 200};
  m.peak_memory = 100 << 20;
  return m;
}

TEST(RunLimit, SaysSoIfNothingCostsMuch) {
  EXPECT_EQ(run_limit(good_run()), "no measured cause takes more than 5 % of the time");
}

TEST(RunLimit, TellsOfImbalanceAndTheDensestTile) {
  Measurements m = good_run();
  m.counters[Counter::sites_swept].max = 1800000;
  m.counters[Counter::densest_tile].max = 4000;
  EXPECT_EQ(
      run_limit(m),
      "imbalance 1.80: one rank sweeps this many times as many points as the mean; the densest tile holds 40 % of a "
      "rank's points");
}

TEST(RunLimit, TellsOfPhasesThatTheRanksDoNotShare) {
  Measurements m = good_run();
  m.phases[0].mean = 4;
  m.phases[1].mean = 4.1;
  EXPECT_EQ(run_limit(m).find("set-up: 40 % of the time"), 0u) << run_limit(m);
  m = good_run();
  m.phases[3].mean = 5;
  m.phases[1].mean = 3.4;
  EXPECT_EQ(run_limit(m).find("output: 50 % of the time"), 0u) << run_limit(m);
}

TEST(RunLimit, TellsOfAClumsyCleanUp) {
  Measurements m = good_run();
  m.phases[1].mean = 2;
  m.phases[2].mean = 7.5;
  m.counters[Counter::patches].max = 250;
  EXPECT_EQ(run_limit(m), "clean-up: 75 % of the time goes to 10 rounds; one rank tries 2.5 times as many patches as "
                          "the mean");
}

TEST(RunLimit, TellsOfLatencyAndOfFetchRounds) {
  Measurements m = good_run();
  m.total = 0.01;
  m.phases.clear();
  EXPECT_EQ(run_limit(m), "latency: each sweep needs 2.0 collectives and 2.0 messages for only a few sites");
  m.counters[Counter::fetch_rounds] = {600, 150, 150};
  EXPECT_EQ(run_limit(m),
            "latency: each sweep needs 2.0 collectives and 2.0 messages for only a few sites; the halo is fetched "
            "1.5 times a sweep");
}

TEST(RunLimit, TellsOfTablesThatEveryRankHolds) {
  Measurements m = good_run();
  m.counters[Counter::grid_bytes].max = 30 << 20;
  m.counters[Counter::size_bytes].max = 30 << 20;
  EXPECT_EQ(run_limit(m),
            "memory: tables that every rank holds completely take 60.0 MiB, 60 % of the largest memory of a "
            "rank");
}

TEST(RunLimit, NamesTheLongestPhaseOfOneRank) {
  Measurements m = good_run();
  m.ranks = 1;
  EXPECT_EQ(run_limit(m), "one rank: 80 % of the time goes to sweeps");
  EXPECT_EQ(run_limit({}), "nothing was measured");
}

} // namespace
} // namespace trime::app
