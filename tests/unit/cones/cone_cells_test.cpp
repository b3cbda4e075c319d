// SPDX-License-Identifier: BSD-3-Clause
#include "cones/cone_cells.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace trime::cones {
namespace {

using geometry::Vec2;

constexpr double slope = 0.2;

/// Along a circle, of sizes that differ by so much.
std::vector<Cone> ring_of_cones(int n, double spread) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(0, 1);
  std::vector<Cone> cones;
  for (int k = 0; k < n; ++k) {
    const double angle = 2 * std::acos(-1.0) * k / n;
    cones.push_back({{0.5 + 0.3 * std::cos(angle), 0.4 + 0.3 * std::sin(angle)}, 0.002 + spread * share(random)});
  }
  return cones;
}

void expect_equal(const std::vector<Cone>& cones) {
  const ConeTree tree(cones, slope);
  const ConeCells cells(tree, slope);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-0.1, 1.1), bound(0.001, 0.1);
  for (int k = 0; k < 20000; ++k) {
    Vec2 p{place(random), place(random)};
    if (k % 2 == 0 && !cones.empty()) // near a cone
      p = cones[static_cast<std::size_t>(k) % cones.size()].apex + 0.02 * (p - Vec2{0.5, 0.5});
    const double most = k % 3 == 0 ? std::numeric_limits<double>::infinity() : bound(random);
    EXPECT_EQ(cells.value(p, most), tree.value(p, most)) << p.x << ' ' << p.y << ' ' << most;
  }
}

TEST(ConeCells, GiveWhatTheTreeGives) {
  for (const int n : {0, 1, 2, 7, 300, 2000})
    expect_equal(ring_of_cones(n, 0.004));
}

TEST(ConeCells, ManyConesOfOneHeightMeetInTheMiddleOfARing) {
  expect_equal(ring_of_cones(500, 0));
}

TEST(ConeCells, ConesAtOnePlaceAndOnALine) {
  expect_equal(std::vector<Cone>(20, {{0.3, 0.4}, 0.01}));
  std::vector<Cone> line;
  for (int k = 0; k < 100; ++k)
    line.push_back({{0.01 * k, 0.5}, 0.002 + 0.001 * (k % 7)});
  expect_equal(line);
}

TEST(ConeCells, DoNotDivideWithoutEndWhereNoConeIsTheLowest) {
  std::vector<Cone> clusters;
  for (const Cone& cone : ring_of_cones(100, 0))
    for (int k = 0; k < 13; ++k)
      clusters.push_back({cone.apex + Vec2{1e-10 * k, 0}, 1e-6});
  expect_equal(clusters);
  std::vector<Cone> equal = ring_of_cones(1000, 0);
  for (Cone& cone : equal)
    cone.height = 1e-4;
  const ConeTree tree(equal, 0);
  EXPECT_EQ(ConeCells(tree, 0).value({0.5, 0.4}, 1), 1e-4); // took minutes
}

TEST(ConeCells, AskTheTreeOutside) {
  const ConeTree tree(ring_of_cones(100, 0.004), slope);
  const ConeCells cells(tree, slope);
  for (const Vec2 p : {Vec2{-3, 0.5}, Vec2{1e300, 1e300}, Vec2{0.5, 7}})
    EXPECT_EQ(cells.value(p, 1e3), tree.value(p, 1e3));
}

} // namespace
} // namespace trime::cones
