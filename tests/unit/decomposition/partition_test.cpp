// SPDX-License-Identifier: BSD-3-Clause
// Contiguous ranges of tiles of about equal weight.
#include "core/random.hpp"
#include "decomposition/partition.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace trime::decomposition {
namespace {

void expect_contiguous(const Partition& partition, LocalIndex tiles, int ranks) {
  ASSERT_EQ(partition.ranks(), ranks);
  EXPECT_EQ(partition.first_tile(0), 0);
  EXPECT_EQ(partition.last_tile(ranks - 1), tiles);
  for (int rank = 0; rank < ranks; ++rank) {
    EXPECT_LE(partition.first_tile(rank), partition.last_tile(rank));
    EXPECT_EQ(partition.first_tile(rank), rank > 0 ? partition.last_tile(rank - 1) : 0);
    for (LocalIndex tile = partition.first_tile(rank); tile < partition.last_tile(rank); ++tile)
      EXPECT_EQ(partition.owner(tile), rank);
  }
}

std::vector<std::int64_t> random_weights(std::size_t n, std::int64_t largest, std::uint64_t seed) {
  std::vector<std::int64_t> weights;
  for (std::size_t t = 0; t < n; ++t)
    weights.push_back(static_cast<std::int64_t>(random_bits(seed, RandomPurpose::test, t, 0) %
                                                static_cast<std::uint64_t>(largest + 1)));
  return weights;
}

TEST(Partition, IsContiguousAndBalancedWithinOneTile) {
  for (const int ranks : {1, 2, 3, 7, 16, 100})
    for (const std::size_t tiles : {std::size_t{1}, std::size_t{5}, std::size_t{64}, std::size_t{1000}})
      for (const std::int64_t largest : {std::int64_t{1}, std::int64_t{1000}, std::int64_t{1} << 40}) {
        const std::vector<std::int64_t> weights = random_weights(tiles, largest, tiles);
        const Partition partition(weights, ranks);
        expect_contiguous(partition, static_cast<LocalIndex>(tiles), ranks);
        const std::int64_t total = std::accumulate(weights.begin(), weights.end(), std::int64_t{0});
        const std::int64_t heaviest = *std::max_element(weights.begin(), weights.end());
        for (int rank = 0; total > 0 && rank < ranks; ++rank) {
          const std::int64_t load = std::accumulate(weights.begin() + partition.first_tile(rank),
                                                    weights.begin() + partition.last_tile(rank), std::int64_t{0});
          EXPECT_LE(load, total / ranks + heaviest + 1);
          EXPECT_GE(load, total / ranks - heaviest - 1);
        }
      }
}

TEST(Partition, OneHeavyTileLeavesTheOtherRanksWhatIsLeft) {
  std::vector<std::int64_t> weights(10, 0);
  weights[6] = 100;
  const Partition partition(weights, 4);
  expect_contiguous(partition, 10, 4);
}

TEST(Partition, WithoutWeightsTheTilesAreSharedOutEvenly) {
  const std::vector<std::int64_t> zeros(10, 0);
  for (const int ranks : {1, 3, 4, 30}) {
    const Partition partition(zeros, ranks);
    expect_contiguous(partition, 10, ranks);
    for (int rank = 0; rank < ranks; ++rank)
      EXPECT_LE(partition.last_tile(rank) - partition.first_tile(rank), 10 / ranks + 1);
  }
}

TEST(Partition, TakesMoreRanksThanTilesAndNoTilesAtAll) {
  expect_contiguous(Partition(3, 8), 3, 8);
  expect_contiguous(Partition(std::vector<std::int64_t>{5, 5, 5}, 8), 3, 8);
  expect_contiguous(Partition(std::vector<std::int64_t>{}, 4), 0, 4);
}

} // namespace
} // namespace trime::decomposition
