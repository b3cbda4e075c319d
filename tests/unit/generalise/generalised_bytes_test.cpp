// SPDX-License-Identifier: BSD-3-Clause
// Curves on their way to another rank: all of them arrive.
#include "generalise/generalised_bytes.hpp"

#include "generalise_shapes.hpp"

#include <gtest/gtest.h>

#include <tuple>

namespace trime::generalise {
namespace {

using geometry::Piece;
using testing::circle_loop;

void expect_same(const Piece& is, const Piece& was) {
  EXPECT_EQ(std::tie(is.start, is.end, is.circular, is.corner, is.part),
            std::tie(was.start, was.end, was.circular, was.corner, was.part));
  EXPECT_EQ(std::tie(is.center, is.radius, is.start_angle, is.sweep),
            std::tie(was.center, was.radius, was.start_angle, was.sweep));
}

void expect_same(const Loop& is, const Loop& was) {
  EXPECT_EQ(std::tie(is.outer, is.tag, is.winding), std::tie(was.outer, was.tag, was.winding));
  ASSERT_EQ(is.pieces.size(), was.pieces.size());
  for (std::size_t k = 0; k < was.pieces.size(); ++k)
    expect_same(is.pieces[k], was.pieces[k]);
}

TEST(GeneralisedBytes, BringAllThatTheyTook) {
  Boundary given;
  given.part_names = {"land"};
  given.periods.x = 2;
  given.covers_torus = true;
  Generalised all{
      boundary_of({polygon_loop({{0.1, 0.1}, {0.9, 0.1}, {0.5, 0.9}}, 3), circle_loop({0.5, 0.4}, 0.1, true, 4, 2)}),
      {1, 2, 3, 4, 5, 6, 0.5, 0.25, 0.125, 2, 7, 0.3, {0.1, 0.2}, 8}};
  all.boundary.loops[0].pieces[1].corner = true;
  all.boundary.loops[1].winding = {2, 0};
  const Generalised back = generalised_of_bytes(to_bytes(all), given);
  EXPECT_EQ(back.boundary.area, all.boundary.area);
  EXPECT_EQ(back.boundary.part_names, given.part_names);
  EXPECT_EQ(back.boundary.periods.x, 2);
  EXPECT_TRUE(back.boundary.covers_torus);
  const polygon::Simplification &is = back.counts, &was = all.counts;
  EXPECT_EQ(std::tie(is.cut, is.filled, is.closed, is.widened, is.thinned, is.smoothed),
            std::tie(was.cut, was.filled, was.closed, was.widened, was.thinned, was.smoothed));
  EXPECT_EQ(std::tie(is.cut_area, is.closed_area, is.largest_move, is.coarseness),
            std::tie(was.cut_area, was.closed_area, was.largest_move, was.coarseness));
  EXPECT_EQ(std::tie(is.severed, is.widest_severed, is.severed_place, is.held),
            std::tie(was.severed, was.widest_severed, was.severed_place, was.held));
  ASSERT_EQ(back.boundary.loops.size(), all.boundary.loops.size());
  for (std::size_t k = 0; k < all.boundary.loops.size(); ++k)
    expect_same(back.boundary.loops[k], all.boundary.loops[k]);
}

TEST(GeneralisedBytes, BringNoLoopsToo) {
  EXPECT_TRUE(generalised_of_bytes(to_bytes({}), {}).boundary.loops.empty());
}

} // namespace
} // namespace trime::generalise
