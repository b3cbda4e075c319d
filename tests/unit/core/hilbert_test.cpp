// SPDX-License-Identifier: BSD-3-Clause
// The Hilbert curve.
#include "core/hilbert.hpp"

#include "core/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <set>

namespace trime {
namespace {

/// By the quarters, from the whole square on.
GridPosition position_of(std::uint64_t key, int level) {
  CurveSquare square;
  while (square.level < level)
    square = square.quarter(static_cast<unsigned>(key >> (2 * (level - square.level - 1))) & 3U);
  EXPECT_EQ(square.key, key);
  const CurveSquare same = curve_square(square.x, square.y, level);
  EXPECT_EQ(same.key, key);
  EXPECT_EQ(same.turn, square.turn);
  return {square.x, square.y};
}

TEST(HilbertCurve, KeyAndPositionAreInverse) {
  for (int level = 1; level <= 5; ++level)
    for (std::uint64_t key = 0; key < std::uint64_t{1} << (2 * level); ++key) {
      const GridPosition at = position_of(key, level);
      ASSERT_LT(std::max(at.x, at.y), 1u << level);
      ASSERT_EQ(hilbert_key(at.x, at.y, level), key);
    }
  for (std::uint64_t k = 0; k < 1000; ++k) {
    const std::uint64_t key = random_bits(1, RandomPurpose::test, k, 0);
    const GridPosition at = position_of(key, 32);
    EXPECT_EQ(hilbert_key(at.x, at.y, 32), key);
  }
}

TEST(HilbertCurve, NextKeyIsANeighbouringCell) {
  const auto distance = [](GridPosition a, GridPosition b) {
    return std::abs(static_cast<std::int64_t>(a.x) - b.x) + std::abs(static_cast<std::int64_t>(a.y) - b.y);
  };
  for (std::uint64_t key = 0; key + 1 < 4096; ++key)
    ASSERT_EQ(distance(position_of(key, 6), position_of(key + 1, 6)), 1);
  for (std::uint64_t k = 0; k < 1000; ++k) {
    const std::uint64_t key = random_bits(2, RandomPurpose::test, k, 0) >> 1;
    ASSERT_EQ(distance(position_of(key, 32), position_of(key + 1, 32)), 1);
  }
}

TEST(HilbertCurve, CoarseKeyIsThePrefixOfTheFineKey) {
  for (std::uint64_t k = 0; k < 1000; ++k) {
    const auto x = static_cast<std::uint32_t>(random_bits(3, RandomPurpose::test, k, 0));
    const auto y = static_cast<std::uint32_t>(random_bits(3, RandomPurpose::test, k, 1));
    const int level = 1 + static_cast<int>(k % 31);
    ASSERT_EQ(hilbert_key(x, y, 32) >> (2 * (32 - level)), hilbert_key(x >> (32 - level), y >> (32 - level), level));
  }
}

} // namespace
} // namespace trime
