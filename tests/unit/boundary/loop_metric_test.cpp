// SPDX-License-Identifier: BSD-3-Clause
// Ways along a loop that lie within one piece, and what the layout takes for granted of them.
#include "boundary/loop_metric.hpp"

#include "boundary/rules.hpp"
#include "support/boundary_shapes.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace trime::boundary {
namespace {

using geometry::Vec2;

TEST(LoopMetric, KnowsWaysOnOnePiece) {
  const geometry::Boundary boundary = testing::boundary_of({testing::circle_loop({0.5, 0.5}, 0.25)});
  const sizing::UniformSize size(0.01);
  const LoopMetric metric(boundary, 0, BoundarySizes(size, size));
  const double quarter = metric.piece_t(1);
  const auto way = metric.on_one_piece(0.25 * quarter, 0.75 * quarter);
  ASSERT_TRUE(way);
  EXPECT_NEAR(way->length, 0.5 * 0.25 * 0.5 * pi, 1e-9);
  EXPECT_NEAR(way->turn, 0.25 * pi, 1e-9);
  EXPECT_TRUE(metric.on_one_piece(0, quarter));
  EXPECT_FALSE(metric.on_one_piece(0.5 * quarter, 1.01 * quarter));                  // over a junction
  EXPECT_FALSE(metric.on_one_piece(3.5 * quarter, metric.total() + 0.01 * quarter)); // and over the start
  const auto last = metric.on_one_piece(metric.piece_t(3), metric.total());
  ASSERT_TRUE(last);
  EXPECT_NEAR(last->turn, 0.5 * pi, 1e-9);
}

TEST(LoopMetric, FindsPlacesAmongPiecesOfAllLengths) {
  std::vector<Vec2> corners; // hundreds on one h, and few on the rest
  for (int k = 0; k < 300; ++k)
    corners.push_back({0.1 + 1e-5 * k, 0.1 + (k % 2) * 1e-5});
  corners.insert(corners.end(), {{0.9, 0.1}, {0.9, 0.9}, {0.5, 0.95}});
  const geometry::Boundary boundary = testing::boundary_of({testing::polygon_loop(corners)});
  const sizing::UniformSize size(0.01);
  const LoopMetric metric(boundary, 0, BoundarySizes(size, size));
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const double t = metric.piece_t(i), length = metric.piece_t(i + 1) - t;
    EXPECT_EQ(metric.place(t).piece, static_cast<LocalIndex>(i));
    EXPECT_EQ(metric.place(t).along, 0);
    EXPECT_EQ(metric.place(t + 0.5 * length).piece, static_cast<LocalIndex>(i));
    EXPECT_NEAR(metric.place(t + 0.5 * length).along, 0.005 * length, 1e-12);
    if (i > 0) {
      EXPECT_EQ(metric.place(std::nextafter(t, 0)).piece, static_cast<LocalIndex>(i - 1));
    }
  }
}

TEST(LoopMetric, GentleArcsStayInTheDiscsOfTheirChords) {
  const double moved = BoundaryRules::on_boundary; // an end, by a fixed point
  const geometry::Boundary boundary = testing::boundary_of({testing::circle_loop({0.5, 0.5}, 0.25)});
  const sizing::UniformSize size(0.01);
  const LoopMetric metric(boundary, 0, BoundarySizes(size, size));
  const double shortest = BoundaryRules::gentle_in_steps * testing::unit_lattice().step();
  const double longest = BoundaryRules::gentle_turn * 0.25;
  for (double length = 1.01 * shortest; length < longest; length *= 1.7) {
    const double from = 0.1, to = from + length / 0.01;
    ASSERT_TRUE(metric.on_one_piece(from, to));
    for (const Vec2 shift : {Vec2{moved, 0}, Vec2{-moved, 0}, Vec2{0, moved}, Vec2{0, -moved}}) {
      const PartSummary part = metric.summarize(from, to, metric.point(from) + shift, metric.point(to));
      EXPECT_FALSE(part.leaves_disc) << length;
      EXPECT_LT(std::fabs(part.turn), BoundaryRules::largest_turn);
      EXPECT_EQ(part.sharpest_turn, 0);
    }
  }
}

} // namespace
} // namespace trime::boundary
