// SPDX-License-Identifier: BSD-3-Clause
// The automatic size field against shapes whose medial axis is known, on periodic containers, and with bad input.
#include "core/random.hpp"
#include "support/boundary_shapes.hpp"
#include "trime/core/error.hpp"
#include "trime/sizing/automatic_size.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace trime::sizing {
namespace {

using geometry::Boundary;
using geometry::Loop;
using geometry::Piece;
using geometry::Vec2;
using testing::boundary_of;
using testing::circle_loop;
using testing::polygon_loop;

AutomaticSizeOptions options(double gradation, double feature_floor) {
  return {gradation, feature_floor, {{0, 0}, {1, 1}}, 0, 0};
}

AutomaticSize make(const Boundary& boundary, const AutomaticSizeOptions& chosen) {
  return AutomaticSize(comm::Communicator::world(), boundary, chosen);
}

Vec2 random_point(std::uint64_t key) {
  return {random_unit(3, RandomPurpose::test, key, 0), random_unit(3, RandomPurpose::test, key, 1)};
}

Loop rectangle(double x_min, double y_min, double x_max, double y_max) {
  return polygon_loop({{x_min, y_min}, {x_max, y_min}, {x_max, y_max}, {x_min, y_max}});
}

double distance(Vec2 p, Vec2 a, Vec2 b) {
  Piece piece;
  piece.start = a;
  piece.end = b;
  return piece.distance(p);
}

/// Compares the field with min K|x - b| + max(floor, distance from b to the axis) over dense boundary points b.
void expect_known_field(const Boundary& boundary, const AutomaticSizeOptions& chosen,
                        const std::function<double(Vec2)>& distance_to_axis) {
  struct Feature {
    Vec2 point;
    double size;
  };
  std::vector<Feature> features;
  for (const Loop& loop : boundary.loops)
    for (const Piece& piece : loop.pieces) {
      const double parts = std::ceil(piece.length() / (0.2 * chosen.feature_floor));
      for (double k = 0; k < parts; ++k) {
        const Vec2 b = piece.point(piece.length() * (k / parts));
        features.push_back({b, std::fmax(chosen.feature_floor, distance_to_axis(b))});
      }
    }
  const AutomaticSize field = make(boundary, chosen);
  for (std::uint64_t key = 0; key < 300; ++key) {
    const Vec2 p = random_point(key);
    double exact = 2;
    for (const Feature& feature : features)
      exact = std::fmin(exact, chosen.gradation * length(p - feature.point) + feature.size);
    EXPECT_NEAR(field.size(p) / exact, 1, 0.05) << p.x << " " << p.y << " gradation " << chosen.gradation;
  }
}

TEST(AutomaticSize, KnowsTheAxisOfARectangle) {
  // Bisectors from the corners, and a ridge between their ends.
  const auto axis = [](Vec2 b) {
    const Vec2 left{0.3, 0.5}, right{0.7, 0.5};
    return std::min({distance(b, left, right), distance(b, left, {0.15, 0.35}), distance(b, left, {0.15, 0.65}),
                     distance(b, right, {0.85, 0.35}), distance(b, right, {0.85, 0.65})});
  };
  for (const double gradation : {0.1, 0.5, 2.0})
    expect_known_field(boundary_of({rectangle(0.15, 0.35, 0.85, 0.65)}), options(gradation, 0.01), axis);
}

TEST(AutomaticSize, KnowsTheAxisOfAnAnnulus) {
  // The circle half way between; the centre is farther away than that from both circles.
  const Boundary boundary = boundary_of({circle_loop({0.5, 0.5}, 0.4), circle_loop({0.5, 0.5}, 0.3, true)});
  for (const double gradation : {0.1, 0.5})
    expect_known_field(boundary, options(gradation, 0.01), [](Vec2) { return 0.05; });
}

/// Discs with radius 0.2 around (0.25, 0.5) and (0.75, 0.5), joined by a channel of half width 0.04.
Boundary dumbbell() {
  const double radius = 0.2, half = 0.04, along = std::sqrt(radius * radius - half * half);
  const Vec2 left{0.25, 0.5}, right{0.75, 0.5};
  const auto segment = [](Vec2 a, Vec2 b) {
    Piece piece;
    piece.start = a;
    piece.end = b;
    return piece;
  };
  const auto arc = [&](Vec2 center, Vec2 a, Vec2 b) {
    Piece piece = segment(a, b);
    piece.circular = true;
    piece.center = center;
    piece.radius = radius;
    piece.start_angle = angle_of(a.y - center.y, a.x - center.x);
    piece.sweep = 2 * (pi - angle_of(half, along));
    return piece;
  };
  const Vec2 a = left + Vec2{along, half}, b = left + Vec2{along, -half};
  const Vec2 c = right + Vec2{-along, -half}, d = right + Vec2{-along, half};
  Loop loop;
  loop.pieces = {arc(left, a, b), segment(b, c), arc(right, c, d), segment(d, a)};
  return boundary_of({loop});
}

TEST(AutomaticSize, KnowsTheAxisOfTwoDiscsJoinedByAChannel) {
  // Inside: the line between the centres. Outside: parabolas between channel and discs (2 (R - w) (y - y0) =
  // (x - x0)^2 - (R - w)^2, from the corners) that meet in the middle and go on straight.
  std::vector<Vec2> outside;
  const double step = 0.001;
  for (double x = std::sqrt(0.04 - 0.0016); x <= 0.25; x += step)
    for (const double side : {-1.0, 1.0})
      for (const double y : {-1.0, 1.0})
        outside.push_back({0.5 + side * (0.25 - x), 0.5 + y * (x * x - 0.0256) / 0.32});
  for (double y = (0.0625 - 0.0256) / 0.32; y < 0.5; y += step)
    for (const double side : {-1.0, 1.0})
      outside.push_back({0.5, 0.5 + side * y});
  const auto axis = [&](Vec2 b) {
    double nearest = distance(b, {0.25, 0.5}, {0.75, 0.5});
    for (const Vec2 p : outside)
      nearest = std::fmin(nearest, length(p - b));
    return nearest;
  };
  for (const double gradation : {0.1, 0.5})
    expect_known_field(dumbbell(), options(gradation, 0.01), axis);
}

TEST(AutomaticSize, IsTheRadiusOnADiscEvenOfManySegments) {
  const auto polygon = [](int n) {
    std::vector<Vec2> points;
    for (int k = 0; k < n; ++k) {
      const SinCos direction = sin_cos(2 * pi * k / n);
      points.push_back(Vec2{0.5, 0.5} + 0.25 * Vec2{direction.cos, direction.sin});
    }
    return polygon_loop(points);
  };
  for (const Loop& loop : {circle_loop({0.5, 0.5}, 0.25), polygon(200), polygon(20000)}) {
    const AutomaticSize field = make(boundary_of({loop}), options(0.2, 0.001));
    EXPECT_NEAR(field.size({0.5, 0.5}), 0.25 + 0.2 * 0.25, 0.05 * 0.3);
    EXPECT_NEAR(field.size({0.75, 0.5}), 0.25, 0.05 * 0.25);
    EXPECT_GT(field.least(), 0.95 * 0.25);
    EXPECT_LT(field.largest(), 1.05 * (0.25 + 0.2 * (std::sqrt(0.5) - 0.25)));
    EXPECT_LT(field.memory_bytes(), 1000000u);
  }
}

TEST(AutomaticSize, IsNeverBelowTheFeatureFloor) {
  // Two rectangles 0.001 apart.
  const Boundary boundary = boundary_of({rectangle(0.1, 0.2, 0.4, 0.8), rectangle(0.401, 0.2, 0.8, 0.8)});
  const AutomaticSize field = make(boundary, options(0.2, 0.01));
  EXPECT_GE(field.least(), 0.01);
  EXPECT_NEAR(field.least(), 0.01, 1e-4);
  EXPECT_NEAR(field.size({0.4, 0.5}), 0.01, 2e-4);
  EXPECT_NEAR(field.size({0.3, 0.5}), 0.01 + 0.2 * 0.1, 5e-4);
}

TEST(AutomaticSize, SeesAcrossAPeriodicBorder) {
  // The ends of the rectangle are 0.04 from each other across the border; without it, the bisectors of its corners are
  // the nearest of the axis.
  const Boundary boundary = boundary_of({rectangle(0.02, 0.3, 0.98, 0.7)});
  AutomaticSizeOptions chosen = options(1, 0.005);
  EXPECT_NEAR(make(boundary, chosen).size({0.02, 0.5}), 0.2 * std::sqrt(0.5), 0.01);
  chosen.period_x = 1;
  const AutomaticSize field = make(boundary, chosen);
  EXPECT_NEAR(field.size({0.02, 0.5}), 0.02, 0.001);
  EXPECT_NEAR(field.size({0.98, 0.5}), 0.02, 0.001);
  EXPECT_NEAR(field.size({0, 0.5}), 0.04, 0.002);
  EXPECT_NEAR(field.size({-0.02, 0.5}), 0.02, 0.001);
  EXPECT_NEAR(field.size({5.02, 0.5}), 0.02, 0.001);
}

TEST(AutomaticSize, DoesNotDependOnWhereATorusIsCut) {
  AutomaticSizeOptions chosen = options(0.3, 0.005);
  chosen.period_x = chosen.period_y = 1;
  const auto shape = [](Vec2 shift) {
    return boundary_of(
        {circle_loop(Vec2{0.5, 0.5} + shift, 0.3, false, 3), circle_loop(Vec2{0.6, 0.5} + shift, 0.1, true, 3)});
  };
  const AutomaticSize inside = make(shape({0, 0}), chosen), across = make(shape({0.5, -0.5}), chosen);
  for (std::uint64_t key = 0; key < 300; ++key) {
    const Vec2 p = random_point(key);
    EXPECT_NEAR(across.size(p + Vec2{0.5, -0.5}) / inside.size(p), 1, 0.02) << p.x << " " << p.y;
  }
}

TEST(AutomaticSize, IsUniformWithoutGradationOrBoundary) {
  const comm::Communicator comm = comm::Communicator::world();
  const Boundary disc = boundary_of({circle_loop({0.5, 0.5}, 0.25)});
  EXPECT_TRUE(make_automatic_size(comm, disc, options(0, 0.01))->is_uniform());
  EXPECT_TRUE(make_automatic_size(comm, boundary_of({}), options(0.1, 0.01))->is_uniform());
  EXPECT_FALSE(make_automatic_size(comm, disc, options(0.1, 0.01))->is_uniform());
}

TEST(AutomaticSize, RefusesOptionsWithoutMeaning) {
  const comm::Communicator comm = comm::Communicator::world();
  const Boundary disc = boundary_of({circle_loop({0.5, 0.5}, 0.25)});
  EXPECT_THROW(make_automatic_size(comm, disc, options(-0.1, 0.01)), ConfigError);
  EXPECT_THROW(make_automatic_size(comm, disc, options(std::nan(""), 0.01)), ConfigError);
  EXPECT_THROW(make_automatic_size(comm, disc, options(0.1, 0)), ConfigError);
  AutomaticSizeOptions flat = options(0.1, 0.01);
  flat.container.max.y = 0;
  EXPECT_THROW(make_automatic_size(comm, disc, flat), ConfigError);
}

} // namespace
} // namespace trime::sizing
