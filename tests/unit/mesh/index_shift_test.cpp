// SPDX-License-Identifier: BSD-3-Clause
// Entries that go and come in a list, against a list that is made anew.
#include "mesh/index_shift.hpp"

#include "core/random.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace trime::mesh {
namespace {

constexpr int newcomer = -7;

std::vector<int> made_anew(int before, const std::vector<LocalIndex>& gone, const std::vector<LocalIndex>& places) {
  std::vector<int> list;
  auto next_gone = gone.begin();
  auto next_place = places.begin();
  for (int k = 0; k <= before; ++k) {
    for (; next_place != places.end() && *next_place == k; ++next_place)
      list.push_back(newcomer);
    if (next_gone != gone.end() && *next_gone == k)
      ++next_gone;
    else if (k < before)
      list.push_back(k);
  }
  return list;
}

void expect_as_made_anew(int before, const std::vector<LocalIndex>& gone, const std::vector<LocalIndex>& places) {
  const IndexShift shift(before, gone, places);
  std::vector<int> moved(static_cast<std::size_t>(before));
  std::iota(moved.begin(), moved.end(), 0);
  shift.move(moved);
  ASSERT_EQ(std::ssize(moved), shift.after());
  for (const LocalIndex i : shift.come())
    moved[static_cast<std::size_t>(i)] = newcomer;
  EXPECT_EQ(moved, made_anew(before, gone, places));
  const std::vector<LocalIndex> indices = shift.new_indices();
  ASSERT_EQ(std::ssize(indices), before);
  std::ptrdiff_t staying = 0;
  for (int k = 0; k < before; ++k)
    if (const LocalIndex i = indices[static_cast<std::size_t>(k)]; i >= 0) {
      EXPECT_EQ(moved[static_cast<std::size_t>(i)], k);
      ++staying;
    }
  EXPECT_EQ(staying, before - std::ssize(gone));
}

TEST(IndexShift, MovesEntriesUpAndDown) {
  expect_as_made_anew(0, {}, {});
  expect_as_made_anew(0, {}, {0, 0});
  expect_as_made_anew(5, {}, {});
  expect_as_made_anew(5, {0, 4}, {});
  expect_as_made_anew(5, {0, 1, 2, 3, 4}, {});
  expect_as_made_anew(5, {2}, {2});
  expect_as_made_anew(5, {2}, {3});
  expect_as_made_anew(5, {}, {0, 0, 3, 5, 5});
  for (std::uint64_t seed = 0; seed < 40; ++seed) { // now the one, now the other is the more frequent
    std::vector<LocalIndex> gone, places;
    const auto draw = [&](std::uint64_t what, int k) {
      return random_unit(seed, RandomPurpose::test, what, static_cast<std::uint64_t>(k / 20)) *
             random_unit(seed, RandomPurpose::test, 2 + what, static_cast<std::uint64_t>(k));
    };
    for (int k = 0; k < 200; ++k) {
      if (draw(0, k) > 0.5)
        gone.push_back(k);
      for (double share = draw(1, k); share > 0.4; share -= 0.2)
        places.push_back(k);
    }
    expect_as_made_anew(200, gone, places);
  }
}

} // namespace
} // namespace trime::mesh
