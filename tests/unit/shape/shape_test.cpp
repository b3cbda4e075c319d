// SPDX-License-Identifier: BSD-3-Clause
// Shapes as a whole: distance, names, and contours with sharp tips, many vertices and holes.
#include "trime/shape/region_shape.hpp"

#include "core/angle.hpp"
#include "support/temporary_directory.hpp"
#include "trime/core/error.hpp"
#include "unit/shape/boundary_checks.hpp"

#include <fmt/format.h>

#include <fstream>
#include <set>
#include <tuple>
#include <vector>

namespace trime::shape {
namespace {

using geometry::Box;
using geometry::cross;
using geometry::Frame;
using geometry::length;
using geometry::Loop;
using geometry::Piece;
using geometry::Vec2;

const Frame unit_frame(Box{{0, 0}, {1, 1}});

/// Path of a file of configs/.
std::string config_file(const std::string& name) {
  return TRIME_CONFIGS "/" + name;
}

Part normalized(const std::string& name, const std::string& path) {
  const contours::Contour contour = contours::read_contour(path);
  return Part::contour(name, contour, contours::fit_to_container(contour, unit_frame.container()), unit_frame);
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

/// The ring with each segment broken `levels` times at a random place beside its middle, at most an eighth of its
/// length off: ragged at every scale, and what comes of a segment stays in a flat triangle on it, so that nothing
/// crosses.
std::vector<Vec2> ragged(std::vector<Vec2> ring, int levels) {
  for (int level = 0; level < levels; ++level) {
    std::vector<Vec2> finer;
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Vec2 a = ring[k], along = ring[(k + 1) % ring.size()] - a;
      const double aside = 0.25 * (random(k, level) - 0.5);
      finer.push_back(a);
      finer.push_back(a + 0.5 * along + aside * left_normal(along));
    }
    ring = std::move(finer);
  }
  return ring;
}

/// A regular hexagon.
std::vector<Vec2> hexagon(Vec2 center, double radius) {
  std::vector<Vec2> ring;
  for (int k = 0; k < 6; ++k)
    ring.push_back(center + radius * Vec2{std::cos(pi / 3 * k), std::sin(pi / 3 * k)});
  return ring;
}

double area_of(const std::vector<Vec2>& ring) {
  double twice = 0;
  for (std::size_t k = 0; k < ring.size(); ++k)
    twice += cross(ring[k], ring[(k + 1) % ring.size()]);
  return 0.5 * twice;
}

double length_of(const std::vector<Vec2>& ring) {
  double sum = 0;
  for (std::size_t k = 0; k < ring.size(); ++k)
    sum += length(ring[(k + 1) % ring.size()] - ring[k]);
  return sum;
}

TEST(Shape, SpadeMinusCircle) {
  const std::string path = config_file("spade.xy");
  const contours::Contour contour = contours::read_contour(path);
  const double scale = contours::fit_to_container(contour, unit_frame.container()).scale;
  const RegionShape shape({normalized("spade", path), Part::circle("hole", {0.5, 0.6}, 0.1, unit_frame)},
                          "difference(spade, hole)", unit_frame);
  expect_valid(shape.boundary());
  expect_inside_on_left(shape);
  EXPECT_EQ(shape.boundary().components(), 1);
  EXPECT_EQ(shape.boundary().holes(), 1);
  ASSERT_EQ(contour.rings.size(), 1u);
  EXPECT_NEAR(shape.boundary().area, area_of(contour.rings[0].points) * scale * scale - 0.01 * pi, 1e-12);
}

TEST(Shape, RaggedContourWithManyVerticesAndLakes) {
  std::vector<std::vector<Vec2>> rings{ragged(hexagon({0, 0}, 10), 9)};
  for (const auto& [center, radius, levels] : {std::tuple{Vec2{-3, 2}, 2.0, 7}, std::tuple{Vec2{3, 1}, 1.0, 6},
                                               std::tuple{Vec2{0, -4}, 0.3, 5}, std::tuple{Vec2{1, 4}, 0.05, 3}})
    rings.push_back(ragged(hexagon(center, radius), levels));
  const test::TemporaryDirectory directory;
  const std::string path = directory.path() + "/ragged.xy";
  std::ofstream file(path);
  for (const std::vector<Vec2>& ring : rings) {
    for (const Vec2 p : ring)
      file << fmt::format("{} {}\n", p.x, p.y);
    file << "\n";
  }
  file.close();
  const contours::Contour contour = contours::read_contour(path);
  ASSERT_EQ(contour.rings.size(), rings.size());
  const contours::Normalization fit = contours::fit_to_container(contour, unit_frame.container());
  const RegionShape shape({Part::contour("map", contour, fit, unit_frame)}, "map", unit_frame);
  expect_valid(shape.boundary());
  expect_inside_on_left(shape);
  EXPECT_EQ(shape.boundary().components(), 1);
  EXPECT_EQ(shape.boundary().holes(), 4);
  double area = 2 * area_of(rings[0]), boundary_length = 0;
  std::size_t vertices = 0;
  for (const std::vector<Vec2>& ring : rings) {
    area -= area_of(ring);
    boundary_length += length_of(ring);
    vertices += ring.size();
  }
  EXPECT_GT(vertices, 4000u);
  EXPECT_NEAR(shape.boundary().area, area * fit.scale * fit.scale, 1e-11);
  EXPECT_NEAR(shape.boundary().length(), boundary_length * fit.scale, 1e-9);
  std::set<std::pair<double, double>> ends;
  for (const Loop& loop : shape.boundary().loops)
    for (const Piece& piece : loop.pieces)
      ends.insert({piece.start.x, piece.start.y});
  EXPECT_EQ(ends.size(), vertices);
  for (const contours::ContourRing& ring : contour.rings)
    for (const Vec2 p : ring.points) {
      const Vec2 q = unit_frame.snap(fit.apply(p));
      ASSERT_EQ(ends.count({q.x, q.y}), 1u);
    }
  for (int i = 0; i < 300; ++i) {
    const Vec2 p = random_point(i, {{0, 0}, {1, 1}}, unit_frame);
    ASSERT_NEAR(shape.distance_to_boundary(p), distance_by_brute_force(shape.boundary(), p), 1e-15);
  }
}

void expect_same_boundary(const std::vector<Part>& parts, const std::string& region, const Frame& frame) {
  const RegionShape shape(parts, region, frame);
  const geometry::Domain alone = domain_of(parts, region, frame);
  EXPECT_EQ(alone.part_markers(), shape.domain().part_markers());
  EXPECT_EQ(alone.boundary().part_names, shape.boundary().part_names);
  EXPECT_EQ(alone.boundary().area, shape.boundary().area);
  ASSERT_EQ(alone.boundary().loops.size(), shape.boundary().loops.size());
  for (std::size_t k = 0; k < alone.boundary().loops.size(); ++k) {
    const Loop &a = alone.boundary().loops[k], &b = shape.boundary().loops[k];
    ASSERT_EQ(a.pieces.size(), b.pieces.size());
    for (std::size_t i = 0; i < a.pieces.size(); ++i) {
      const Piece &p = a.pieces[i], &q = b.pieces[i];
      EXPECT_EQ(std::tie(p.start, p.end, p.circular, p.center, p.radius, p.start_angle, p.sweep, p.corner, p.part),
                std::tie(q.start, q.end, q.circular, q.center, q.radius, q.start_angle, q.sweep, q.corner, q.part));
    }
  }
}

TEST(Shape, TheBoundaryAloneIsThatOfTheShape) {
  const contours::Contour marked = contours::parse_poly("4 2 0 0\n1 0.2 0.2\n2 0.8 0.2\n3 0.8 0.8\n4 0.2 0.8\n"
                                                        "4 1\n1 1 2 7\n2 2 3 0\n3 3 4 8\n4 4 1 7\n0\n",
                                                        "s.poly");
  const contours::Contour plain = contours::parse_xy("0.2 0.2\n0.8 0.2\n0.8 0.8\n0.2 0.8\n", "s.xy");
  const Frame torus(Box{{0, 0}, {1, 1}}, true, true);
  for (const Frame& frame : {unit_frame, torus})
    for (const contours::Contour& contour : {marked, plain}) {
      const std::vector<Part> parts{Part::contour("s", contour, {}, frame), Part::circle("c", {0.8, 0.5}, 0.1, frame)};
      expect_same_boundary(parts, "difference(s, c)", frame);
      expect_same_boundary(parts, "difference(domain, s, c)", frame);
    }
  EXPECT_THROW(domain_of({}, "s", unit_frame), ConfigError);
}

} // namespace
} // namespace trime::shape
