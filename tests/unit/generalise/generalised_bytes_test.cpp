// SPDX-License-Identifier: BSD-3-Clause
// Curves on their way to another rank: all of them arrive.
#include "generalise/generalised_bytes.hpp"

#include "generalise_shapes.hpp"

#include <gtest/gtest.h>

namespace trime::generalise {
namespace {

using testing::circle_loop;

TEST(GeneralisedBytes, BringAllThatTheyTook) {
  Generalised all{
      boundary_of({polygon_loop({{0.1, 0.1}, {0.9, 0.1}, {0.5, 0.9}}, 3), circle_loop({0.5, 0.4}, 0.1, true, 4, 2)}),
      {}};
  all.boundary.part_names = {"land"};
  all.boundary.loops[0].pieces[1].corner = true;
  all.counts.cut = 5;
  all.counts.largest_move = 0.25;
  Boundary given;
  given.part_names = all.boundary.part_names;
  const Generalised back = generalised_of_bytes(to_bytes(all), given);
  EXPECT_EQ(back.boundary.area, all.boundary.area);
  EXPECT_EQ(back.boundary.part_names, all.boundary.part_names);
  EXPECT_EQ(back.counts.cut, 5);
  EXPECT_EQ(back.counts.largest_move, 0.25);
  ASSERT_EQ(back.boundary.loops.size(), all.boundary.loops.size());
  for (std::size_t k = 0; k < all.boundary.loops.size(); ++k) {
    const Loop &is = back.boundary.loops[k], &was = all.boundary.loops[k];
    EXPECT_EQ(is.outer, was.outer);
    EXPECT_EQ(is.tag, was.tag);
    EXPECT_EQ(is.winding, was.winding);
    ASSERT_EQ(is.pieces.size(), was.pieces.size());
    for (std::size_t j = 0; j < was.pieces.size(); ++j) {
      EXPECT_EQ(is.pieces[j].start, was.pieces[j].start);
      EXPECT_EQ(is.pieces[j].end, was.pieces[j].end);
      EXPECT_EQ(is.pieces[j].circular, was.pieces[j].circular);
      EXPECT_EQ(is.pieces[j].corner, was.pieces[j].corner);
      EXPECT_EQ(is.pieces[j].part, was.pieces[j].part);
      EXPECT_EQ(is.pieces[j].length(), was.pieces[j].length());
    }
  }
}

} // namespace
} // namespace trime::generalise
