// SPDX-License-Identifier: BSD-3-Clause
// Regions without area: bands around a periodic container whose two sides lie on each other.
#include "shape/boundary_area.hpp"

#include "trime/core/error.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace trime::shape {
namespace {

using geometry::Boundary;
using geometry::Box;
using geometry::Frame;
using geometry::Loop;
using geometry::Piece;
using geometry::Vec2;

const Frame cylinder(Box{{0, 0}, {1, 1}}, true, false);

Piece segment(Vec2 a, Vec2 b) {
  Piece piece;
  piece.start = a;
  piece.end = b;
  return piece;
}

/// A loop around the cylinder, to the right or to the left.
Loop around(double y, bool to_the_right) {
  Loop loop;
  const double left = 0, right = 1;
  loop.pieces = {to_the_right ? segment({left, y}, {right, y}) : segment({right, y}, {left, y})};
  loop.winding = {to_the_right ? 1.0 : -1.0, 0};
  return loop;
}

/// So many steps of the lattice wide.
Boundary band(double steps) {
  Boundary boundary;
  boundary.periods = cylinder.periods();
  boundary.loops = {around(0.5, true), around(0.5 + steps * cylinder.step(), false)};
  boundary.area = steps * cylinder.step();
  return boundary;
}

TEST(BoundaryArea, BandsOfAFewStepsAreRefusedWithThePlace) {
  for (const double steps : {0.0, 1.0, 7.0})
    try {
      check_area(band(steps), "a - b", cylinder);
      FAIL() << steps << " steps";
    } catch (const GeometryError& error) {
      const std::string text = error.what();
      for (const char* word : {"'a - b'", "thinner than the resolution", "length 2", "(0, 0.5)"})
        EXPECT_NE(text.find(word), std::string::npos) << word << ": " << text;
    }
}

TEST(BoundaryArea, WiderBandsAreNot) {
  EXPECT_NO_THROW(check_area(band(20), "a", cylinder));
}

TEST(BoundaryArea, AnAreaThatIsNoNumberIsRefused) {
  Boundary boundary = band(20);
  boundary.area = NAN;
  EXPECT_THROW(check_area(boundary, "a", cylinder), GeometryError);
}

TEST(BoundaryArea, ClosedLoopsAreSliversWindingOnesAreNot) {
  Loop closed;
  const double y = 0.5 + 4 * cylinder.step();
  closed.pieces = {segment({0.2, 0.5}, {0.4, 0.5}), segment({0.4, 0.5}, {0.4, y}), segment({0.4, y}, {0.2, 0.5})};
  const double twice = twice_area_under(closed.pieces, closed.pieces[0].start);
  EXPECT_NEAR(twice, 0.8 * cylinder.step(), 1e-3 * cylinder.step());
  EXPECT_TRUE(is_sliver(closed, twice, cylinder));
  EXPECT_FALSE(is_sliver(closed, 0.1, cylinder));
  EXPECT_FALSE(is_sliver(around(0.5, true), 0, cylinder));
}

} // namespace
} // namespace trime::shape
