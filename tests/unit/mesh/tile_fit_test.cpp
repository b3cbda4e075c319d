// SPDX-License-Identifier: BSD-3-Clause
// Tiles of about equal weight.
#include "mesh/tile_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace trime::mesh {
namespace {

using geometry::Box;
using geometry::Vec2;

/// Divides and joins until nothing changes; a tile weighs as many as the points in it.
std::vector<std::int64_t> fit(TileGrid& grid, const std::vector<Vec2>& points, std::int64_t most) {
  for (;;) {
    std::vector<std::int64_t> weights(static_cast<std::size_t>(grid.tile_count()), 0);
    for (const Vec2 p : points)
      ++weights[static_cast<std::size_t>(grid.tile_at(p))];
    WeightedTiles result = fit_tiles(grid, weights, most);
    grid.set_tiles(std::move(result.tiles));
    if (!result.divided)
      return result.weights;
  }
}

/// Crowded around a corner of tiles: densities differ by a factor of 10^6 and more.
std::vector<Vec2> crowded_points() {
  std::vector<Vec2> points;
  for (int k = 0; k < 6000; ++k)
    points.push_back({0.5 + std::ldexp(std::cos(k), -k % 11 - 2), 0.5 + std::ldexp(std::sin(k), -k % 11 - 2)});
  return points;
}

TEST(TileFit, NoTileIsTooHeavyNorCouldBeLarger) {
  TileGrid grid(Box{{0, 0}, {1, 1}}, GridOptions{{}, {}, 0.02});
  const std::vector<Vec2> points = crowded_points();
  const std::vector<std::int64_t> weights = fit(grid, points, 50);
  EXPECT_EQ(std::accumulate(weights.begin(), weights.end(), std::int64_t{0}), 6000);
  for (LocalIndex tile = 0; tile < grid.tile_count(); ++tile) {
    EXPECT_LE(weights[static_cast<std::size_t>(tile)], 50);
    const CurveSquare square = grid.tile(tile).on_curve();
    if (square.level == 1)
      continue;
    const FixedRect around = rect_of(tile_of(curve_square(square.x / 2, square.y / 2, square.level - 1), 0));
    std::int64_t in_parent = 0;
    grid.for_each_in(around, [&](LocalIndex other, int, const FixedRect&) {
      in_parent += weights[static_cast<std::size_t>(other)];
    });
    EXPECT_GT(in_parent, 50);
  }
}

TEST(TileFit, TheTilesAtFirstDoNotMatter) {
  TileGrid coarse(Box{{0, 0}, {1, 0.3}}, GridOptions{{}, {}, 0.2}),
      fine(Box{{0, 0}, {1, 0.3}}, GridOptions{{}, {}, 0.004});
  std::vector<Vec2> points = crowded_points();
  for (Vec2& p : points)
    p.y *= 0.3;
  EXPECT_NE(coarse.tile_count(), fine.tile_count());
  EXPECT_EQ(fit(coarse, points, 30), fit(fine, points, 30));
  ASSERT_EQ(coarse.tile_count(), fine.tile_count());
  for (LocalIndex tile = 0; tile < fine.tile_count(); ++tile) {
    EXPECT_EQ(coarse.tile(tile).x, fine.tile(tile).x);
    EXPECT_EQ(coarse.tile(tile).y, fine.tile(tile).y);
    EXPECT_EQ(coarse.tile(tile).shift, fine.tile(tile).shift);
  }
}

TEST(TileFit, PointsAtOnePlaceAreNotDividedForEver) {
  TileGrid grid(Box{{0, 0}, {1, 1}}, GridOptions{{}, {}, 0.1});
  const std::vector<std::int64_t> weights = fit(grid, std::vector<Vec2>(1000, Vec2{0.3, 0.3}), 10);
  EXPECT_EQ(*std::max_element(weights.begin(), weights.end()), 1000);
  EXPECT_LT(grid.tile_count(), 200);
}

TEST(TileFit, SmallMeshesHaveSmallTilesAndLargeOnesLargeTiles) {
  EXPECT_EQ(most_per_tile(10), 80);
  EXPECT_EQ(most_per_tile(5e4), 250);
  EXPECT_EQ(most_per_tile(1e6), 512);
  EXPECT_EQ(most_per_tile(3e6), 750);
  EXPECT_EQ(most_per_tile(1e9), 1000);
}

} // namespace
} // namespace trime::mesh
