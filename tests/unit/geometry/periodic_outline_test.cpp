// SPDX-License-Identifier: BSD-3-Clause
// Areas of periodic containers whose borders cross the sides or wind around the container.
#include "geometry/periodic_outline.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace trime::geometry {
namespace {

std::vector<Segment> closed(const std::vector<Vec2>& vertices) {
  std::vector<Segment> border;
  for (std::size_t k = 0; k < vertices.size(); ++k)
    border.push_back({vertices[k], vertices[(k + 1) % vertices.size()]});
  return border;
}

bool is_in_rectangle(Vec2 p, const Box& box) {
  for (const double x : {-1.0, 0.0, 1.0})
    for (const double y : {-1.0, 0.0, 1.0})
      if (box.contains(p + Vec2{x, y}))
        return true;
  return false;
}

/// Compares the outline with a rectangle and its images at places off the border.
void expect_rectangle(const PeriodicOutline& outline, const Box& box, bool is_inside) {
  for (int i = 0; i < 16; ++i)
    for (int j = 0; j < 16; ++j) {
      const Vec2 p{(i + 0.5) / 16, (j + 0.5) / 16};
      EXPECT_EQ(outline.inside(p), is_in_rectangle(p, box) == is_inside) << p.x << ", " << p.y;
    }
}

const Frame torus(unit_square, true, true);

TEST(PeriodicOutline, KnowsWhichSideOfARingIsInside) {
  for (const Vec2 low : {Vec2{0.25, 0.25}, Vec2{0.75, 0.25}, Vec2{-0.25, -0.25}, Vec2{0.75, 0.75}}) {
    const Box box{low, low + Vec2{0.5, 0.375}};
    const std::vector<Vec2> ring{box.min, {box.max.x, box.min.y}, box.max, {box.min.x, box.max.y}};
    expect_rectangle({closed(ring), torus.periods(), torus.lattice()}, box, true);
    expect_rectangle({closed({ring.rbegin(), ring.rend()}), torus.periods(), torus.lattice()}, box, false);
  }
}

TEST(PeriodicOutline, MayWindAroundTheContainer) {
  const Box box{{0.25, 0}, {0.625, 1}}; // its sides go up on the right and down on the left
  const std::vector<Segment> border{{{0.625, 0}, {0.625, 0.5}},
                                    {{0.625, 0.5}, {0.625, 1}},
                                    {{0.25, 0.75}, {0.25, 0.25}},
                                    {{0.25, 1.25}, {0.25, 0.75}}};
  const PeriodicOutline outline(border, torus.periods(), torus.lattice());
  expect_rectangle(outline, box, true);
  EXPECT_TRUE(outline.is_within({0.25, 0.125}, 1e-9));
  EXPECT_TRUE(outline.is_within({0.65, 0.99}, 0.1));
  EXPECT_FALSE(outline.is_within({0.45, 0.5}, 0.1));
}

TEST(PeriodicOutline, HasABoxIfItsAreaIsBounded) {
  const std::vector<Vec2> ring{{0.25, 0.25}, {0.5, 0.25}, {0.5, 0.5}, {0.25, 0.5}};
  const Box inside = PeriodicOutline(closed(ring), torus.periods(), torus.lattice()).box();
  EXPECT_EQ(inside.min, (Vec2{0.25, 0.25}));
  EXPECT_EQ(inside.max, (Vec2{0.5, 0.5}));
  const PeriodicOutline around(closed({ring.rbegin(), ring.rend()}), torus.periods(), torus.lattice());
  EXPECT_GT(around.box().min.x, around.box().max.x); // may be everywhere
}

} // namespace
} // namespace trime::geometry
