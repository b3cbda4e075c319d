// SPDX-License-Identifier: BSD-3-Clause
// Shapes as a whole: distance, names, and the contours of the shared data where they are present.
#include "trime/geometry/region_shape.hpp"

#include "trime/core/error.hpp"
#include "trime/core/timer.hpp"
#include "unit/geometry/boundary_checks.hpp"

#include <cstdlib>
#include <filesystem>
#include <set>

namespace trime::geometry {
namespace {

const Frame unit_frame(Box{{0, 0}, {1, 1}});

/// Path of a file of the shared data; empty if it is not there.
std::string shared_data(const std::string& name) {
  const char* given = std::getenv("TRIME_SHARED_DATA");
  const std::filesystem::path folder = given != nullptr
                                           ? std::filesystem::path(given)
                                           : std::filesystem::path(__FILE__).parent_path() / "../../../../shared/data";
  return std::filesystem::exists(folder / name) ? (folder / name).string() : std::string();
}

Part normalized(const std::string& name, const std::string& path) {
  const Contour contour = read_xy(path);
  return Part::contour(name, contour, fit_to_container(contour, unit_frame.container()), unit_frame);
}

TEST(Shape, DistanceAgainstBruteForce) {
  const RegionShape shape({Part::rectangle("r", {{0.1, 0.1}, {0.9, 0.9}}, unit_frame),
                           Part::circle("c", {0.5, 0.5}, 0.2, unit_frame),
                           Part::circle("d", {0.9, 0.9}, 0.3, unit_frame),
                           Part::triangle("t", {{{0.05, 0.05}, {0.3, 0.1}, {0.1, 0.3}}}, unit_frame)},
                          "difference(r, c, d, t)", unit_frame);
  for (int i = 0; i < 5000; ++i) {
    const Vec2 p = random_point(i, {{-0.5, -0.5}, {1.5, 1.5}}, unit_frame);
    const double expected = distance_by_brute_force(shape.boundary(), p);
    ASSERT_NEAR(shape.distance_to_boundary(p), expected, 1e-15);
    ASSERT_EQ(std::signbit(shape.signed_distance(p)), shape.inside(p));
  }
  for (const Loop& loop : shape.boundary().loops)
    for (const Piece& piece : loop.pieces) {
      EXPECT_LT(shape.distance_to_boundary(piece.start), 1e-15);
      EXPECT_LT(shape.distance_to_boundary(piece.point(0.3 * piece.length())), 1e-15);
    }
  EXPECT_NEAR(shape.signed_distance({0.5, 0.6}), 0.1, 1e-12); // within the hole
}

TEST(Shape, NamesMustDifferAndNotBeDomain) {
  const auto error = [](const char* a, const char* b) {
    return message_of<ConfigError>([&] {
      RegionShape({Part::circle(a, {0.5, 0.5}, 0.2, unit_frame), Part::circle(b, {0.5, 0.5}, 0.1, unit_frame)}, a,
                  unit_frame);
    });
  };
  EXPECT_NE(error("a", "a").find("'a'"), std::string::npos);
  EXPECT_NE(error("a", "domain").find("'domain'"), std::string::npos);
  EXPECT_EQ(error("a", "b"), "");
}

TEST(Shape, ShiftedAndLargeContainers) {
  for (const double origin : {0.0, 1000.0, -1e6}) {
    const Frame frame(Box{{origin, origin}, {origin + 8, origin + 4}});
    const RegionShape shape({Part::rectangle("r", {{origin + 1, origin + 1}, {origin + 7, origin + 3}}, frame),
                             Part::circle("c", {origin + 4, origin + 2}, 1.5, frame)},
                            "difference(r, c)", frame);
    expect_inside_on_left(shape);
    EXPECT_EQ(shape.boundary().components(), 2) << origin;
    const double half = std::asin(1 / 1.5);
    const double cut = 2 * 1.5 * 1.5 * half + 2 * std::cos(half) * 1.5;
    EXPECT_NEAR(shape.boundary().area, 12 - cut, 1e-8) << origin;
  }
}

TEST(Shape, PokerMinusCircle) {
  const std::string path = shared_data("poker.xy");
  if (path.empty())
    GTEST_SKIP() << "the shared data are not here; set TRIME_SHARED_DATA";
  const RegionShape shape({normalized("poker", path), Part::circle("hole", {0.5, 0.7}, 0.1, unit_frame)},
                          "difference(poker, hole)", unit_frame);
  expect_valid(shape.boundary());
  expect_inside_on_left(shape);
  EXPECT_EQ(shape.boundary().components(), 1);
  EXPECT_EQ(shape.boundary().holes(), 1);
  const double scale = 0.8 / 0.9412;
  EXPECT_NEAR(shape.boundary().area, 0.458595 * scale * scale - 0.01 * 3.14159265358979, 1e-5);
}

TEST(Shape, NorthAmerica) {
  const std::string path = shared_data("north_america.xy");
  if (path.empty())
    GTEST_SKIP() << "the shared data are not here; set TRIME_SHARED_DATA";
  const double start = wall_seconds();
  const Contour contour = read_xy(path);
  const Normalization fit = fit_to_container(contour, unit_frame.container());
  const RegionShape shape({Part::contour("map", contour, fit, unit_frame)}, "map", unit_frame);
  EXPECT_LT(wall_seconds() - start, 1);
  expect_valid(shape.boundary());
  expect_inside_on_left(shape);
  EXPECT_EQ(shape.boundary().components(), 1);
  EXPECT_EQ(shape.boundary().holes(), 8);
  EXPECT_NEAR(shape.boundary().area, 0.23731, 1e-5);
  EXPECT_NEAR(shape.boundary().length(), 7.717, 1e-3);
  std::set<std::pair<double, double>> ends;
  for (const Loop& loop : shape.boundary().loops)
    for (const Piece& piece : loop.pieces)
      ends.insert({piece.start.x, piece.start.y});
  EXPECT_EQ(ends.size(), 4833u);
  for (const ContourRing& ring : contour.rings)
    for (const Vec2 p : ring.points) {
      const Vec2 q = unit_frame.snap(fit.apply(p));
      ASSERT_EQ(ends.count({q.x, q.y}), 1u);
    }
  for (int i = 0; i < 300; ++i) {
    const Vec2 p = random_point(i, {{0, 0}, {1, 1}}, unit_frame);
    ASSERT_NEAR(shape.distance_to_boundary(p), distance_by_brute_force(shape.boundary(), p), 1e-15);
  }
}

} // namespace
} // namespace trime::geometry
