// SPDX-License-Identifier: BSD-3-Clause
#include "trime/core/timer.hpp"

#include <gtest/gtest.h>

namespace trime {
namespace {

double now = 0;
double told_clock() {
  return now;
}

TEST(TimerTable, GoesByTheClockThatItIsGivenAndTakesTheCounters) {
  set_wall_clock(told_clock);
  Counters counters;
  TimerTable timers(&counters);
  for (int call = 0; call < 3; ++call) {
    counters.add(Counter::messages, 10); // outside
    const auto time = timers.scope("work");
    now += 2;
    counters.add(Counter::messages);
    counters.note(Counter::ghosts, 7 - call);
  }
  now += 1;
  EXPECT_EQ(timers.total(), 7);
  ASSERT_EQ(timers.sections().size(), 1u);
  const TimerTable::Section& section = timers.sections()[0];
  EXPECT_EQ(section.seconds, 6);
  EXPECT_EQ(section.calls, 3);
  EXPECT_EQ(section.counts[Counter::messages], 3);
  EXPECT_EQ(section.counts[Counter::ghosts], 7);
  EXPECT_EQ(section.counts[Counter::collectives], 0);
  counters.add(Counter::messages, 5);
  EXPECT_EQ(timers.outside()[Counter::messages], 35);
  EXPECT_EQ(timers.outside()[Counter::messages], 35) << "nothing is counted twice";
  EXPECT_EQ(timers.outside()[Counter::ghosts], 0);
  set_wall_clock(nullptr);
  const double before = wall_seconds();
  EXPECT_GE(wall_seconds(), before);
}

} // namespace
} // namespace trime
