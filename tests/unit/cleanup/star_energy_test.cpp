// SPDX-License-Identifier: BSD-3-Clause
// The energy that the moves of the clean-up lower, against differences and closed forms.
#include "cleanup/patch_mover.hpp"

#include "support/point_sets.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace trime::cleanup {
namespace {

using geometry::Vec2;

std::vector<Vec2> hexagon(double radius = 1, Vec2 center = {}) {
  std::vector<Vec2> ring;
  for (int k = 0; k < 6; ++k) {
    const SinCos turn = sin_cos(pi * k / 3);
    ring.push_back(center + radius * Vec2{turn.cos, turn.sin});
  }
  return ring;
}

/// Rings of 3 to 8 corners about the origin, closed and open ones.
struct Star {
  Vec2 p;
  std::vector<Vec2> ring;
  bool closed;
};
std::vector<Star> stars() {
  std::vector<Star> all;
  for (std::uint64_t k = 0; k < 24; ++k) {
    const int corners = 3 + static_cast<int>(k % 6);
    Star star{0.1 * (testing::random_vec2(7, k) - Vec2{0.5, 0.5}), {}, k % 2 == 0};
    for (int j = 0; j < corners; ++j) {
      const Vec2 u = testing::random_vec2(8 + k, static_cast<std::uint64_t>(j));
      const SinCos turn = sin_cos((star.closed ? 2 : 1) * pi * (j + 0.3 * u.x) / corners);
      star.ring.push_back((0.7 + 0.6 * u.y) * Vec2{turn.cos, turn.sin});
    }
    if (std::isfinite(star_energy(star.p, star.ring, star.closed)))
      all.push_back(star);
  }
  EXPECT_GT(all.size(), 15u);
  return all;
}

/// One of the angles of the star is steep: the apex of a right-angled triangle, and places around it.
TEST(SteepEnergy, GradientIsThatOfTheDifferences) {
  const std::vector<Vec2> ring{{1, 0}, {0.9, 1.1}, {0, 1}, {-1, 0.1}};
  int steep = 0;
  for (std::uint64_t k = 0; k < 40; ++k) {
    const Vec2 p = 0.2 * (testing::random_vec2(11, k) - Vec2{0.5, 0.5}) + Vec2{0, -0.1};
    const auto energy = [&](double x, double y) { return steep_energy(p + Vec2{x, y}, ring, false); };
    EnergyModel model;
    add_steep_energy(model, p, ring, false);
    constexpr double d = 1e-6;
    EXPECT_EQ(model.value, energy(0, 0));
    EXPECT_NEAR(model.gradient.x, (energy(d, 0) - energy(-d, 0)) / (2 * d), 1e-4 * (1 + model.xx));
    EXPECT_NEAR(model.gradient.y, (energy(0, d) - energy(0, -d)) / (2 * d), 1e-4 * (1 + model.yy));
    EXPECT_GE(model.xx, 0);
    EXPECT_GE(model.xx * model.yy - model.xy * model.xy, -1e-9 * model.xx * model.yy) << "the convex part alone";
    steep += model.value > 0;
  }
  EXPECT_GT(steep, 5);
}

TEST(SteepEnergy, IsThatOfTheAnglesAboveItsLimitAlone) {
  EXPECT_EQ(steep_energy({}, hexagon(), true), 0);
  const std::vector<Vec2> legs{{1, 0}, {0, 1}}; // a right angle at the origin: its cotangent is 0
  EXPECT_NEAR(steep_energy({}, legs, false), CleanupRules::steep_weight * std::pow(CleanupRules::steep_cotangent, 2),
              1e-15);
  const std::vector<Vec2> diagonal{{1, 1}, {-1, 1}};
  EXPECT_GT(steep_energy({0, 0.1}, diagonal, false), steep_energy({0, 0}, diagonal, false)) << "nearer is more obtuse";
  EXPECT_EQ(steep_energy({0, -0.1}, diagonal, false), 0) << "84.6 degrees";
}

TEST(StarEnergy, DerivativesAreThoseOfTheDifferences) {
  for (const Star& star : stars()) {
    const auto energy = [&](double x, double y) { return star_energy(star.p + Vec2{x, y}, star.ring, star.closed); };
    const auto slope = [&](double x, double y) {
      return star_energy_model(star.p + Vec2{x, y}, star.ring, star.closed).gradient;
    };
    const EnergyModel model = star_energy_model(star.p, star.ring, star.closed);
    constexpr double d = 1e-5;
    const double scale = 1 + std::fabs(model.xx) + std::fabs(model.yy);
    EXPECT_NEAR(model.value, energy(0, 0), 1e-12 * (1 + model.value));
    EXPECT_NEAR(model.gradient.x, (energy(d, 0) - energy(-d, 0)) / (2 * d), 1e-5 * scale);
    EXPECT_NEAR(model.gradient.y, (energy(0, d) - energy(0, -d)) / (2 * d), 1e-5 * scale);
    EXPECT_NEAR(model.xx, (slope(d, 0).x - slope(-d, 0).x) / (2 * d), 1e-5 * scale);
    EXPECT_NEAR(model.yy, (slope(0, d).y - slope(0, -d).y) / (2 * d), 1e-5 * scale);
    EXPECT_NEAR(model.xy, (slope(d, 0).y - slope(-d, 0).y) / (2 * d), 1e-5 * scale);
    EXPECT_NEAR(model.xy, (slope(0, d).x - slope(0, -d).x) / (2 * d), 1e-5 * scale);
  }
}

TEST(StarEnergy, EquilateralTrianglesHaveNone) {
  for (const double radius : {1e-3, 1.0, 1e3})
    EXPECT_LT(star_energy({5, 7}, hexagon(radius, {5, 7}), true), 1e-30);
  const EnergyModel model = star_energy_model({}, hexagon(), true);
  EXPECT_LT(geometry::length(model.gradient), 1e-30);
  for (std::uint64_t k = 0; k < 20; ++k)
    EXPECT_GT(star_energy(0.3 * (testing::random_vec2(4, k) - Vec2{0.5, 0.5}), hexagon(), true), 1e-20);
  // Half of a right-angled square: (1 + 1 + 2) / (4 sqrt(3) / 2) = 2 / sqrt(3)
  const std::vector<Vec2> legs{{1, 0}, {0, 1}};
  const double excess = 2 / std::sqrt(3.0) - 1;
  EXPECT_NEAR(star_energy({}, legs, false), std::pow(excess, 2) + 10 * std::pow(excess, 4), 1e-15);
}

TEST(StarEnergy, IsFreeOfScaleAndOfPlace) {
  for (const Star& star : stars()) {
    std::vector<Vec2> moved;
    for (const Vec2 q : star.ring)
      moved.push_back(64 * q + Vec2{3, -2});
    const double energy = star_energy(star.p, star.ring, star.closed);
    EXPECT_NEAR(star_energy(64 * star.p + Vec2{3, -2}, moved, star.closed), energy, 1e-9 * energy + 1e-18);
  }
}

TEST(StarEnergy, WhatIsTurnedOverOrFlatIsForbidden) {
  EXPECT_EQ(star_energy({2, 0}, hexagon(), true), INFINITY);
  EXPECT_EQ(star_energy({1, 0}, hexagon(), true), INFINITY) << "on a neighbour";
  const std::vector<Vec2> diamond{{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  EXPECT_EQ(star_energy({0.5, 0.5}, diamond, true), INFINITY) << "on an edge of the ring";
  const std::vector<Vec2> row{{1, 0}, {0, 0}, {-1, 0}};
  EXPECT_EQ(star_energy({0, 0}, row, false), INFINITY);
  EXPECT_EQ(star_energy({0.5, 0}, row, false), INFINITY);
}

TEST(StarEnergy, AnOpenFanDoesNotCloseItself) {
  const std::vector<Vec2> ring = hexagon();
  const std::vector<Vec2> half(ring.begin(), ring.begin() + 4); // three equilateral triangles above a straight side
  EXPECT_LT(star_energy({}, half, false), 1e-30);
  EXPECT_EQ(star_energy({}, half, true), INFINITY) << "the side itself is no triangle";
  EXPECT_GT(star_energy({0.1, 0}, half, false), 1e-9);
}

TEST(StarEnergy, TheStepIsBoundedAndLeadsDown) {
  for (const Star& star : stars())
    for (const double limit : {1e-3, 0.02, 0.25}) {
      const EnergyModel model = star_energy_model(star.p, star.ring, star.closed);
      const Vec2 step = newton_step(model, limit);
      EXPECT_LE(geometry::length(step), limit * (1 + 1e-12));
      EXPECT_LT(geometry::dot(step, model.gradient), 0);
      Vec2 tried = step;
      for (int halving = 0; halving < 8 && !(star_energy(star.p + tried, star.ring, star.closed) < model.value);
           ++halving)
        tried = 0.5 * tried;
      EXPECT_LT(star_energy(star.p + tried, star.ring, star.closed), model.value);
    }
}

TEST(StarEnergy, StepsLeadADisplacedCentreBack) {
  Vec2 p{0.3, 0.2};
  for (int step = 0; step < 60; ++step)
    p = p + newton_step(star_energy_model(p, hexagon(), true), 0.25);
  EXPECT_LT(geometry::length(p), 1e-3); // the fourth power is flat: a third less in each step
}

TEST(StarEnergy, TheStepOfAnyModelIsFiniteAndBounded) {
  const auto step_of = [](double gx, double gy, double xx, double xy, double yy) {
    EnergyModel model;
    model.gradient = {gx, gy};
    model.xx = xx;
    model.xy = xy;
    model.yy = yy;
    return newton_step(model, 0.5);
  };
  const auto expect_near = [](Vec2 step, Vec2 expected) { EXPECT_LT(geometry::length(step - expected), 1e-15); };
  EXPECT_EQ(step_of(0, 0, 0, 0, 0), Vec2{});
  EXPECT_EQ(step_of(0, 0, 2, 0, 3), Vec2{});
  EXPECT_EQ(step_of(1, 0, 4, 0, 4), (Vec2{-0.25, 0}));
  expect_near(step_of(3, 4, 0, 0, 0), {-0.3, -0.4});   // no curvature: down the gradient, as far as allowed
  expect_near(step_of(3, 4, -1, 0, -1), {-0.3, -0.4}); // a hill
  expect_near(step_of(3, 4, 1, 2, 1), {-0.3, -0.4});   // a saddle
  EXPECT_NEAR(geometry::length(step_of(1e100, 1e-100, 1e-3, 0, 1e-3)), 0.5, 1e-12);
  EXPECT_LE(geometry::length(step_of(1e-300, 0, 0, 0, 0)), 0.5);
}

} // namespace
} // namespace trime::cleanup
