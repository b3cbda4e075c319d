// SPDX-License-Identifier: BSD-3-Clause
// The k smallest keys over all ranks.
#include "core/random.hpp"
#include "decomposition/selection.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace trime::decomposition {
namespace {

std::int64_t below(const comm::Communicator& world, const std::vector<std::uint64_t>& keys, std::uint64_t threshold) {
  return world.sum(std::count_if(keys.begin(), keys.end(), [&](std::uint64_t key) { return key < threshold; }));
}

TEST(Selection, ExactlyKOfDistinctKeys) {
  const comm::Communicator world = comm::Communicator::world();
  std::vector<std::uint64_t> keys;
  for (std::uint64_t j = 0; j < 1000; ++j)
    if (static_cast<int>(j % static_cast<std::uint64_t>(world.size())) == world.rank())
      keys.push_back(random_bits(3, RandomPurpose::test, j, 0) >> (j % 3 == 0 ? 40 : 0));
  for (const std::int64_t k : {0, 1, 17, 500, 999})
    EXPECT_EQ(below(world, keys, selection_threshold(world, keys, k)), k);
  EXPECT_EQ(below(world, keys, selection_threshold(world, keys, 1000)), 1000);
  EXPECT_EQ(below(world, keys, selection_threshold(world, keys, 5000)), 1000);
  EXPECT_EQ(below(world, keys, selection_threshold(world, keys, -4)), 0);
}

TEST(Selection, NeverMoreThanKOfEqualKeys) {
  const comm::Communicator world = comm::Communicator::world();
  const std::vector<std::uint64_t> keys(10, 77);
  EXPECT_EQ(below(world, keys, selection_threshold(world, keys, 5)), 0);
  EXPECT_EQ(below(world, keys, selection_threshold(world, keys, 10 * world.size())), 10 * world.size());
}

TEST(Selection, KeysGrowWithTheValue) {
  EXPECT_LT(selection_key(0.2, {0.9, 0.9}), selection_key(0.2001, {0.1, 0.1}));
  EXPECT_NE(selection_key(0.2, {0.9, 0.9}), selection_key(0.2, {0.1, 0.1}));
  EXPECT_EQ(selection_key(-1, {0, 0}) >> 32, 0u);
  EXPECT_EQ(selection_key(2, {0, 0}) >> 32, 0xffffffffu);
}

} // namespace
} // namespace trime::decomposition
