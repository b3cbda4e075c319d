// SPDX-License-Identifier: BSD-3-Clause
#include "trime/core/timer.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace trime {
namespace {

TEST(Counters, SumsAddUpAndOfPeaksTheLargestCounts) {
  Counters counters;
  counters.add(Counter::sites_swept, 30);
  counters.add(Counter::sites_swept, 12);
  counters.note(Counter::ghosts, 7);
  counters.note(Counter::ghosts, 5);
  CounterValues all = counters.take();
  EXPECT_EQ(all[Counter::sites_swept], 42);
  EXPECT_EQ(all[Counter::ghosts], 7);
  counters.add(Counter::sites_swept);
  counters.note(Counter::ghosts, 3);
  const CounterValues later = counters.take();
  EXPECT_EQ(later[Counter::sites_swept], 1) << "what was taken is gone";
  EXPECT_EQ(later[Counter::ghosts], 3);
  all += later;
  EXPECT_EQ(all[Counter::sites_swept], 43);
  EXPECT_EQ(all[Counter::ghosts], 7);
}

TEST(Counters, EachNeighbourCountsOnceInWhateverOrder) {
  Counters counters;
  for (const int to : {3, 5, 5, 1, 3, 4, 1})
    counters.add_message(to, 100);
  const CounterValues sent = counters.take();
  EXPECT_EQ(sent[Counter::neighbours], 4);
  EXPECT_EQ(sent[Counter::messages], 7);
  EXPECT_EQ(sent[Counter::bytes], 700);
  counters.add_message(9, 1);
  EXPECT_EQ(counters.take()[Counter::neighbours], 1) << "those of before are forgotten";
  EXPECT_EQ(counters.take()[Counter::neighbours], 0);
}

TEST(Counters, EachHasANameOfItsOwn) {
  std::set<std::string> names;
  for (std::size_t k = 0; k < counter_count; ++k)
    names.insert(name_of(static_cast<Counter>(k)).name);
  EXPECT_EQ(names.size(), counter_count);
  EXPECT_STREQ(name_of(Counter::messages).name, "messages");
  EXPECT_STREQ(name_of(Counter::rank_bytes).name, "rank_bytes");
  EXPECT_FALSE(is_peak(Counter::sites_extracted));
  EXPECT_TRUE(is_peak(Counter::densest_tile));
}

} // namespace
} // namespace trime
