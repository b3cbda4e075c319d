// SPDX-License-Identifier: BSD-3-Clause
// Which curves are smoothed, how far they move, and what of them stays.
#include "generalise/curve_flow.hpp"

#include "boundary_properties.hpp"
#include "generalise/rules.hpp"
#include "generalise_shapes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace trime::generalise {
namespace {

using testing::unit_lattice;

std::unique_ptr<SmoothedCurves> smooth(const Boundary& boundary, double h) {
  return smooth_ragged_runs(boundary, sizing::UniformSize(h), unit_lattice(), GeneraliseRules::flow_reach);
}

/// A square whose lower side goes to and fro; both ends of that side are far from the corners.
Boundary saw(double height, double step) {
  std::vector<Vec2> ring{{0.1, 0.1}};
  for (int k = 0; 0.3 + step * k < 0.7; ++k)
    ring.push_back({0.3 + step * k, k % 2 == 0 ? 0.1 : 0.1 + height});
  ring.insert(ring.end(), {{0.8, 0.1}, {0.9, 0.1}, {0.9, 0.9}, {0.1, 0.9}});
  return boundary_of({polygon_loop(ring)});
}

/// A disc whose rim goes to and fro, so many times.
Boundary rough_disc(double height, int teeth, bool hole = false) {
  std::vector<Vec2> ring;
  for (int k = 0; k < 2 * teeth; ++k) {
    const SinCos turn = sin_cos(pi * k / teeth);
    ring.push_back(Vec2{0.5, 0.5} + (k % 2 == 0 ? 0.3 : 0.3 + height) * Vec2{turn.cos, turn.sin});
  }
  std::vector<Loop> loops{polygon_loop(hole ? reversed(ring) : ring)};
  if (hole)
    loops.insert(loops.begin(), polygon_loop({{0.01, 0.01}, {0.99, 0.01}, {0.99, 0.99}, {0.01, 0.99}}, 2));
  return boundary_of(loops);
}

double sharpest_turn(const Loop& loop) {
  double most = 0;
  for (std::size_t k = 0; k < loop.pieces.size(); ++k)
    most = std::fmax(most, loop.turn_degrees(k));
  return most;
}

TEST(CurveFlow, LeavesCurvesAloneThatTurnOneWay) {
  for (const double h : {0.3, 0.1, 0.01}) {
    std::vector<Vec2> ring;
    for (int k = 0; k < 200; ++k) {
      const SinCos turn = sin_cos(pi * k / 100);
      ring.push_back(Vec2{0.5, 0.5} + 0.4 * Vec2{turn.cos, turn.sin});
    }
    EXPECT_EQ(smooth(boundary_of({polygon_loop(ring)}), h), nullptr);
    EXPECT_EQ(smooth(boundary_of({testing::circle_loop({0.5, 0.5}, 0.4)}), h), nullptr);
  }
  EXPECT_EQ(smooth(boundary_of({polygon_loop({{0.1, 0.1}, {0.9, 0.1}, {0.5, 0.9}})}), 1), nullptr);
}

TEST(CurveFlow, KeepsCornersWithArmsOfTheSize) {
  const Boundary given = saw(0.1, 0.1);
  EXPECT_EQ(smooth(given, 0.09), nullptr); // the teeth have sides of 0.14, the way from one to the next is longer
  EXPECT_NE(smooth(given, 0.2), nullptr);
}

TEST(CurveFlow, SmoothsTeethBelowTheSizeAndKeepsTheRestBitForBit) {
  const Boundary given = saw(0.01, 0.01);
  const double h = 0.05;
  const auto made = smooth(given, h);
  ASSERT_TRUE(made);
  expect_proper(made->boundary);
  EXPECT_GT(made->vertices, 30);
  EXPECT_NEAR(made->boundary.area, given.area, 1e-4 * h);
  EXPECT_LT(largest_deviation(made->boundary, given, 0.1 * h), 0.2 * h);
  double most = 0;
  const Loop& loop = made->boundary.loops[0];
  for (std::size_t k = 0; k < loop.pieces.size(); ++k)
    if (loop.pieces[k].start.x > 0.35 && loop.pieces[k].start.x < 0.65 && loop.pieces[k].start.y < 0.5)
      most = std::fmax(most, loop.turn_degrees(k));
  EXPECT_LT(most, 15);
  for (const Vec2 corner : {Vec2{0.1, 0.1}, Vec2{0.9, 0.1}, Vec2{0.9, 0.9}, Vec2{0.1, 0.9}})
    EXPECT_TRUE(std::any_of(loop.pieces.begin(), loop.pieces.end(),
                            [&](const Piece& piece) { return piece.start == unit_lattice().snap(corner); }));
}

TEST(CurveFlow, LeavesFewNodesWhereTheResultIsNearlyStraight) {
  const double h = 0.05, from = 0.35, to = 0.65;
  const auto made = smooth(saw(0.005, 0.01), h);
  ASSERT_TRUE(made);
  const std::vector<Piece>& pieces = made->boundary.loops[0].pieces;
  const auto nodes = std::count_if(pieces.begin(), pieces.end(), [&](const Piece& piece) {
    return piece.start.x > from && piece.start.x < to && piece.start.y < 0.5;
  });
  EXPECT_LT(static_cast<double>(nodes), 0.75 * (to - from) / (GeneraliseRules::flow_spacing * h));
  double longest = 0;
  for (const Piece& piece : pieces)
    if (piece.start.x > from && piece.end.x < to && piece.start.y < 0.5)
      longest = std::fmax(longest, piece.length());
  EXPECT_LE(longest, (GeneraliseRules::flow_longest + 0.1) * h);
}

TEST(CurveFlow, KeepsTheAreaOfEachLoop) {
  for (const bool hole : {false, true})
    for (const int teeth : {20, 40, 60}) {
      SCOPED_TRACE(teeth);
      const Boundary given = rough_disc(0.03, teeth, hole);
      const auto made = smooth(given, 0.4);
      ASSERT_TRUE(made);
      expect_proper(made->boundary);
      EXPECT_NEAR(made->boundary.area, given.area, 0.002 * given.area);
      EXPECT_LT(sharpest_turn(made->boundary.loops.back()), 46);
    }
}

TEST(CurveFlow, KeepsWhatTheUserHasAskedForAndArcs) {
  Boundary given = saw(0.01, 0.01);
  for (std::size_t k = 10; k < 30; k += 5)
    given.loops[0].pieces[k].corner = true;
  const auto made = smooth(given, 0.05);
  ASSERT_TRUE(made);
  EXPECT_EQ(corners_of(made->boundary), corners_of(given));
  Boundary bent = given;
  Piece& side = bent.loops[0].pieces[given.loops[0].pieces.size() - 2]; // the upper one, as a half circle's quarter
  side.circular = true;
  side.center = unit_lattice().snap({0.5, 0.5});
  side.radius = length(side.start - side.center);
  side.start_angle = pi / 4;
  side.sweep = pi / 2;
  const auto with_arc = smooth(bent, 0.05);
  ASSERT_TRUE(with_arc);
  const std::vector<Piece>& pieces = with_arc->boundary.loops[0].pieces;
  EXPECT_EQ(std::count_if(pieces.begin(), pieces.end(), [&](const Piece& piece) { return are_equal(piece, side); }), 1);
}

TEST(CurveFlow, FollowsTheLoopsOfEveryClassOfShapes) {
  for (const ShapeClass& shape : shape_classes())
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      SCOPED_TRACE(std::string(shape.name) + " " + std::to_string(seed));
      Draws draws(seed);
      const Boundary given = shape.make(draws);
      const auto made = smooth(given, draws.log_between(5e-3, 0.2));
      if (!made)
        continue;
      ASSERT_EQ(made->boundary.loops.size(), given.loops.size());
      for (std::size_t k = 0; k < given.loops.size(); ++k) {
        const std::vector<Piece>& pieces = made->boundary.loops[k].pieces;
        EXPECT_EQ(made->boundary.loops[k].tag, given.loops[k].tag);
        for (std::size_t j = 0; j < pieces.size(); ++j) {
          EXPECT_EQ(pieces[j].end, pieces[(j + 1) % pieces.size()].start);
          EXPECT_NE(pieces[j].start, pieces[j].end);
          EXPECT_EQ(pieces[j].start, unit_lattice().snap(pieces[j].start));
        }
      }
    }
}

} // namespace
} // namespace trime::generalise
