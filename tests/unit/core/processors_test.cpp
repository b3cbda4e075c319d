// SPDX-License-Identifier: BSD-3-Clause
#include "core/processors.hpp"

#include "support/point_sets.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace trime {
namespace {

TEST(Processors, SpreadThreadsStayFreeToGoWhereTheyLike) {
  const std::vector<int> before = usable_processors();
  const int threads = std::min(4, static_cast<int>(before.size()));
  const testing::OnThreads scope(threads);
  spread_threads(threads, 0);
  std::vector<std::vector<int>> seen(static_cast<std::size_t>(threads));
  thread_loop(1000, 1,
              [&](std::ptrdiff_t, int thread) { seen[static_cast<std::size_t>(thread)] = usable_processors(); });
  for (const std::vector<int>& usable : seen)
    if (!usable.empty()) { // has had an item
      EXPECT_EQ(usable, before);
    }
}

TEST(Processors, MoreThreadsThanProcessorsAreLeftToTheSystem) {
  const std::vector<int> before = usable_processors();
  const int all = static_cast<int>(before.size());
  spread_threads(all + 1, 0);
  spread_threads(1, all);
  EXPECT_EQ(usable_processors(), before);
}

} // namespace
} // namespace trime
