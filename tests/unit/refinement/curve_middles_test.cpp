// SPDX-License-Identifier: BSD-3-Clause
// The middle of the curve between two boundary points: arcs, corners, the start of a loop, periodic containers, and
// curves that do not belong to the edge. Also edges that cross.
#include "refinement/curve_middles.hpp"

#include "core/angle.hpp"
#include "refinement/facet_crossings.hpp"
#include "support/plain_shapes.hpp"
#include "trime/shape/part.hpp"
#include "trime/shape/region_shape.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace trime::refinement {
namespace {

using geometry::Vec2;

/// The boundary of one part.
geometry::Boundary boundary_of(shape::Part part, const geometry::Frame& frame) {
  const std::string name = part.name();
  std::vector<shape::Part> parts;
  parts.push_back(std::move(part));
  return shape::domain_of(std::move(parts), name, frame).boundary();
}

const geometry::Frame plane(geometry::unit_square);

TEST(CurveMiddles, LieOnACircleAtHalfTheAngle) {
  const geometry::Boundary disc = boundary_of(shape::Part::circle("disc", {0.5, 0.5}, 0.375, plane), plane);
  const CurveMiddles middles(disc, 1);
  const auto at_angle = [](double angle) { return Vec2{0.5, 0.5} + 0.375 * Vec2{std::cos(angle), std::sin(angle)}; };
  for (int k = 0; k < 100; ++k) { // also across the starts of all pieces
    const double from = 0.0631 * k, to = from + 0.1 + 0.003 * k;
    const auto found = middles.middle(at_angle(from), at_angle(to), 0);
    ASSERT_TRUE(found) << k;
    EXPECT_TRUE(found->is_on_curve);
    EXPECT_LT(geometry::length(found->place - at_angle(0.5 * (from + to))), 1e-12) << k;
  }
}

TEST(CurveMiddles, GoAroundACornerThatTheEdgePasses) {
  const geometry::Boundary square =
      boundary_of(shape::Part::rectangle("square", {{0.25, 0.25}, {0.75, 0.75}}, plane), plane);
  const auto found = CurveMiddles(square, 1).middle({0.7, 0.25}, {0.75, 0.32}, 0);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->place.x, 0.75, 1e-14);
  EXPECT_NEAR(found->place.y, 0.26, 1e-14);
}

TEST(CurveMiddles, AreUnknownOffTheCurveAndWhereItDoesNotBelongToTheEdge) {
  const geometry::Boundary square =
      boundary_of(shape::Part::rectangle("square", {{0.25, 0.25}, {0.75, 0.75}}, plane), plane);
  const CurveMiddles middles(square, 1);
  EXPECT_FALSE(middles.middle({0.3, 0.26}, {0.4, 0.25}, 0));   // an end lies off it
  EXPECT_FALSE(middles.middle({0.3, 0.25}, {0.4, 0.25}, 1));   // another part
  EXPECT_FALSE(middles.middle({0.4, 0.25}, {0.3, 0.25}, 0));   // backwards: all around
  EXPECT_FALSE(middles.middle({0.45, 0.25}, {0.45, 0.75}, 0)); // far around
}

TEST(CurveMiddles, KeepTheDistanceOfEndsNearTheCurve) {
  const geometry::Boundary square =
      boundary_of(shape::Part::rectangle("square", {{0.25, 0.25}, {0.75, 0.75}}, plane), plane);
  const auto found = CurveMiddles(square, 1).middle({0.3, 0.25 - 0x1p-12}, {0.4, 0.25 - 0x1p-11}, 0);
  ASSERT_TRUE(found);
  EXPECT_FALSE(found->is_on_curve);
  EXPECT_NEAR(found->place.x, 0.35, 1e-12);
  EXPECT_NEAR(found->place.y, 0.25 - 1.5 * 0x1p-12, 1e-12);
}

TEST(CurveMiddles, CrossTheBorderOfAPeriodicContainer) {
  const geometry::Frame torus(geometry::unit_square, true, true);
  const geometry::Boundary disc = boundary_of(shape::Part::circle("disc", {0.98, 0.5}, 0.25, torus), torus);
  const CurveMiddles middles(disc, 1);
  for (const double x : {-1.0, 0.0, 1.0}) {
    const auto at_angle = [x](double angle) {
      return Vec2{0.98 + x, 0.5} + 0.25 * Vec2{std::cos(angle), std::sin(angle)};
    };
    const auto found = middles.middle(at_angle(-0.1), at_angle(0.2), 0);
    ASSERT_TRUE(found) << x;
    EXPECT_LT(geometry::length(found->place - at_angle(0.05)), 1e-12) << x;
  }
}

TEST(FacetCrossings, FindThoseThatCrossOrTouchOthers) {
  using geometry::Segment;
  const std::vector<Segment> all{{{0.1, 0.1}, {0.3, 0.1}},  {{0.3, 0.1}, {0.3, 0.3}}, // a corner
                                 {{0.2, 0.05}, {0.2, 0.2}},                           // crosses the first
                                 {{0.4, 0.1}, {0.6, 0.1}},  {{0.7, 0.1}, {0.8, 0.1}}, // in line with it
                                 {{0.3, 0.2}, {0.5, 0.2}}};                           // touches the second
  EXPECT_EQ(crossing(all, all, plane.periods()), (std::vector<std::size_t>{0, 1, 2, 5}));
  const geometry::Frame torus(geometry::unit_square, true, false);
  const std::vector<Segment> around{{{0.9, 0.5}, {1.1, 0.5}}, {{0.05, 0.4}, {0.05, 0.6}}, {{0.5, 0.4}, {0.5, 0.6}}};
  EXPECT_EQ(crossing(around, around, torus.periods()), (std::vector<std::size_t>{0, 1}));
  EXPECT_TRUE(crossing(around, around, plane.periods()).empty());
}

} // namespace
} // namespace trime::refinement
