// SPDX-License-Identifier: BSD-3-Clause
// BoxTree and PieceTree::within against looking at everything.
#include "geometry/box_tree.hpp"

#include "core/random.hpp"
#include "trime/geometry/piece_tree.hpp"

#include <gtest/gtest.h>

namespace trime::geometry {
namespace {

double uniform(std::uint64_t key, std::uint64_t slot) {
  return random_unit(11, RandomPurpose::test, key, slot);
}

bool meet(const Box& a, const Box& b) {
  const Box common = intersected(a, b);
  return common.min.x <= common.max.x && common.min.y <= common.max.y;
}

TEST(BoxTree, FindsWhatMeetsABox) {
  for (const std::size_t n : {std::size_t{0}, std::size_t{1}, std::size_t{5}, std::size_t{17}, std::size_t{1000}}) {
    std::vector<Box> boxes;
    for (std::size_t k = 0; k < n; ++k) {
      const Vec2 p{k % 3 == 0 ? 0.5 : uniform(k, 0), uniform(k, 1)};
      const double size = k % 5 == 0 ? 0 : 0.05 * uniform(k, 2);
      boxes.push_back({p, p + Vec2{size, 2 * size}});
    }
    const BoxTree tree(boxes);
    for (std::uint64_t q = 0; q < 200; ++q) {
      const Vec2 p{q % 2 == 0 ? 0.5 : uniform(q, 3), uniform(q, 4)};
      const double size = q % 4 == 0 ? 0 : 0.2 * uniform(q, 5);
      const Box box = q == 7 ? Box{{-1, -1}, {2, 2}} : Box{p, p + Vec2{size, size}};
      std::vector<std::size_t> expected;
      for (std::size_t k = 0; k < n; ++k)
        if (meet(boxes[k], box))
          expected.push_back(k);
      EXPECT_EQ(tree.meeting(box), expected);
    }
  }
}

TEST(PieceTree, FindsThePiecesWithinADistance) {
  Boundary boundary;
  boundary.periods.x = 1;
  Loop& loop = boundary.loops.emplace_back();
  for (std::uint64_t k = 0; k < 101; ++k) {
    Piece piece;
    piece.start = {uniform(k, 6), 0.1 * uniform(k, 7)};
    piece.end = piece.start + Vec2{0.05 * uniform(k, 8), 0.05 * uniform(k, 9)};
    loop.pieces.push_back(piece);
  }
  const PieceTree tree(boundary);
  for (std::uint64_t q = 0; q < 300; ++q) {
    const Vec2 p{uniform(q, 10), 0.1 * uniform(q, 11)};
    const double distance = 0.1 * uniform(q, 12);
    std::vector<std::size_t> expected;
    for (std::size_t k = 0; k < loop.pieces.size(); ++k) {
      double least = 1;
      for (const double shift : {-1.0, 0.0, 1.0})
        least = std::min(least, loop.pieces[k].distance(p + Vec2{shift, 0}));
      if (least <= distance)
        expected.push_back(k);
    }
    EXPECT_EQ(tree.within(p, distance), expected);
  }
}

} // namespace
} // namespace trime::geometry
