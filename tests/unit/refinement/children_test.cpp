// SPDX-License-Identifier: BSD-3-Clause
// The four triangles that replace one: which edge is taken inside, and what lies across each half of an edge.
#include "refinement/children.hpp"

#include "geometry/predicates.hpp"

#include <gtest/gtest.h>

#include <map>

namespace trime::refinement {
namespace {

using geometry::Vec2;

const geometry::Lattice lattice(geometry::unit_square);

Children divided(Vec2 a, Vec2 b, Vec2 c) {
  return {{a, b, c}, {0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)}, lattice};
}

/// Each inner edge has two triangles, each half of an edge one, and `across` names its third vertex.
void expect_consistent(const Children& children) {
  std::map<std::pair<int, int>, int> third;
  for (const auto& [a, b, c] : children.triangles()) {
    EXPECT_GT(geometry::orient2d(children.at(a), children.at(b), children.at(c)), 0);
    EXPECT_TRUE(third.emplace(std::pair(a, b), c).second);
    EXPECT_TRUE(third.emplace(std::pair(b, c), a).second);
    EXPECT_TRUE(third.emplace(std::pair(c, a), b).second);
  }
  for (const auto& [a, b] : children.inner_edges()) {
    EXPECT_TRUE(third.contains({a, b})) << a << " " << b;
    EXPECT_TRUE(third.contains({b, a})) << a << " " << b;
  }
  for (int edge = 0; edge < 3; ++edge) {
    EXPECT_EQ(third.at({edge, 3 + edge}), children.across(edge, 0)) << edge;
    EXPECT_EQ(third.at({3 + edge, (edge + 1) % 3}), children.across(edge, 1)) << edge;
  }
}

TEST(Children, AreSimilarIfAllAnglesAreAcute) {
  const Children children = divided({0.25, 0.25}, {0.75, 0.25}, {0.5, 0.625});
  EXPECT_EQ(children.triangles()[3], (Children::Triangle{3, 4, 5}));
  EXPECT_TRUE(children.is_sound(lattice));
  expect_consistent(children);
}

TEST(Children, MeetAtAnObtuseCorner) {
  const std::array<Vec2, 3> p{{{0.5, 0.375}, {0.125, 0.25}, {0.875, 0.25}}}; // obtuse at the first, clockwise
  for (const auto& [a, b, c] :
       {std::array{p[0], p[1], p[2]}, std::array{p[1], p[2], p[0]}, std::array{p[2], p[0], p[1]}}) {
    const Children children = divided(a, b, c);
    EXPECT_TRUE(children.is_sound(lattice));
    int at_corner = 0;
    for (const Children::Triangle& t : children.triangles())
      for (const int code : t)
        at_corner += children.at(code) == p[0];
    EXPECT_EQ(at_corner, 2);
    expect_consistent(children);
  }
}

TEST(Children, OfARightTriangleStaySimilar) { // its two triangulations are equally good
  const Children children = divided({0.25, 0.25}, {0.75, 0.25}, {0.25, 0.5});
  EXPECT_EQ(children.triangles()[3], (Children::Triangle{3, 4, 5}));
  EXPECT_TRUE(children.is_sound(lattice));
}

TEST(Children, AreNotSoundIfAPointLiesTooFarOut) {
  const Vec2 a{0.25, 0.25}, b{0.75, 0.25}, c{0.5, 0.625};
  const Children beyond({a, b, c}, {Vec2{0.5, 0.6875}, 0.5 * (b + c), 0.5 * (c + a)}, lattice);
  EXPECT_FALSE(beyond.is_sound(lattice));
}

} // namespace
} // namespace trime::refinement
