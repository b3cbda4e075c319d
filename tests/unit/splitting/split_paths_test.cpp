// SPDX-License-Identifier: BSD-3-Clause
#include "splitting/split_paths.hpp"

#include <gtest/gtest.h>

namespace trime::splitting {
namespace {

using Pairs = std::vector<std::array<GlobalId, 2>>;

/// The edges of curves and their sides, which a test adds one by one.
struct Curves {
  std::vector<SplitEdge> edges;
  std::vector<EdgeSides> sides;

  void add(std::int32_t curve, std::array<GlobalId, 2> left, std::array<GlobalId, 2> right) {
    edges.push_back({left, curve}); // old ids do not matter
    sides.push_back({left, right});
  }
  std::vector<SplitPair> pairs() const { return split_pairs(edges, sides); }
};

Pairs points_of(const std::vector<SplitPair>& pairs, std::int32_t path) {
  Pairs points;
  for (const SplitPair& pair : pairs)
    if (pair.path == path)
      points.push_back(pair.points);
  return points;
}

TEST(SplitPaths, LeavesOutSingleEnds) {
  Curves curves;
  curves.add(0, {3, 9}, {4, 9}); // the edges are not listed in their order
  curves.add(0, {0, 1}, {0, 2});
  curves.add(0, {1, 3}, {2, 4});
  EXPECT_EQ(points_of(curves.pairs(), 0), (Pairs{{1, 2}, {3, 4}}));
  EXPECT_EQ(curves.pairs().size(), 2U);
}

TEST(SplitPaths, OfOneEdgeWithSingleEndsAreEmpty) {
  Curves curves;
  curves.add(0, {0, 1}, {0, 1});
  EXPECT_TRUE(curves.pairs().empty());
}

TEST(SplitPaths, OfRingsListEachPairOnce) {
  Curves curves;
  curves.add(0, {2, 4}, {3, 5});
  curves.add(0, {0, 2}, {1, 3});
  curves.add(0, {4, 0}, {5, 1});
  EXPECT_EQ(points_of(curves.pairs(), 0), (Pairs{{2, 3}, {4, 5}, {0, 1}}));
}

TEST(SplitPaths, EndWhereThreeArmsMeet) {
  Curves curves; // the copies 10, 11, 12 lie left and right of the stem, and beyond the bar
  curves.add(1, {10, 20}, {11, 21});
  curves.add(0, {0, 10}, {1, 12});
  curves.add(0, {11, 2}, {12, 3});
  const std::vector<SplitPair> pairs = curves.pairs();
  EXPECT_EQ(points_of(pairs, 0), (Pairs{{0, 1}, {10, 12}}));
  EXPECT_EQ(points_of(pairs, 1), (Pairs{{11, 12}, {2, 3}}));
  EXPECT_EQ(points_of(pairs, 2), (Pairs{{10, 11}, {20, 21}}));
  EXPECT_EQ(pairs.back().curve, 1);
}

TEST(SplitPaths, EndWhereTheDirectionTurns) {
  Curves curves; // two lines of one curve that end in the same point
  curves.add(0, {0, 2}, {1, 3});
  curves.add(0, {4, 3}, {5, 2});
  const std::vector<SplitPair> pairs = curves.pairs();
  EXPECT_EQ(points_of(pairs, 0), (Pairs{{0, 1}, {2, 3}}));
  EXPECT_EQ(points_of(pairs, 1), (Pairs{{4, 5}, {3, 2}}));
}

TEST(SplitPaths, OfOneCurveFollowEachOther) {
  Curves curves;
  curves.add(1, {0, 2}, {1, 3});
  curves.add(0, {2, 4}, {3, 5});
  const std::vector<SplitPair> pairs = curves.pairs();
  ASSERT_EQ(pairs.size(), 4U);
  EXPECT_EQ(pairs[0].curve, 0);
  EXPECT_EQ(pairs[0].points, (std::array<GlobalId, 2>{2, 3}));
  EXPECT_EQ(pairs[2].curve, 1);
  EXPECT_EQ(pairs[3].points, pairs[0].points); // the point where the curves meet stands in both
}

} // namespace
} // namespace trime::splitting
