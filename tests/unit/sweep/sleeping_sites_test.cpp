// SPDX-License-Identifier: BSD-3-Clause
// What the kernels do with sites by their flags: which they move, which they leave alone, which fall asleep.
#include "unit/sweep/jittered_cloud.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace trime::sweep {
namespace {

TEST(SleepingSites, LetsThoseFallAsleepThatSurelyRest) {
  Cloud cloud(0, false);
  SweepTask task = cloud.task();
  CvdRule rule;
  rule.begin_sweep({});
  task.rule = rule.parameters();
  const LocalIndex end = cloud.points.owned() - 3;
  for (const SweepKernels* kernel : kernels()) {
    Pass pass(cloud.points.owned());
    pass.run(*kernel, task, end);
    const std::vector<std::uint8_t> after_first = pass.flags;
    const SweepTally first = pass.tally;
    std::fill_n(task.next_leads, end, Vec2{1, 1});
    pass.run_again(*kernel, task, end);
    int asleep = 0;
    for (LocalIndex i = 0; i < end; ++i)
      if (after_first[at(i)] == 0) { // has just fallen asleep
        EXPECT_EQ(pass.flags[at(i)], SiteFlags::copied);
        EXPECT_EQ(task.next_positions[i], task.positions[i]);
        EXPECT_EQ(task.next_leads[i], Vec2{});
        ++asleep;
      }
    EXPECT_GT(asleep, end / 3);
    EXPECT_EQ(pass.awake, std::ranges::count_if(after_first, [](int flags) { return flags & SiteFlags::awake; }));
    EXPECT_EQ(pass.tally.power, first.power) << "what sleeps adds nothing";
    EXPECT_EQ(pass.tally.squared_distance, first.squared_distance);
    const std::vector<std::uint8_t> after_second = pass.flags;
    std::fill_n(task.next_positions, end, Vec2{2, 2});
    pass.run_again(*kernel, task, end);
    for (LocalIndex i = 0; i < end; ++i)
      if (after_second[at(i)] == SiteFlags::copied) {
        EXPECT_EQ(task.next_positions[i], (Vec2{2, 2})) << "a copied site is not looked at";
      }
  }
}

/// A move just below `rest` may be one above it once there is momentum.
TEST(SleepingSites, KeepsThoseAwakeThatMomentumMayMove) {
  Cloud cloud(0, false);
  CvdRule rule;
  rule.begin_sweep({});
  LocalIndex middle = 0;
  for (LocalIndex i = 0; i < cloud.points.owned(); ++i)
    if (geometry::length(cloud.points.position(i) - Vec2{0.4, 0.4}) <
        geometry::length(cloud.points.position(middle) - Vec2{0.4, 0.4}))
      middle = i;
  std::vector<Vec2> places(cloud.points.positions().begin(), cloud.points.positions().end());
  const Vec2 place = places[at(middle)];
  SweepTask task = cloud.task();
  task.rule = rule.parameters();
  task.positions = places.data();
  Pass pass(cloud.points.owned());
  places[at(middle)] = place + Vec2{0.01 * spacing, 0};
  pass.run(kernels_portable, task, cloud.points.owned());
  const double way_back = geometry::length(task.next_positions[middle] - places[at(middle)]) / (0.01 * spacing);
  EXPECT_GT(way_back, 0.1);
  for (const double share : {0.4, 0.6, 0.9, 1.1}) { // of `rest`, as the move of the site
    places[at(middle)] = place + Vec2{share * SweepRules::rest * spacing / way_back, 0};
    for (const SweepKernels* kernel : kernels()) {
      pass.run(*kernel, task, cloud.points.owned());
      EXPECT_EQ((pass.flags[at(middle)] & SiteFlags::awake) != 0, share > SweepRules::rest_share) << share;
      EXPECT_EQ(task.next_positions[middle] == places[at(middle)], share < 1) << share;
    }
  }
}

TEST(SleepingSites, MovesOnlySitesThatAreAwake) {
  for (const bool is_graded : {false, true})
    for (const auto& rule : rules()) {
      Cloud cloud(0.3, is_graded, true);
      rule->begin_sweep(measure(cloud.view(), spacing));
      SweepTask task = cloud.task();
      task.rule = rule->parameters();
      task.least_class = SiteClass::bordered;
      const LocalIndex end = cloud.points.owned();
      for (const SweepKernels* kernel : kernels()) {
        Pass all(end), some(end);
        all.run(*kernel, task, end);
        const std::vector<Vec2> next(task.next_positions, task.next_positions + end);
        some.flags.resize(at(end));
        for (LocalIndex i = 0; i < end; ++i)
          some.flags[at(i)] = cloud.classes[at(i)] == SiteClass::held ? 0
                              : i % 3 == 0                            ? SiteFlags::awake | SiteFlags::watched
                              : i % 3 == 1 || cloud.classes[at(i)] != SiteClass::local ? SiteFlags::watched
                                                                                       : 0;
        const std::vector<std::uint8_t> before = some.flags;
        some.run_again(*kernel, task, end);
        for (LocalIndex i = 0; i < end; ++i) {
          const bool was_awake = before[at(i)] & SiteFlags::awake, was_asleep = SiteFlags::is_asleep(before[at(i)]),
                     is_suspect = std::ranges::count(some.suspects, i), is_left = std::ranges::count(some.irregular, i);
          EXPECT_EQ(is_suspect, !was_asleep && std::ranges::count(all.suspects, i));
          EXPECT_EQ(is_left, was_awake && std::ranges::count(all.irregular, i));
          if (is_suspect) {
            EXPECT_EQ(some.flags[at(i)], before[at(i)]);
          } else if (!is_left) {
            EXPECT_EQ(task.next_positions[i], was_awake ? next[at(i)] : task.positions[i]);
          }
        }
      }
    }
}

} // namespace
} // namespace trime::sweep
