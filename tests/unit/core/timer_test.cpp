// SPDX-License-Identifier: BSD-3-Clause
#include "trime/core/timer.hpp"

#include <gtest/gtest.h>

namespace trime {
namespace {

double now = 0;
double told_clock() {
  return now;
}

TEST(TimerTable, GoesByTheClockThatItIsGivenAndCountsTraffic) {
  set_wall_clock(told_clock);
  Traffic sent{1, 10, 5};
  TimerTable timers(&sent);
  for (int call = 0; call < 3; ++call) {
    const auto time = timers.scope("work");
    now += 2;
    sent += {1, 100, 0};
  }
  now += 1;
  EXPECT_EQ(timers.total(), 7);
  ASSERT_EQ(timers.sections().size(), 1u);
  const TimerTable::Section& section = timers.sections()[0];
  EXPECT_EQ(section.seconds, 6);
  EXPECT_EQ(section.calls, 3);
  EXPECT_EQ(section.traffic.messages, 3);
  EXPECT_EQ(section.traffic.bytes, 300);
  EXPECT_EQ(section.traffic.collectives, 0);
  EXPECT_EQ(timers.traffic().bytes, 310);
  set_wall_clock(nullptr);
  const double before = wall_seconds();
  EXPECT_GE(wall_seconds(), before);
}

} // namespace
} // namespace trime
