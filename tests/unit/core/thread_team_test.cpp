// SPDX-License-Identifier: BSD-3-Clause
// Teams of threads: who takes part, and that those who wait sleep.
#include "core/thread_team.hpp"

#include <gtest/gtest.h>

#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <thread>

namespace trime {
namespace {

/// How many threads take part, and that their numbers differ.
int count_threads(int asked) {
  std::atomic<unsigned> seen = 0;
  std::atomic<int> calls = 0;
  on_each_thread(asked, [&](int thread) {
    ++calls;
    seen |= 1U << thread;
  });
  EXPECT_EQ(seen, (1U << calls) - 1);
  return calls;
}

/// [s] Of all threads of this process.
double cpu_seconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

TEST(ThreadTeam, HasAsManyThreadsAsAsked) {
  for (const int threads : {1, 3, 2, 2, 7, 1, 4})
    EXPECT_EQ(count_threads(threads), threads);
}

TEST(ThreadTeam, WorksOnceForEachOfManyCalls) {
  for (const int threads : {2, 3}) {
    std::atomic<int> calls = 0;
    for (int round = 0; round < 3000; ++round)
      on_each_thread(threads, [&](int) { ++calls; });
    EXPECT_EQ(calls, 3000 * threads);
  }
}

TEST(ThreadTeam, InsideOfWorkAThreadWorksAlone) {
  std::atomic<int> inner = 0;
  on_each_thread(3, [&](int) { on_each_thread(3, [&](int thread) { inner += thread == 0 ? 1 : 100; }); });
  EXPECT_EQ(inner, 3);
}

TEST(ThreadTeam, EachCallingThreadHasItsOwn) {
  std::atomic<int> others = 0;
  std::thread first([&] { others += count_threads(2); }), second([&] { others += count_threads(3); });
  EXPECT_EQ(count_threads(2), 2);
  first.join();
  second.join();
  EXPECT_EQ(others, 5);
}

TEST(ThreadTeam, WhoWaitsSleeps) {
  using namespace std::chrono_literals;
  double asleep = 0; // [s] of the processors
  for (int round = 0; round < 5; ++round) {
    count_threads(4);
    const double begin = cpu_seconds();
    std::this_thread::sleep_for(20ms); // three threads wait for work
    on_each_thread(4, [](int thread) { // and then for one of them
      if (thread == 1)
        std::this_thread::sleep_for(20ms);
    });
    asleep += cpu_seconds() - begin;
  }
  EXPECT_LT(asleep, 0.05); // 0.6 if they waited awake
}

TEST(ThreadTeam, AChildOfForkHasItsOwn) {
  EXPECT_EQ(count_threads(2), 2);
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0)
    std::exit(count_threads(2) == 2 ? 0 : 1);
  int status = -1;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
}

} // namespace
} // namespace trime
