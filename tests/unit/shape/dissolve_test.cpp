// SPDX-License-Identifier: BSD-3-Clause
// Polygons of one map that are united: narrow gaps between them are closed, islands and holes of one polygon stay.
#include "shape/dissolve.hpp"

#include <gtest/gtest.h>

#include <fmt/format.h>

namespace trime::shape {
namespace {

using geometry::Vec2;

const geometry::Frame frame(geometry::Box{{0, 0}, {1, 1}});

LatticeRing ring_of(int polygon, const std::vector<Vec2>& points) {
  LatticeRing ring;
  for (const Vec2 p : points) {
    ring.points.push_back(frame.snap(p));
    ring.lines.push_back(polygon);
  }
  ring.polygon = polygon;
  return ring;
}

Dissolved united(const std::vector<LatticeRing>& rings, double widest_gap) {
  return dissolve(rings, frame, {"map", widest_gap, [](Vec2 p) { return fmt::format("({}, {})", p.x, p.y); }});
}

/// Two polygons with a gap between them, 0.4 high and `width` wide in its middle.
std::vector<LatticeRing> around_gap(double width) {
  return {ring_of(1, {{0.1, 0.1}, {0.5, 0.1}, {0.5, 0.2}, {0.5 - width, 0.4}, {0.5, 0.6}, {0.5, 0.9}, {0.1, 0.9}}),
          ring_of(2, {{0.9, 0.9}, {0.5, 0.9}, {0.5, 0.1}, {0.9, 0.1}})};
}

TEST(Dissolve, GapsAreClosedIfTheyAreNarrower) {
  for (const double widest : {0.0, 0.004, 0.006}) { // the mean width is half of that in the middle
    const Dissolved found = united(around_gap(0.01), widest);
    EXPECT_EQ(found.gaps, widest > 0.005 ? 1u : 0u) << widest;
    EXPECT_EQ(found.rings.size(), widest > 0.005 ? 1u : 2u) << widest;
    EXPECT_NEAR(found.gap_area, widest > 0.005 ? 0.002 : 0, 1e-12);
    EXPECT_NEAR(found.overlap, 0, 1e-12);
    EXPECT_NEAR(found.shared_length, 0.4, 1e-9);
  }
}

TEST(Dissolve, ManyGapsThatTouchAreClosedOneByOne) {
  for (const bool with_overlaps : {true, false}) { // gaps and overlaps in turn, or gaps only
    std::vector<Vec2> left{{0.1, 0.9}, {0.1, 0.1}}, right{{0.9, 0.1}, {0.9, 0.9}};
    for (int k = 0; k <= 40; ++k) {
      const double y = 0.1 + 0.02 * k;
      left.push_back({0.5 + (k % 2 == 0 ? 0 : k % 4 == 1 && with_overlaps ? 1e-5 : -1e-5), y});
      right.push_back({0.5, 0.9 - 0.02 * k});
    }
    const Dissolved found = united({ring_of(1, left), ring_of(2, right)}, 1e-4);
    EXPECT_EQ(found.gaps, with_overlaps ? 10u : 20u);
    ASSERT_EQ(found.rings.size(), 1u);
    EXPECT_NEAR(found.gap_area, with_overlaps ? 2e-6 : 4e-6, 1e-10);
    EXPECT_NEAR(found.overlap, with_overlaps ? 2e-6 : 0, 1e-10);
  }
}

TEST(Dissolve, HolesOfOnePolygonAndIslandsInAGapStay) {
  std::vector<LatticeRing> rings = around_gap(0.01);
  rings.push_back(ring_of(1, {{0.2, 0.2}, {0.201, 0.5}, {0.2, 0.8}}));
  EXPECT_EQ(united(rings, 0.006).gaps, 1u);
  EXPECT_EQ(united(rings, 0.006).rings.size(), 2u);
  rings.push_back(ring_of(3, {{0.494, 0.4}, {0.496, 0.39}, {0.496, 0.41}}));
  EXPECT_EQ(united(rings, 0.006).gaps, 0u);
  EXPECT_EQ(united(rings, 0.006).rings.size(), 4u);
}

TEST(Dissolve, GapsThatLeadToTheOutsideStay) {
  const std::vector<LatticeRing> rings{ring_of(1, {{0.1, 0.1}, {0.4999, 0.1}, {0.5, 0.5}, {0.5, 0.9}, {0.1, 0.9}}),
                                       ring_of(2, {{0.9, 0.9}, {0.5, 0.9}, {0.5, 0.1}, {0.9, 0.1}})};
  const Dissolved found = united(rings, 0.01);
  EXPECT_EQ(found.gaps, 0u);
  ASSERT_EQ(found.rings.size(), 1u);
  EXPECT_EQ(found.rings[0].points.size(), 8u);
}

TEST(Dissolve, PolygonsOfWhichNothingRemainsAreNamed) {
  const LatticeRing land = ring_of(1, {{0.1, 0.1}, {0.9, 0.1}, {0.9, 0.9}, {0.1, 0.9}}),
                    inside = ring_of(2, {{0.3, 0.3}, {0.5, 0.3}, {0.5, 0.5}}),
                    beyond = ring_of(3, {{0.8, 0.3}, {0.95, 0.3}, {0.95, 0.5}}),
                    lake = ring_of(1, {{0.6, 0.6}, {0.7, 0.6}, {0.7, 0.7}}),
                    in_lake = ring_of(4, {{0.6, 0.6}, {0.7, 0.6}, {0.7, 0.7}});
  EXPECT_EQ(united({land, inside, beyond}, 0).covered, (std::vector<int>{2}));
  EXPECT_EQ(united({land, lake, in_lake}, 0).covered, (std::vector<int>{})); // it fills the lake
  EXPECT_EQ(united({land, ring_of(5, land.points)}, 0).covered, (std::vector<int>{}));
}

} // namespace
} // namespace trime::shape
