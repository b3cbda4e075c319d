// SPDX-License-Identifier: BSD-3-Clause
// BoundaryGuard against the definitions, chord by chord.
#include "polygon/boundary_guard.hpp"
#include "support/laid_sites.hpp"

#include "core/random.hpp"
#include "geometry/predicates.hpp"
#include "polygon/rules.hpp"
#include "support/boundary_shapes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

namespace trime::polygon {
namespace {

using geometry::Segment;
using geometry::Vec2;
using sizing::UniformSize;
using testing::boundary_of;
using testing::circle_loop;
using testing::make_boundary_sites;
using testing::polygon_loop;
using testing::unit_lattice;

Vec2 random_point(std::uint64_t key) {
  return unit_lattice().snap(
      Vec2{random_unit(3, RandomPurpose::test, key, 0), random_unit(3, RandomPurpose::test, key, 1)});
}

BoundarySites star_with_hole(double h) {
  std::vector<Vec2> points;
  for (int k = 0; k < 24; ++k) {
    const SinCos direction = sin_cos(2 * pi * k / 24);
    points.push_back(Vec2{0.5, 0.5} + (k % 2 ? 0.25 : 0.45) * Vec2{direction.cos, direction.sin});
  }
  return make_boundary_sites(boundary_of({polygon_loop(points), circle_loop({0.52, 0.5}, 0.1, true)}), UniformSize(h),
                             unit_lattice(), 30);
}

BoundarySites square_sites(double h) {
  return make_boundary_sites(boundary_of({polygon_loop({{0.25, 0.25}, {0.75, 0.25}, {0.75, 0.75}, {0.25, 0.75}})}),
                             UniformSize(h), unit_lattice(), 30);
}

/// Random points all over, and points close to the chords on either side.
std::vector<Vec2> queries_for(const BoundaryGuard& guard) {
  std::vector<Vec2> queries;
  for (std::uint64_t k = 0; k < 2000; ++k)
    queries.push_back(random_point(k));
  for (const Segment& chord : guard.chords().segments())
    for (const double across : {-0.6, -0.2, -0.01, 0.01, 0.049, 0.2, 0.6})
      for (const double along : {-0.03, 0.02, 0.4, 1.01})
        queries.push_back(unit_lattice().snap(chord.a + along * (chord.b - chord.a) +
                                              across * geometry::left_normal(chord.b - chord.a)));
  return queries;
}

TEST(BoundaryGuard, AgreesWithTheDefinitionsChordByChord) {
  for (const double h : {0.3, 0.05, 0.01}) {
    const BoundaryGuard guard(star_with_hole(h), unit_lattice());
    const auto chords = guard.chords().segments();
    for (const Vec2 p : queries_for(guard)) {
      const bool inside = guard.chords().inside(p);
      bool strictly = false, closed = false, close = false;
      double nearest = 0.1;
      for (const Segment& chord : chords) {
        const int side = geometry::diametral_side(chord.a, chord.b, p);
        const double distance = std::sqrt(geometry::squared_distance(p, chord));
        strictly |= side < 0;
        closed |= side <= 0;
        close |= distance < 0.05 * geometry::length(chord.b - chord.a) * (1 - 1e-12);
        nearest = std::fmin(nearest, distance);
      }
      ASSERT_EQ(guard.inside(p), inside);
      ASSERT_EQ(guard.encroaches(p), !inside || strictly || close) << p.x << " " << p.y;
      ASSERT_EQ(guard.correct(p, h, unit_lattice()).has_value(), !inside || closed) << p.x << " " << p.y;
      ASSERT_EQ(guard.distance(p, 0.1), nearest);
    }
  }
}

TEST(BoundaryGuard, StatesCountTheCellsToTheNearestDisc) {
  const BoundaryGuard guard(star_with_hole(0.02), unit_lattice());
  const GuardCells cells = guard.cells();
  constexpr int farthest = PolygonRules::farthest_cell;
  const auto state = [&](int i, int j) { return std::abs(cells.states[j * cells.columns + i]); };
  for (int j = 0; j < cells.rows; ++j)
    for (int i = 0; i < cells.columns; ++i) {
      int nearest = farthest;
      for (int b = std::max(0, j - farthest); b <= std::min(cells.rows - 1, j + farthest); ++b)
        for (int a = std::max(0, i - farthest); a <= std::min(cells.columns - 1, i + farthest); ++a)
          if (state(a, b) == 0)
            nearest = std::min(nearest, std::max(std::abs(a - i), std::abs(b - j)));
      ASSERT_EQ(state(i, j), nearest) << i << " " << j;
    }
}

TEST(BoundaryGuard, PushesOutOfTheDiscsOfASquare) {
  const double h = 0.0625;
  const BoundaryGuard guard(square_sites(h), unit_lattice());
  for (std::uint64_t k = 0; k < 3000; ++k) {
    const Vec2 p = random_point(k);
    const auto pushed = guard.correct(p, h, unit_lattice());
    if (!pushed)
      continue;
    EXPECT_EQ(*pushed, unit_lattice().snap(*pushed));
    EXPECT_TRUE(guard.inside(*pushed)) << p.x << " " << p.y;
    EXPECT_FALSE(guard.correct(*pushed, h, unit_lattice()).has_value()) << p.x << " " << p.y;
  }
}

TEST(BoundaryGuard, PushGoesTowardsThePointOrAlongTheNormal) {
  const BoundaryGuard guard(square_sites(0.125), unit_lattice());
  // The chord from (0.5, 0.25) to (0.625, 0.25).
  const Vec2 middle{0.5625, 0.25};
  const auto up = guard.correct(unit_lattice().snap(middle + Vec2{0.01, 0.02}), 0.125, unit_lattice());
  ASSERT_TRUE(up.has_value());
  const Vec2 direction = *up - middle;
  EXPECT_NEAR(geometry::length(direction), 0.075, 1e-12);
  EXPECT_NEAR(direction.y, 2 * direction.x, 1e-12);
  const Vec2 normal = unit_lattice().snap(middle + Vec2{0, 0.075});
  EXPECT_EQ(guard.correct(unit_lattice().snap(middle + Vec2{0.03, 0.001}), 0.125, unit_lattice()), normal);
  EXPECT_EQ(guard.correct(unit_lattice().snap(middle - Vec2{0.03, 0.001}), 0.125, unit_lattice()), normal);
  EXPECT_EQ(guard.correct(middle, 0.125, unit_lattice()), normal);
  EXPECT_EQ(guard.correct(Vec2{0.5625, -3}, 0.125, unit_lattice()), normal);
}

TEST(BoundaryGuard, PushesOffAHoleInward) {
  const BoundarySites sites =
      make_boundary_sites(boundary_of({polygon_loop({{0.1, 0.1}, {0.9, 0.1}, {0.9, 0.9}, {0.1, 0.9}}),
                                       circle_loop({0.5, 0.5}, 0.2, true, 4, 2)}),
                          UniformSize(0.02), unit_lattice(), 30);
  const BoundaryGuard guard(sites, unit_lattice());
  for (int k = 0; k < 200; ++k) {
    const SinCos direction = sin_cos(2 * pi * k / 200);
    for (const double r : {0.0, 0.15, 0.199, 0.201}) {
      const Vec2 p = unit_lattice().snap(Vec2{0.5, 0.5} + r * Vec2{direction.cos, direction.sin});
      const auto pushed = guard.correct(p, 0.02, unit_lattice());
      if (!pushed) { // between two discs
        EXPECT_GT(r, 0.2);
        continue;
      }
      EXPECT_GT(geometry::length(*pushed - Vec2{0.5, 0.5}), 0.205);
      EXPECT_FALSE(guard.encroaches(*pushed));
    }
  }
}

TEST(BoundaryGuard, ThreePushesAreEnoughForMost) {
  const BoundaryGuard guard(star_with_hole(0.02), unit_lattice());
  int pushed = 0, lost = 0;
  for (std::uint64_t k = 0; k < 5000; ++k) {
    std::optional<Vec2> p = random_point(k);
    if (!guard.inside(*p) || !guard.encroaches(*p))
      continue;
    ++pushed;
    Vec2 last = *p;
    for (int push = 0; push < 3 && p; ++push)
      if ((p = guard.correct(last, 0.02, unit_lattice())))
        last = *p;
    lost += guard.correct(last, 0.02, unit_lattice()).has_value();
  }
  EXPECT_GT(pushed, 200);
  EXPECT_LT(lost, pushed / 5); // in the tips of the star and where the hole is near its notches
}

TEST(BoundaryGuard, UnequalChordsAndMemory) {
  // A coarse square with a finely divided tiny hole.
  const BoundarySites sites =
      make_boundary_sites(boundary_of({polygon_loop({{0.1, 0.1}, {0.9, 0.1}, {0.9, 0.9}, {0.1, 0.9}}),
                                       circle_loop({0.3, 0.4}, 1e-5, true)}),
                          UniformSize(0.1), unit_lattice(), 30);
  const BoundaryGuard guard(sites, unit_lattice());
  EXPECT_FALSE(guard.inside(unit_lattice().snap(Vec2{0.3, 0.4})));
  EXPECT_TRUE(guard.inside(unit_lattice().snap(Vec2{0.3, 0.4 + 2e-5})));
  EXPECT_FALSE(guard.encroaches(unit_lattice().snap(Vec2{0.3, 0.4 + 3e-5})));
  EXPECT_TRUE(guard.encroaches(unit_lattice().snap(Vec2{0.3, 0.4 + 1.01e-5})));
  EXPECT_LT(guard.memory_bytes(), 1000000u);
  EXPECT_GT(guard.memory_bytes(), sites.sites.size() * sizeof(Segment));
}

} // namespace
} // namespace trime::polygon
