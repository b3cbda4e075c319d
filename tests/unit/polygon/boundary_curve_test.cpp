// SPDX-License-Identifier: BSD-3-Clause
// Places on the boundary by arc length.
#include "polygon/boundary_chain.hpp"

#include "polygon/chord_curve.hpp"
#include "support/boundary_shapes.hpp"
#include "support/laid_sites.hpp"
#include "support/periodic_shapes.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace trime::polygon {
namespace {

using geometry::Boundary;
using geometry::Vec2;
using testing::boundary_of;
using testing::circle_loop;
using testing::polygon_loop;

Boundary square_and_hole() {
  return boundary_of(
      {polygon_loop({{0.1, 0.1}, {0.9, 0.1}, {0.9, 0.9}, {0.1, 0.9}}), circle_loop({0.5, 0.5}, 0.2, true, 4, 2)});
}

void expect_near(Vec2 a, Vec2 b, double tolerance = 1e-12) {
  EXPECT_LT(geometry::length(a - b), tolerance) << a.x << " " << a.y << " and " << b.x << " " << b.y;
}

TEST(BoundaryCurve, FindsThePlaceOfAnArcAndBack) {
  const Boundary boundary = square_and_hole();
  const BoundaryCurve curve(boundary);
  EXPECT_NEAR(curve.length(0), 3.2, 1e-12);
  EXPECT_NEAR(curve.length(1), 2 * pi * 0.2, 1e-12);
  for (const LocalIndex loop : {0, 1}) {
    const double length = curve.length(loop);
    for (int k = -40; k < 80; ++k) {
      const double arc = length * (k + 0.3) / 40;
      const BoundaryCurve::CurvePlace place = curve.place(loop, arc);
      BoundarySite site{};
      site.piece = place.piece;
      site.along = place.along;
      const double turns = std::floor(arc / length);
      EXPECT_NEAR(curve.arc(loop, site) + turns * length, arc, 1e-12);
      EXPECT_NEAR(geometry::length(place.tangent), 1, 1e-12);
      const Vec2 ahead = curve.place(loop, arc + 1e-7).point;
      expect_near((1e7) * (ahead - place.point), place.tangent, 1e-5);
      if (loop == 1) {
        EXPECT_NEAR(geometry::length(place.point - Vec2{0.5, 0.5}), 0.2, 1e-12);
      }
    }
  }
  expect_near(curve.place(0, 0).point, {0.1, 0.1});
  expect_near(curve.place(0, 0.8).point, {0.9, 0.1});
  expect_near(curve.place(0, 1.0).point, {0.9, 0.3});
  expect_near(curve.place(0, -0.2).point, {0.1, 0.3});
  expect_near(curve.place(0, curve.length(0)).point, {0.1, 0.1});
  expect_near(curve.place(0, curve.length(0) + 0.2).point, {0.3, 0.1});
  expect_near(curve.place(1, 0.5 * pi * 0.2).point, {0.5, 0.3}); // clockwise around the hole
}

/// Of lengths from 1e-7 to 0.8, many in one part of the loop: at junctions, just before and behind them.
TEST(BoundaryCurve, FindsThePlaceAmongPiecesOfVeryDifferentLengths) {
  std::vector<Vec2> corners{{0.1, 0.1}, {0.9, 0.1}, {0.9, 0.9}};
  for (int k = 0; k < 40; ++k) // a zigzag that becomes finer and finer
    corners.push_back({0.8 * std::pow(0.7, k) + 0.1, k % 2 ? 0.9 : 0.9 - 0.1 * std::pow(0.7, k)});
  const Boundary boundary = boundary_of({polygon_loop(corners)});
  const BoundaryCurve curve(boundary);
  const std::vector<geometry::Piece>& pieces = boundary.loops[0].pieces;
  double start = 0;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    EXPECT_EQ(curve.place(0, start).piece, static_cast<LocalIndex>(k));
    EXPECT_EQ(curve.place(0, start).along, 0);
    EXPECT_EQ(curve.place(0, std::nextafter(start, 10)).piece, static_cast<LocalIndex>(k));
    if (k > 0) {
      EXPECT_EQ(curve.place(0, std::nextafter(start, 0)).piece, static_cast<LocalIndex>(k) - 1);
    }
    EXPECT_EQ(curve.place(0, start + 0.5 * pieces[k].length()).piece, static_cast<LocalIndex>(k));
    start += pieces[k].length();
  }
  EXPECT_EQ(curve.place(0, std::nextafter(start, 0)).piece, static_cast<LocalIndex>(pieces.size()) - 1);
  EXPECT_EQ(curve.place(0, start).piece, 0) << "the end is the start";
}

TEST(BoundaryCurve, ALoopThatWindsGoesOnInTheNextImage) {
  const shape::RegionShape shape = testing::band();
  const BoundaryCurve curve(shape.boundary());
  for (LocalIndex loop = 0; loop < 2; ++loop) {
    const Vec2 winding = shape.boundary().loops[static_cast<std::size_t>(loop)].winding;
    const double length = curve.length(loop);
    EXPECT_NEAR(length, 1, 1e-12);
    expect_near(curve.place(loop, length + 0.25).point, curve.place(loop, 0.25).point + winding);
    expect_near(curve.place(loop, -0.25).point, curve.place(loop, 0.75).point - winding);
  }
}

} // namespace
} // namespace trime::polygon
