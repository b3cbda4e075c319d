// SPDX-License-Identifier: BSD-3-Clause
// Single parts: inside and distance against brute force, orientation, and what a bad part says.
#include "trime/shape/part.hpp"

#include "core/angle.hpp"
#include "geometry/predicates.hpp"
#include "trime/core/error.hpp"
#include "unit/shape/boundary_checks.hpp"

namespace trime::shape {
namespace {

using geometry::Box;
using geometry::Frame;
using geometry::left_normal;
using geometry::length;
using geometry::Loop;
using geometry::orient2d;
using geometry::Piece;
using geometry::Vec2;

const Frame unit_frame(Box{{0, 0}, {1, 1}});

/// Star-shaped ring with n vertices around c, radii between r/2 and r.
std::vector<Vec2> star_ring(int n, Vec2 c, double r, int seed) {
  std::vector<Vec2> ring;
  for (int k = 0; k < n; ++k) {
    const double angle = 2 * pi * k / n, radius = r * (0.5 + 0.5 * random(1000 * seed + k, 7));
    ring.push_back({c.x + radius * std::cos(angle), c.y + radius * std::sin(angle)});
  }
  return ring;
}

/// Even-odd rule, exact, edge by edge; for points that are on no edge.
bool inside_by_brute_force(const std::vector<Loop>& loops, Vec2 p) {
  bool inside = false;
  for (const Loop& loop : loops)
    for (const Piece& e : loop.pieces)
      if ((e.start.y > p.y) != (e.end.y > p.y))
        inside ^= (orient2d(e.start, e.end, p) > 0) == (e.end.y > e.start.y);
  return inside;
}

Part star_with_holes(int n, int seed) {
  const contours::Contour contour =
      contours::make_contour({star_ring(n, {0.5, 0.5}, 0.45, seed), star_ring(n / 2, {0.5, 0.5}, 0.2, seed + 1),
                              star_ring(7, {0.5, 0.5}, 0.08, seed + 2)},
                             "star");
  return Part::contour("star", contour, {}, unit_frame);
}

TEST(Part, InsideAndDistanceOfPolygonsWithHolesAgainstBruteForce) {
  for (int seed = 10; seed < 40; seed += 10) {
    const Part part = star_with_holes(20 * seed, seed);
    const std::vector<Loop> loops = part.boundary();
    for (int i = 0; i < 2000; ++i) {
      const Vec2 p = random_point(i, {{0, 0}, {1, 1}}, unit_frame);
      double best = 1e300;
      for (const Loop& loop : loops)
        for (const Piece& piece : loop.pieces)
          best = std::min(best, piece.distance(p));
      ASSERT_EQ(part.inside(p), inside_by_brute_force(loops, p));
      ASSERT_NEAR(part.distance(p), best, 1e-15);
    }
  }
}

TEST(Part, QueriesOnVerticesAndBesideEdges) {
  const Part part = star_with_holes(60, 5);
  for (const Loop& loop : part.boundary())
    for (const Piece& e : loop.pieces) {
      EXPECT_EQ(part.distance(e.start), 0);
      const Vec2 middle = unit_frame.snap(e.start + 0.5 * (e.end - e.start));
      EXPECT_LE(part.distance(middle), unit_frame.step());
      const Vec2 normal = left_normal(e.tangent(0));
      for (const double offset : {1e-12, 1e-6}) {
        EXPECT_TRUE(part.inside(unit_frame.snap(middle + offset * normal)));
        EXPECT_FALSE(part.inside(unit_frame.snap(middle - offset * normal)));
      }
      // On the level of a vertex, where a careless ray would count it twice or never.
      for (const double x : {0.0, 0.01, 0.99})
        EXPECT_EQ(part.inside({unit_frame.lattice().snap(x), e.start.y}), false);
    }
}

TEST(Part, CircleIsExact) {
  const Part part = Part::circle("c", {0.5, 0.5}, 0.25, unit_frame);
  const double step = unit_frame.step();
  EXPECT_TRUE(part.inside({0.75 - step, 0.5}));
  EXPECT_FALSE(part.inside({0.75, 0.5}));
  // 3-4-5: the point (0.65, 0.7) scaled to exact numbers.
  EXPECT_FALSE(part.inside({0.5 + 0.15625 * 0.96, 0.9})); // far outside
  const Vec2 on{0.5 + 0x1p-2 * 3 / 5, 0.5 + 0x1p-2 * 4 / 5};
  const Vec2 near = unit_frame.snap(on);
  EXPECT_TRUE(part.inside(near - Vec2{step, step}));
  EXPECT_FALSE(part.inside(near + Vec2{step, step}));
  for (int i = 0; i < 1000; ++i) {
    const Vec2 p = random_point(i, {{0, 0}, {1, 1}}, unit_frame);
    const double r = length(p - Vec2{0.5, 0.5});
    EXPECT_EQ(part.inside(p), r < 0.25);
    EXPECT_NEAR(part.distance(p), std::fabs(r - 0.25), 1e-15);
  }
}

TEST(Part, TrianglesInBothOrientationsAreTheSame) {
  const Vec2 a{0.1, 0.1}, b{0.3, 0.8}, c{0.8, 0.5};
  const std::array<Vec2, 3> orders[] = {{a, b, c}, {a, c, b}, {c, b, a}};
  for (const auto& corners : orders) {
    const RegionShape shape({Part::triangle("t", corners, unit_frame)}, "t", unit_frame);
    expect_valid(shape.boundary());
    expect_inside_on_left(shape);
    EXPECT_NEAR(shape.boundary().area, 0.5 * (0.7 * 0.7 - 0.2 * 0.4), 1e-12);
    EXPECT_EQ(shape.boundary().components(), 1);
    EXPECT_EQ(shape.boundary().holes(), 0);
  }
}

TEST(Part, RectangleStartsLowerLeftCounterClockwise) {
  const Loop loop = Part::rectangle("r", {{0.25, 0.5}, {0.75, 0.875}}, unit_frame).boundary()[0];
  EXPECT_EQ(loop.pieces[0].start, (Vec2{0.25, 0.5}));
  EXPECT_EQ(loop.pieces[0].end, (Vec2{0.75, 0.5}));
  EXPECT_EQ(loop.pieces[1].end, (Vec2{0.75, 0.875}));
  EXPECT_TRUE(loop.outer);
}

TEST(Part, BadPartsSayWhatIsWrong) {
  const double nan = std::nan("");
  const auto error = [](const auto& make) { return message_of<GeometryError>(make); };
  const std::pair<std::string, const char*> cases[] = {
      {error([] {
         Part::triangle("t", {{{0, 0}, {0.5, 0.5}, {0.25, 0.25}}}, unit_frame);
       }),
       "one line"},
      {error([] {
         Part::rectangle("t", {{0.5, 0}, {0.5, 1}}, unit_frame);
       }),
       "x_min < x_max"},
      {error([] {
         Part::rectangle("t", {{0.5, 0}, {0.2, 1}}, unit_frame);
       }),
       "[0.5, 0.2]"},
      {error([] {
         Part::circle("t", {0.5, 0.5}, 0, unit_frame);
       }),
       "radius"},
      {error([] {
         Part::circle("t", {0.5, 0.5}, -1, unit_frame);
       }),
       "-1"},
      {error([&] {
         Part::circle("t", {0.5, 0.5}, nan, unit_frame);
       }),
       "nan"},
      {error([&] {
         Part::circle("t", {nan, 0.5}, 0.1, unit_frame);
       }),
       "nan"},
      {error([] {
         Part::circle("t", {0.5, 0.5}, 50, unit_frame);
       }),
       "twice the container"},
      {error([] {
         Part::rectangle("t", {{0, 0}, {1, 7}}, unit_frame);
       }),
       "(1, 7)"},
  };
  for (const auto& [message, expected] : cases) {
    EXPECT_NE(message.find("'t'"), std::string::npos) << message;
    EXPECT_NE(message.find(expected), std::string::npos) << message;
  }
}

TEST(Frame, RoundingDoesNotLeaveTheContainer) {
  const Frame frame(Box{{0.1, -0.3}, {0.7, 1.1}});
  const Box& box = frame.container();
  for (const Vec2 p : {box.min, box.max, Vec2{box.min.x, box.max.y}})
    EXPECT_TRUE(box.contains(frame.snap(p)));
  const RegionShape shape({Part::rectangle("r", box, frame)}, "intersection(r, domain)", frame);
  EXPECT_TRUE(box.contains(shape.boundary().bounding_box().min));
  EXPECT_TRUE(box.contains(shape.boundary().bounding_box().max));
  EXPECT_NEAR(shape.boundary().area, 0.6 * 1.4, 1e-12);
}

} // namespace
} // namespace trime::shape
