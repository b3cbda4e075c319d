// SPDX-License-Identifier: BSD-3-Clause
// The search for the place where the worst triangle of a star is best.
#include "meshing/cleanup.hpp"
#include "trime/core/angle.hpp"
#include "trime/mesh/quality.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace trime::meshing {
namespace {

using geometry::Vec2;

std::vector<Vec2> hexagon() {
  std::vector<Vec2> ring;
  for (int k = 0; k < 6; ++k) {
    const SinCos direction = sin_cos(k * pi / 3);
    ring.push_back({direction.cos, direction.sin});
  }
  return ring;
}

double worst(Vec2 p, const std::vector<Vec2>& ring) {
  double alpha = 1;
  for (std::size_t k = 0; k < ring.size(); ++k)
    alpha = std::max(alpha, mesh::aspect_ratio(p, ring[k], ring[(k + 1) % ring.size()]));
  return alpha;
}

TEST(MaxMinPlace, FindsTheMiddleOfAHexagon) {
  for (const Vec2 from : {Vec2{0.4, 0.1}, Vec2{-0.3, -0.5}, Vec2{0, 0.02}})
    EXPECT_LT(geometry::length(max_min_place(from, hexagon(), 1)), 0.02);
  EXPECT_EQ(max_min_place({0, 0}, hexagon(), 1), (Vec2{0, 0}));
}

TEST(MaxMinPlace, NeverMakesTheWorstTriangleWorse) {
  std::vector<Vec2> ring = hexagon();
  ring[2] = {-0.2, 0.5};
  ring.push_back({0.9, -0.3});
  for (const Vec2 from : {Vec2{0.1, 0.1}, Vec2{0, -0.4}, Vec2{-0.5, -0.1}}) {
    const Vec2 place = max_min_place(from, ring, 1);
    EXPECT_LE(worst(place, ring), worst(from, ring));
    EXPECT_GE(worst(place, ring), 1);
  }
}

TEST(MaxMinPlace, ASiteOutsideOfItsStarFindsItsWayOrStays) {
  const Vec2 from{1.5, 0}; // triangles are turned over: infinitely bad
  const Vec2 place = max_min_place(from, hexagon(), 1);
  EXPECT_TRUE(place == from || worst(place, hexagon()) < 10);
}

} // namespace
} // namespace trime::meshing
