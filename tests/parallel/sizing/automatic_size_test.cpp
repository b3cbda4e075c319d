// SPDX-License-Identifier: BSD-3-Clause
// The automatic size field against shapes whose medial axis is known, its gradient bound, its quadtree.
#include "sizing/boundary_features.hpp"
#include "sizing/size_quadtree.hpp"
#include "support/boundary_shapes.hpp"
#include "trime/core/error.hpp"
#include "trime/core/random.hpp"
#include "trime/sizing/automatic_size.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace trime::sizing {
namespace {

using geometry::Boundary;
using geometry::Box;
using geometry::Vec2;
using testing::boundary_of;
using testing::circle_loop;
using testing::polygon_loop;

AutomaticSizeOptions options(double gradation, double feature_floor) {
  return {gradation, feature_floor, {{0, 0}, {1, 1}}, 0, 0};
}

Vec2 random_point(std::uint64_t key) {
  return {random_unit(3, RandomPurpose::test, key, 0), random_unit(3, RandomPurpose::test, key, 1)};
}

/// Boundary points, `spacing` apart.
std::vector<Vec2> dense_points(const Boundary& boundary, double spacing) {
  std::vector<Vec2> points;
  for (const geometry::Loop& loop : boundary.loops)
    for (const geometry::Piece& piece : loop.pieces) {
      const double parts = std::ceil(piece.length() / spacing);
      for (double k = 0; k < parts; ++k)
        points.push_back(piece.point(piece.length() * (k / parts)));
    }
  return points;
}

/// Compares the field with min K|x-b| + max(floor, distance to the axis) over dense boundary points, at random points.
void expect_known_field(const Boundary& boundary, const AutomaticSizeOptions& chosen,
                        const std::function<double(Vec2)>& distance_to_axis) {
  const AutomaticSize field(comm::Communicator::world(), boundary, chosen);
  std::vector<Cone> cones;
  for (const Vec2 b : dense_points(boundary, 0.2 * chosen.feature_floor))
    cones.push_back({b, std::fmax(chosen.feature_floor, distance_to_axis(b))});
  double worst = 0;
  for (std::uint64_t key = 0; key < 500; ++key) {
    const Vec2 p = random_point(key);
    double exact = 2;
    for (const Cone& cone : cones)
      exact = std::fmin(exact, cone.value(p, chosen.gradation));
    const double error = std::fabs(field.size(p) / exact - 1);
    EXPECT_LT(error, 0.05) << p.x << " " << p.y << ": " << field.size(p) << " instead of " << exact;
    worst = std::fmax(worst, error);
  }
  ::testing::Test::RecordProperty("worst_error", std::to_string(worst));
  std::printf("worst error %g, %zu bytes\n", worst, field.memory_bytes());
}

double distance(Vec2 p, Vec2 a, Vec2 b) {
  geometry::Piece piece;
  piece.start = a;
  piece.end = b;
  return piece.distance(p);
}

TEST(AutomaticSize, KnowsTheAxisOfARectangle) {
  // 0.7 by 0.3: bisectors from the corners, and a ridge between their ends.
  const Boundary boundary = boundary_of({polygon_loop({{0.15, 0.35}, {0.85, 0.35}, {0.85, 0.65}, {0.15, 0.65}})});
  const auto axis = [](Vec2 b) {
    const Vec2 left{0.3, 0.5}, right{0.7, 0.5};
    return std::min({distance(b, left, right), distance(b, left, {0.15, 0.35}), distance(b, left, {0.15, 0.65}),
                     distance(b, right, {0.85, 0.35}), distance(b, right, {0.85, 0.65})});
  };
  for (const double gradation : {0.1, 0.5, 2.0})
    expect_known_field(boundary, options(gradation, 0.01), axis);
}

TEST(AutomaticSize, KnowsTheAxisOfAnAnnulus) {
  // The circle half way; in the hole the centre, which no boundary point is nearer to.
  const Boundary boundary = boundary_of({circle_loop({0.5, 0.5}, 0.4), circle_loop({0.5, 0.5}, 0.3, true)});
  for (const double gradation : {0.1, 0.5})
    expect_known_field(boundary, options(gradation, 0.01), [](Vec2) { return 0.05; });
}

TEST(AutomaticSize, IsTheRadiusOnADisc) {
  const AutomaticSize field(comm::Communicator::world(), boundary_of({circle_loop({0.5, 0.5}, 0.25)}),
                            options(0.2, 0.01));
  EXPECT_NEAR(field.size({0.5, 0.5}), 0.25 + 0.2 * 0.25, 0.05 * 0.3);
  EXPECT_NEAR(field.size({0.75, 0.5}), 0.25, 0.05 * 0.25);
}

} // namespace
} // namespace trime::sizing
