// SPDX-License-Identifier: BSD-3-Clause
// Coarser copies of curves and the distances that are found with them.
#include "sizing/boundary_distance.hpp"

#include "sizing/coarse_curves.hpp"
#include "support/boundary_shapes.hpp"
#include "support/plain_shapes.hpp"
#include "support/point_sets.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace trime::sizing {
namespace {

using geometry::Vec2;

/// A coast with waves of several lengths.
geometry::Boundary wavy_coast(int vertices) {
  std::vector<Vec2> points;
  for (int k = 0; k < vertices; ++k) {
    const double t = 2 * M_PI * k / vertices;
    const double r = 0.35 + 0.05 * std::sin(9 * t) + 0.004 * std::sin(83 * t) + 0.0004 * std::sin(1009 * t);
    points.push_back({0.5 + r * std::cos(t), 0.5 + r * std::sin(t)});
  }
  geometry::Boundary boundary;
  boundary.part_names = {"coast"};
  boundary.loops.push_back(testing::polygon_loop(points));
  return boundary;
}

double nearest_of(const std::vector<geometry::Piece>& pieces, Vec2 p) {
  double least = std::numeric_limits<double>::infinity();
  for (const geometry::Piece& piece : pieces)
    least = std::fmin(least, piece.distance(p));
  return least;
}

TEST(CoarseCurves, StayNearTheGivenOnesAndTheOtherWayRound) {
  const std::vector<geometry::Piece> given = wavy_coast(5000).loops.front().pieces;
  for (const double deviation : {1e-4, 1e-3, 1e-2}) {
    const std::vector<geometry::Piece> coarse = coarse_curves(given, deviation);
    EXPECT_LT(coarse.size(), given.size()) << deviation;
    EXPECT_EQ(coarse.front().start, given.front().start);
    EXPECT_EQ(coarse.back().end, given.back().end);
    for (std::size_t k = 0; k < coarse.size(); ++k) {
      EXPECT_EQ(coarse[k].start, coarse[k == 0 ? coarse.size() - 1 : k - 1].end);
      for (const double share : {0.25, 0.5, 0.75})
        EXPECT_LE(nearest_of(given, coarse[k].point(share * coarse[k].length())), deviation);
    }
    for (std::size_t k = 0; k < given.size(); k += 7)
      EXPECT_LE(nearest_of(coarse, given[k].start), deviation);
  }
}

TEST(CoarseCurves, KeepArcsAndGaps) {
  std::vector<geometry::Piece> pieces = wavy_coast(100).loops.front().pieces;
  pieces[50].circular = true;
  pieces.erase(pieces.begin() + 20);
  const std::vector<geometry::Piece> coarse = coarse_curves(pieces, 10);
  ASSERT_EQ(coarse.size(), 4U); // up to the gap, up to the arc, the arc, the rest
  EXPECT_EQ(coarse[0].end, pieces[19].end);
  EXPECT_EQ(coarse[1].start, pieces[20].start);
  EXPECT_TRUE(coarse[2].circular);
  EXPECT_EQ(coarse[3].end, pieces.back().end);
}

TEST(BoundaryDistance, IsThatOfTheCurvesFromNearAndFar) {
  const geometry::Boundary coast = wavy_coast(20000);
  const BoundaryDistance distance(coast, "coast", Images({{0, 0}, {1, 1}}, 0, 0));
  const std::vector<geometry::Piece>& pieces = coast.loops.front().pieces;
  std::vector<Vec2> places;
  for (std::uint64_t k = 0; k < 100; ++k)
    places.push_back(testing::random_vec2(5, k));
  for (int k = 0; k < 100; ++k) // ever nearer to the coast
    places.push_back(pieces[static_cast<std::size_t>(197 * k)].start + std::pow(10, -0.1 * k) * Vec2{0.3, 0.2});
  places.push_back(pieces[17].start);
  for (const Vec2 p : places) {
    const double expected = nearest_of(pieces, p), tolerance = 7e-4 * expected;
    EXPECT_NEAR(distance.distance(p), expected, tolerance);
    EXPECT_NEAR(distance.distance_within(p, 1.5 * expected), expected, tolerance);
    EXPECT_EQ(distance.distance_within(p, 0.5 * expected), 0.5 * expected);
  }
}

TEST(NamedCurves, HoldTheFixedPoints) {
  shape::RegionShape square = testing::square();
  const geometry::Domain& domain = square.domain();
  EXPECT_EQ(curve_names(domain), domain.boundary().part_names);
  square.set_fixed_points({{{0.25, 0.5}, "first"}, {{0.75, 0.5}, "second"}});
  EXPECT_EQ(curve_names(domain).back(), "fixed_points");
  const BoundaryDistance distance(named_curves(domain), "fixed_points", images_of(domain));
  for (std::uint64_t k = 0; k < 100; ++k) {
    const Vec2 p = testing::random_vec2(5, k);
    const double expected = std::fmin(length(p - Vec2{0.25, 0.5}), length(p - Vec2{0.75, 0.5}));
    EXPECT_NEAR(distance.distance(p), expected, 7e-4 * expected);
  }
  EXPECT_EQ(distance.distance({0.25, 0.5}), 0);
}

} // namespace
} // namespace trime::sizing
