// SPDX-License-Identifier: BSD-3-Clause
// Which places of bad triangles contend in a round.
#include "cleanup/cleanup_limits.hpp"

#include "core/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace trime::cleanup {
namespace {

using geometry::Vec2;

constexpr double h = 0.01;

mesh::TileGrid unit_grid() {
  return mesh::TileGrid(geometry::Box{{0, 0}, {1, 1}}, mesh::GridOptions{{}, {}, h});
}
CleanupCandidates::ContenderRule first_round() {
  return {1, 0, 10, 1, 0};
}

std::vector<Vec2> places_of(const std::vector<Contender>& contenders) {
  std::vector<Vec2> places;
  for (const Contender& contender : contenders)
    places.push_back(contender.place);
  return places;
}

TEST(CleanupCandidates, TheWorstOfACellContendsAndOfEquallyBadOnesTheFirst) {
  const mesh::TileGrid grid = unit_grid();
  CleanupCandidates candidates(grid);
  const Vec2 low{0.5001, 0.5001}, right{0.5003, 0.5001}, up{0.5001, 0.5004}; // of one cell
  candidates.set({low, h, 1.2});
  candidates.set({right, h, 1.3});
  EXPECT_EQ(places_of(candidates.contenders(first_round())), std::vector{right});
  candidates.set({up, h, 1.3});
  EXPECT_EQ(places_of(candidates.contenders(first_round())), std::vector{up}); // x before y
  EXPECT_EQ(candidates.worst(), 1.3);
  candidates.drop(up);
  candidates.drop(right);
  EXPECT_EQ(places_of(candidates.contenders(first_round())), std::vector{low});
  EXPECT_EQ(candidates.worst(), 1.2);
  candidates.drop(low);
  EXPECT_TRUE(candidates.contenders(first_round()).empty());
  EXPECT_EQ(candidates.worst(), 1);
}

TEST(CleanupCandidates, InTheLastStagesOnlyThoseWithAnObtuseTriangleContend) {
  const mesh::TileGrid grid = unit_grid();
  CleanupCandidates candidates(grid);
  const Vec2 worse{0.5001, 0.5001}, obtuse{0.5003, 0.5001}; // of one cell
  candidates.set({worse, h, 1.4});
  candidates.set({obtuse, h, 1.3, true});
  const CleanupCandidates::ContenderRule rule{4, 0, 10, 1, 0, true};
  EXPECT_EQ(places_of(candidates.contenders(first_round())), std::vector{worse});
  EXPECT_EQ(places_of(candidates.contenders(rule)), std::vector{obtuse});
  candidates.settle(obtuse, 4);
  EXPECT_TRUE(candidates.contenders(rule).empty());
  candidates.set({obtuse, h, 1.3, false}); // it has become acute
  EXPECT_TRUE(candidates.contenders({5, 0, 10, 1, 0, true}).empty());
}

TEST(CleanupCandidates, WhereNothingHelpedIsTriedAgainInTheNextStageAlone) {
  const mesh::TileGrid grid = unit_grid();
  CleanupCandidates candidates(grid);
  const Vec2 place{0.3, 0.7};
  candidates.set({place, h, 1.5});
  candidates.settle({0.1, 0.1}, 1); // no candidate
  EXPECT_EQ(candidates.contenders(first_round()).size(), 1U);
  candidates.settle(place, 1);
  EXPECT_TRUE(candidates.contenders(first_round()).empty());
  candidates.set({place, h, 1.4}); // something beside it has changed, but nothing there
  EXPECT_TRUE(candidates.contenders(first_round()).empty());
  EXPECT_EQ(candidates.contenders({2, 1.3, 10, 1, 5}).size(), 1U);
  EXPECT_TRUE(candidates.contenders({2, 1.4, 10, 1, 5}).empty()) << "not bad enough for that stage";
  for (int k = 0; k < 50; ++k)
    candidates.set({{0.01 * k, 0.2}, h, 1.1});
  for (int k = 0; k < 50; ++k)
    candidates.drop({0.01 * k, 0.2});
  EXPECT_TRUE(candidates.contenders(first_round()).empty()) << "whatever else the list forgets";
  candidates.drop(place);
  candidates.set({place, h, 1.4}); // another triangle
  EXPECT_EQ(candidates.contenders(first_round()).size(), 1U);
}

TEST(CleanupCandidates, ThoseThatFindNoRoomDoNotContend) {
  const mesh::TileGrid grid = unit_grid();
  CleanupCandidates candidates(grid);
  candidates.set({{0.3, 0.7}, h, 1.5});
  candidates.set({{0.6, 0.7}, 2 * h, 1.5});
  const std::vector<Contender> contenders = candidates.contenders({1, 0, 10, 15 * h, 0});
  ASSERT_EQ(contenders.size(), 1U);
  EXPECT_EQ(contenders.front().place, (Vec2{0.3, 0.7}));
  EXPECT_DOUBLE_EQ(contenders.front().separation, 10 * h);
}

/// Entries of candidates that are gone are taken out now and then; who was first in the list does not matter.
TEST(CleanupCandidates, TheListDoesNotDependOnWhatCameAndWent) {
  const mesh::TileGrid grid = unit_grid();
  CleanupCandidates few(grid), many(grid);
  std::vector<Candidate> all;
  for (std::uint64_t k = 0; k < 400; ++k)
    all.push_back({{random_unit(1, RandomPurpose::test, k, 0), random_unit(1, RandomPurpose::test, k, 1)},
                   h,
                   1.1 + random_unit(1, RandomPurpose::test, k, 2)});
  for (const Candidate& candidate : all)
    many.set(candidate);
  many.contenders(first_round());
  for (std::size_t k = 0; k < all.size(); ++k)
    if (k % 8 != 0)
      many.drop(all[k].place);
  many.contenders(first_round());
  for (std::size_t k = all.size(); k-- > 0;)
    if (k % 8 <= 1) {
      few.set(all[k]);
      many.set(all[k]);
    }
  const std::vector<Contender> a = few.contenders(first_round()), b = many.contenders(first_round());
  ASSERT_EQ(places_of(a), places_of(b));
  EXPECT_GT(a.size(), 60U);
  EXPECT_TRUE(std::is_sorted(a.begin(), a.end(), [](const Contender& one, const Contender& other) {
    return geometry::lexicographically_less(one.place, other.place);
  }));
  std::set<std::uint64_t> orders;
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_EQ(a[k].order, b[k].order);
    orders.insert(a[k].order);
  }
  EXPECT_EQ(orders.size(), a.size());
}

TEST(CleanupCandidates, WorseClassesComeFirstAndEachRoundHasItsOrder) {
  const mesh::TileGrid grid = unit_grid();
  CleanupCandidates candidates(grid);
  for (int k = 0; k < 60; ++k)
    candidates.set({{0.015 * k + 0.05, 0.5}, h, k % 2 == 0 ? 1.1 : 1.6});
  const auto order_in = [&](int round) {
    std::vector<Contender> contenders = candidates.contenders({1, 0, 10, 1, round});
    std::sort(contenders.begin(), contenders.end(),
              [](const Contender& a, const Contender& b) { return a.order < b.order; });
    return places_of(contenders);
  };
  const std::vector<Vec2> first = order_in(0), second = order_in(1);
  EXPECT_TRUE(std::is_permutation(first.begin(), first.end(), second.begin(), second.end()));
  EXPECT_NE(first, second);
  const auto is_bad = [](Vec2 p) { return std::lround((p.x - 0.05) / 0.015) % 2 == 1; };
  EXPECT_TRUE(std::is_partitioned(first.begin(), first.end(), is_bad));
}

} // namespace
} // namespace trime::cleanup
