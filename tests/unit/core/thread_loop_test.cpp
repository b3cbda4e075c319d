// SPDX-License-Identifier: BSD-3-Clause
#include "core/thread_loop.hpp"

#include "support/point_sets.hpp"

#include <gtest/gtest.h>

#include <sched.h>

#include <atomic>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace trime {
namespace {

TEST(ThreadLoop, VisitsEachItemOnce) {
  for (const int threads : {1, 2, 3, 7}) {
    const testing::OnThreads scope(threads);
    for (const std::ptrdiff_t n : {0, 1, 2, 3, 6, 64, 1000})
      for (const int chunk : {1, 4, 64, 2000}) {
        std::vector<std::atomic<int>> visits(static_cast<std::size_t>(n));
        thread_loop(n, chunk, [&](std::ptrdiff_t item, int thread) {
          EXPECT_LT(thread, threads);
          ++visits[static_cast<std::size_t>(item)];
        });
        for (const std::atomic<int>& count : visits)
          EXPECT_EQ(count, 1) << n << " items, " << threads << " threads, chunks of " << chunk;
      }
  }
}

TEST(ThreadLoop, WhoIsDoneTakesFromOthers) {
  const testing::OnThreads scope(2);
  constexpr int n = 1000, most_turns = 1000000;
  std::atomic<int> done = 0;
  int done_by_the_other = 0;
  thread_loop(n, 1, [&](std::ptrdiff_t item, int) {
    if (item == 0) { // stays until the other thread has done all that is left of this one's range
      for (int turn = 0; turn < most_turns && done < n - 1; ++turn)
        sched_yield();
      done_by_the_other = done;
    }
    ++done;
  });
  EXPECT_EQ(done_by_the_other, n - 1);
}

TEST(ThreadLoop, RethrowsWhatTheLowestItemThrowsAfterAllOthersAreDone) {
  for (const int threads : {1, 2, 3}) {
    const testing::OnThreads scope(threads);
    std::atomic<int> visits = 0;
    try {
      thread_loop(100, 1, [&](std::ptrdiff_t item, int) {
        ++visits;
        if (item % 40 == 15)
          throw std::runtime_error(std::to_string(item));
      });
      FAIL() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "15");
    }
    EXPECT_EQ(visits, 100);
  }
}

TEST(ThreadLoopBeside, DoesTheWorkOnceAndVisitsEachItemOnce) {
  for (const int threads : {1, 2, 3}) {
    const testing::OnThreads scope(threads);
    for (const std::ptrdiff_t n : {0, 1, 2, 50}) {
      int works = 0;
      std::vector<std::atomic<int>> visits(static_cast<std::size_t>(n));
      thread_loop_beside([&] { ++works; }, n,
                         [&](std::ptrdiff_t item, int) { ++visits[static_cast<std::size_t>(item)]; });
      EXPECT_EQ(works, 1);
      for (const std::atomic<int>& count : visits)
        EXPECT_EQ(count, 1);
    }
  }
}

TEST(PerThread, HasOneForEachThreadApartInMemory) {
  const testing::OnThreads scope(3);
  PerThread<std::vector<int>> lists(std::size_t{2}, 5);
  std::vector<const std::vector<int>*> places;
  for (const std::vector<int>& list : lists) {
    EXPECT_EQ(list, (std::vector<int>{5, 5}));
    places.push_back(&list);
  }
  ASSERT_EQ(places.size(), 3u);
  for (std::size_t k = 0; k < places.size(); ++k) {
    EXPECT_EQ(places[k], &lists[static_cast<int>(k)]);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(places[k]) % bytes_apart, 0u);
  }
  PerThread<int> counts;
  for (const int count : counts)
    EXPECT_EQ(count, 0);
}

} // namespace
} // namespace trime
