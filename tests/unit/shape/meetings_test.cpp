// SPDX-License-Identifier: BSD-3-Clause
// Meetings of segments against brute force: found in bins where these are thin, by a tree where they are crowded.
#include "core/random.hpp"
#include "shape/lattice_rings.hpp"
#include "shape/rules.hpp"
#include "trime/geometry/lattice.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace trime::shape {
namespace {

using geometry::Segment;
using geometry::SegmentGrid;
using geometry::Vec2;

const geometry::Frame unit_frame(geometry::Box{{0, 0}, {1, 1}});

LatticeRing ring_of(const std::vector<Vec2>& points) {
  LatticeRing ring;
  for (const Vec2 p : points) {
    ring.points.push_back(unit_frame.snap(p));
    ring.lines.push_back(static_cast<int>(ring.points.size()));
  }
  return ring;
}

LatticeRing star(Vec2 center, double radius, int n, std::uint64_t key) {
  std::vector<Vec2> points;
  for (int k = 0; k < n; ++k) {
    const double angle = 2 * 3.14159265358979 * k / n;
    const double r = radius * (0.3 + 0.7 * random_unit(5, RandomPurpose::test, key, static_cast<std::uint64_t>(k)));
    points.push_back({center.x + r * std::cos(angle), center.y + r * std::sin(angle)});
  }
  return ring_of(points);
}

std::vector<SegmentPair> by_brute_force(const std::vector<LatticeRing>& rings) {
  const std::vector<Segment> segments = segments_of(rings);
  std::vector<LocalIndex> after;
  for (LocalIndex first = 0; const LatticeRing& ring : rings) {
    const auto n = static_cast<LocalIndex>(ring.points.size());
    for (LocalIndex k = 1; k <= n; ++k)
      after.push_back(first + k % n);
    first += n;
  }
  std::vector<SegmentPair> pairs;
  for (LocalIndex i = 0; i < std::ssize(segments); ++i)
    for (LocalIndex j = i + 1; j < std::ssize(segments); ++j)
      if (j != after[at(i)] && i != after[at(j)] && meeting_of(segments[at(i)], segments[at(j)]) != Meeting::none)
        pairs.push_back({i, j});
  return pairs;
}

/// @return how many meet
std::size_t expect_all_found(const std::vector<LatticeRing>& rings) {
  const std::vector<SegmentPair> expected = by_brute_force(rings);
  EXPECT_EQ(find_meetings(rings, SegmentGrid(segments_of(rings))), expected);
  return expected.size();
}

TEST(FindMeetings, OfStarsThatCrossAndTouch) {
  std::vector<LatticeRing> rings;
  for (std::uint64_t k = 0; k < 6; ++k)
    rings.push_back(star({0.3 + 0.08 * static_cast<double>(k), 0.5}, 0.25, 150, k));
  EXPECT_GT(expect_all_found(rings), 100u);
  rings.push_back(ring_of({{0.5, 0.5}, {0.75, 0.5}, {0.5, 0.75}})); // along lines between cells
  rings.push_back(ring_of({{0.75, 0.5}, {0.9, 0.5}, {0.9, 0.6}}));
  rings.push_back(ring_of({{0.6, 0.25}, {0.7, 0.25}, {0.625, 0.5}})); // a vertex on an edge
  expect_all_found(rings);
}

TEST(FindMeetings, OfOneRingThatIsSimple) {
  EXPECT_EQ(expect_all_found({star({0.5, 0.5}, 0.4, 2000, 1)}), 0u);
}

TEST(FindMeetings, OfSpikesThatCrowdTheBins) {
  std::vector<Vec2> points;
  constexpr int n = 700; // long slanted ones side by side, of which some cross the base
  for (int k = 0; k < n; ++k) {
    const double x = 0.1 + 0.2 * k / n;
    points.push_back({x, 0.1});
    points.push_back({x + 0.4 + 0.1 / n, k % 100 == 50 ? 0.05 : 0.9});
  }
  points.push_back({0.9, 0.08});
  points.push_back({0.1, 0.08});
  EXPECT_GT(expect_all_found({ring_of(points)}), 5u);
}

/// Of each chunk of segments the first ones: at least most_meetings, unless there are no more.
void expect_first_of_each_chunk(const std::vector<SegmentPair>& found, const std::vector<SegmentPair>& all) {
  std::size_t k = 0;
  for (std::size_t begin = 0; begin < all.size();) {
    const auto chunk_of = [](const SegmentPair& pair) { return pair[0] / ShapeRules::meeting_chunk; };
    std::size_t end = begin;
    while (end < all.size() && chunk_of(all[end]) == chunk_of(all[begin]))
      ++end;
    std::size_t same = 0;
    for (; begin + same < end && k < found.size() && found[k] == all[begin + same]; ++k)
      ++same;
    EXPECT_GE(same, std::min(end - begin, ShapeRules::most_meetings)) << chunk_of(all[begin]);
    begin = end;
  }
  EXPECT_EQ(k, found.size());
}

TEST(FindMeetings, OfManyTheFirstOfEachChunkAreFound) {
  std::vector<LatticeRing> rings;
  for (std::uint64_t k = 0; k < 130; ++k) // 5200 segments in three chunks; bins are crowded
    rings.push_back(star({0.5, 0.5}, 0.4, 40, k));
  const std::vector<SegmentPair> all = by_brute_force(rings);
  const std::vector<SegmentPair> found = find_meetings(rings, SegmentGrid(segments_of(rings)));
  EXPECT_LT(found.size(), all.size());
  expect_first_of_each_chunk(found, all);
}

TEST(FindMeetings, ManyInThinBinsAreFound) {
  std::vector<LatticeRing> rings; // two rings that cross at each of 12000 steps: more meetings than bins may list
  for (const double phase : {0.0, 1.0}) {
    std::vector<Vec2> points;
    for (int k = 0; k < 12000; ++k) {
      const double angle = 2 * 3.14159265358979 * k / 12000;
      const double r = 0.4 + (k % 2 == 0 ? 0.0001 : -0.0001) * (1 - 2 * phase);
      points.push_back({0.5 + r * std::cos(angle), 0.5 + r * std::sin(angle)});
    }
    rings.push_back(ring_of(points));
  }
  const std::vector<SegmentPair> all = by_brute_force(rings);
  EXPECT_GT(all.size(), ShapeRules::most_meetings);
  expect_first_of_each_chunk(find_meetings(rings, SegmentGrid(segments_of(rings))), all);
}

} // namespace
} // namespace trime::shape
