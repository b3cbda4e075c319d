// SPDX-License-Identifier: BSD-3-Clause
// Pieces and loops by themselves.
#include "core/angle.hpp"
#include "trime/geometry/vec2.hpp"
#include "unit/shape/boundary_checks.hpp"

namespace trime::geometry {
namespace {

using shape::Part;
using shape::random;
using shape::RegionShape;

const Frame unit_frame(Box{{0, 0}, {1, 1}});

Piece arc(double from, double sweep) {
  Piece piece;
  piece.circular = true;
  piece.center = {0.3, 0.4};
  piece.radius = 0.25;
  piece.start_angle = from;
  piece.sweep = sweep;
  const auto at = [&](double a) { return piece.center + piece.radius * Vec2{std::cos(a), std::sin(a)}; };
  piece.start = at(from);
  piece.end = at(from + sweep);
  return piece;
}

TEST(Piece, DistanceToArcsEqualsThatToManyPoints) {
  for (const double sweep : {0.4, -0.4, 1.5, 3.0, -3.0, 4.0, -6.0, 6.2})
    for (int i = 0; i < 60; ++i) {
      const Piece piece = arc(6.28 * random(i, 5), sweep);
      const Vec2 p{random(i, 2), random(i, 3)};
      double best = 1e300;
      constexpr int n = 2000;
      for (int k = 0; k <= n; ++k)
        best = std::min(best, length(p - piece.point(piece.length() * k / n)));
      ASSERT_NEAR(piece.distance(p), best, 1e-5) << sweep << " " << i;
      ASSERT_LE(piece.distance(p), best + 1e-14);
    }
}

TEST(Piece, DistanceToASegmentIsThatOfTheSegment) {
  Piece piece;
  piece.start = {0.25, 0.5};
  piece.end = {0.75, 0.5};
  const std::pair<Vec2, double> cases[] = {{{0.5, 0.75}, 0.25},  {{0.3, 0.5}, 0},    {{0, 0.5}, 0.25},
                                           {{1, 0.5}, 0.25},     {{1.05, 0.9}, 0.5}, {{0.25, 0.5}, 0},
                                           {{0.3, 0.375}, 0.125}};
  for (const auto& [p, expected] : cases) {
    EXPECT_NEAR(piece.distance(p), expected, 1e-15);
    EXPECT_NEAR(squared_distance(p, {piece.end, piece.start}), expected * expected, 1e-15);
  }
  EXPECT_EQ(squared_distance({3, 4}, {{0, 0}, {0, 0}}), 25);
}

TEST(Piece, FullTurnIsACircle) {
  Piece piece = arc(0, 2 * pi);
  piece.end = piece.start;
  EXPECT_NEAR(piece.distance({0.3, 0.4}), 0.25, 1e-15);
  EXPECT_NEAR(piece.distance({0.3, 0.9}), 0.25, 1e-15);
  EXPECT_NEAR(piece.length(), 0.5 * pi, 1e-15);
}

TEST(Piece, EndsComeBackBitForBitAndTheTangentIsTheDerivative) {
  const Piece line{.start = {0.1, 0.2}, .end = {0.7, 0.3}, .center = {}};
  for (const Piece& piece : {line, arc(1, 0.7), arc(2, -2.5)}) {
    EXPECT_EQ(piece.point(0), piece.start);
    EXPECT_EQ(piece.point(piece.length()), piece.end);
    for (const double t : {0.0, 0.3, 0.9}) {
      const double s = t * piece.length(), d = 1e-6;
      const Vec2 difference = (1 / d) * (piece.point(s + d) - piece.point(s));
      EXPECT_NEAR(length(difference - piece.tangent(s)), 0, 1e-5);
      EXPECT_NEAR(length(piece.tangent(s)), 1, 1e-14);
    }
  }
}

TEST(Loop, TurnsOfARectangleAndACircle) {
  const Part rectangle = Part::rectangle("r", {{0.1, 0.2}, {0.6, 0.4}}, unit_frame);
  const Loop loop = rectangle.boundary()[0];
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_DOUBLE_EQ(loop.turn_degrees(k), 90);
  EXPECT_NEAR(loop.length(), 1.4, 1e-12);
  const Loop round = Part::circle("c", {0.5, 0.5}, 0.3, unit_frame).boundary()[0];
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_NEAR(round.turn_degrees(k), 0, 1e-10);
  EXPECT_NEAR(round.length(), 0.6 * pi, 1e-12);
}

TEST(Boundary, BoundingBoxHasTheBulgesOfArcs) {
  const RegionShape shape({Part::circle("c", {0.5, 0.5}, 0.25, unit_frame)}, "c", unit_frame);
  const Box box = shape.boundary().bounding_box();
  EXPECT_EQ(box.min, (Vec2{0.25, 0.25}));
  EXPECT_EQ(box.max, (Vec2{0.75, 0.75}));
  Boundary single;
  single.loops.push_back({{arc(pi / 4, pi / 2)}, true, 1});
  EXPECT_NEAR(single.bounding_box().max.y, 0.65, 1e-15);
}

} // namespace
} // namespace trime::geometry
