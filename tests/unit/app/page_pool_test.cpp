// SPDX-License-Identifier: BSD-3-Clause
#include "app/page_pool.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>
#include <vector>

namespace trime::app {
namespace {

constexpr std::size_t unit = std::size_t{1} << 20;

TEST(PagePool, AFreedBlockServesTheNext) {
  const auto pool = std::make_unique<PagePool>();
  void* const first = pool->allocate(8 * unit);
  ASSERT_NE(first, nullptr);
  void* const second = pool->allocate(4 * unit);
  ASSERT_TRUE(pool->deallocate(first));
  EXPECT_EQ(pool->kept(), 8 * unit);
  EXPECT_EQ(pool->allocate(3 * unit), first);
  EXPECT_EQ(pool->kept(), 5 * unit);
  EXPECT_TRUE(pool->deallocate(second));
}

TEST(PagePool, AKeptBlockGrowsIntoWhatIsFreeBehindIt) {
  const auto pool = std::make_unique<PagePool>();
  void* const first = pool->allocate(8 * unit);
  ASSERT_TRUE(pool->deallocate(first));
  EXPECT_EQ(pool->allocate(10 * unit), first);
  EXPECT_EQ(pool->used(), 10 * unit);
  EXPECT_EQ(pool->kept(), 0u);
}

TEST(PagePool, KnowsItsOwnBlocks) {
  const auto pool = std::make_unique<PagePool>();
  int elsewhere = 0;
  EXPECT_FALSE(pool->deallocate(&elsewhere));
  EXPECT_FALSE(pool->deallocate(nullptr));
  void* const block = pool->allocate(unit);
  EXPECT_FALSE(pool->deallocate(&elsewhere));
  EXPECT_TRUE(pool->deallocate(block));
}

TEST(PagePool, MoreThanTheMachineHasIsRefused) {
  EXPECT_EQ(std::make_unique<PagePool>()->allocate(std::size_t{1} << 60), nullptr);
}

TEST(PagePool, BlocksDoNotOverlapAndThePeakIsThatOfBlocksInUse) {
  struct Block {
    unsigned char* at;
    std::size_t size;
    unsigned char mark;
  };
  const auto pool = std::make_unique<PagePool>();
  std::mt19937 random(7);
  std::vector<Block> blocks;
  std::size_t most_used = 0;
  for (int step = 0; step < 800; ++step) {
    if (blocks.size() < 12 && random() % 2 == 0) {
      const std::size_t size = (1 + random() % 40) * (std::size_t{32} << 10);
      auto* at = static_cast<unsigned char*>(pool->allocate(size));
      ASSERT_NE(at, nullptr);
      blocks.push_back({at, size, static_cast<unsigned char>(step)});
      std::fill_n(at, size, blocks.back().mark);
    } else if (!blocks.empty()) {
      std::swap(blocks[random() % blocks.size()], blocks.back());
      const Block& block = blocks.back();
      ASSERT_EQ(std::count(block.at, block.at + block.size, block.mark), static_cast<std::ptrdiff_t>(block.size));
      ASSERT_TRUE(pool->deallocate(block.at));
      blocks.pop_back();
    }
    most_used = std::max(most_used, pool->used());
    ASSERT_LE(pool->used() + pool->kept(), most_used);
  }
  for (const Block& block : blocks)
    ASSERT_TRUE(pool->deallocate(block.at));
  EXPECT_EQ(pool->used(), 0u);
}

} // namespace
} // namespace trime::app
