// SPDX-License-Identifier: BSD-3-Clause
// The grid of tiles and bins.
#include "core/random.hpp"
#include "mesh/tile_grid.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <set>
#include <vector>

namespace trime::mesh {
namespace {

using geometry::Box;
using geometry::Vec2;

Vec2 random_point(const Box& box, std::uint64_t key) {
  return {box.min.x + box.width() * random_unit(1, RandomPurpose::test, key, 0),
          box.min.y + box.height() * random_unit(1, RandomPurpose::test, key, 1)};
}

/// Grids of all shapes: square, slender, given cells, one tile, offset, tiny.
std::vector<TileGrid> grids() {
  std::vector<TileGrid> all;
  all.emplace_back(Box{{0, 0}, {1, 1}}, GridOptions{{}, {}, 0.01});
  all.emplace_back(Box{{-3, 5}, {7, 6}}, GridOptions{{}, {}, 0.02});
  all.emplace_back(Box{{0, 0}, {0.1, 20}}, GridOptions{{}, {}, 0.02});
  all.emplace_back(Box{{0, 0}, {1, 1}}, GridOptions{7, 13, 0.05});
  all.emplace_back(Box{{0, 0}, {1, 1}}, GridOptions{1, 1000, 0.01});
  all.emplace_back(Box{{0, 0}, {1, 1}}, GridOptions{{}, {}, 3.0});
  all.emplace_back(Box{{0, 0}, {1, 1}}, GridOptions{1, 1, 0.01});
  all.emplace_back(Box{{1e6, 1e6}, {1e6 + 1, 1e6 + 1}}, GridOptions{{}, {}, 0.03});
  all.emplace_back(Box{{0, 0}, {1e-9, 1e-9}}, GridOptions{{}, {}, 2e-11});
  all.emplace_back(Box{{0, 0}, {1, 2}}, GridOptions{{}, {}, 0.005, false, {1, 2, {}}});
  all.emplace_back(Box{{0, 0}, {1, 1}}, GridOptions{{}, {}, 0.0068, false, {1, 0, {}}});
  return all;
}

TEST(TileGrid, TilesAreNumberedInTheOrderOfThePointsInThem) {
  for (const TileGrid& grid : grids()) {
    std::vector<std::pair<std::uint64_t, LocalIndex>> points;
    for (std::uint64_t k = 0; k < 500; ++k) {
      const Vec2 p = random_point(grid.container(), k);
      points.emplace_back(grid.point_key(p), grid.place(p).tile);
    }
    std::sort(points.begin(), points.end());
    for (std::size_t k = 1; k < points.size(); ++k)
      ASSERT_LE(points[k - 1].second, points[k].second);
  }
}

TEST(TileGrid, EveryPointHasAPlaceInItsTileBox) {
  for (const TileGrid& grid : grids()) {
    const double slack = 1e-6 * std::max(grid.container().width(), grid.container().height());
    for (std::uint64_t k = 0; k < 500; ++k) {
      const Vec2 p = random_point(grid.container(), k);
      const TileGrid::TileBin place = grid.place(p);
      ASSERT_TRUE(place.tile >= 0 && place.tile < grid.tile_count());
      ASSERT_TRUE(place.bin >= 0 && place.bin < grid.bins_per_tile(place.tile));
      const Box box = grid.tile_box(place.tile);
      EXPECT_TRUE(p.x >= box.min.x - slack && p.x <= box.max.x + slack && p.y >= box.min.y - slack &&
                  p.y <= box.max.y + slack);
    }
  }
}

TEST(TileGrid, TilesCoverTheContainerOnce) {
  for (const TileGrid& grid : grids()) {
    ASSERT_EQ(grid.tile_count(), grid.tiles_x() * grid.tiles_y());
    std::set<std::pair<std::uint32_t, std::uint32_t>> seen;
    for (LocalIndex tile = 0; tile < grid.tile_count(); ++tile) {
      const GridPosition at = grid.tile_position(tile);
      EXPECT_EQ(grid.tile_at(static_cast<int>(at.x), static_cast<int>(at.y)), tile);
      EXPECT_TRUE(seen.emplace(at.x, at.y).second);
    }
    const Vec2 corner = grid.tile_box(grid.tile_at(grid.tiles_x() - 1, grid.tiles_y() - 1)).max;
    EXPECT_GE(corner.x, grid.container().max.x - 1e-12 * grid.container().width());
    EXPECT_GE(corner.y, grid.container().max.y - 1e-12 * grid.container().height());
  }
}

TEST(TileGrid, TilesDivideTheContainer) {
  for (const TileGrid& grid : grids()) {
    const Box& container = grid.container();
    for (LocalIndex tile = 0; tile < grid.tile_count(); ++tile) {
      const Box box = grid.tile_box(tile);
      EXPECT_NEAR(box.width(), container.width() / grid.tiles_x(), 1e-9 * box.width() + 1e-15 * container.max.x);
      EXPECT_NEAR(box.height(), container.height() / grid.tiles_y(), 1e-9 * box.height() + 1e-15 * container.max.y);
    }
  }
}

/// The halves of the tiles in the order of the curve, as a partition for two ranks has them.
struct Halves {
  int cut = 0;              ///< neighbouring tiles in different halves
  std::array<int, 2> rim{}; ///< tiles of each at the border of the container
};

Halves halves_of(const TileGrid& grid) {
  const auto half_of = [&](int x, int y) { return 2 * grid.tile_at(x, y) >= grid.tile_count() ? 1 : 0; };
  Halves halves;
  for (int y = 0; y < grid.tiles_y(); ++y)
    for (int x = 0; x < grid.tiles_x(); ++x) {
      const int half = half_of(x, y);
      halves.cut += x + 1 < grid.tiles_x() && half_of(x + 1, y) != half;
      halves.cut += y + 1 < grid.tiles_y() && half_of(x, y + 1) != half;
      halves.rim[static_cast<std::size_t>(half)] +=
          x == 0 || y == 0 || x + 1 == grid.tiles_x() || y + 1 == grid.tiles_y();
    }
  return halves;
}

TEST(TileGrid, HalvesOfASquareAreCompactAndHaveHalfOfItsBorder) {
  for (const double spacing : {0.03, 0.01, 0.0068, 0.0034, 0.002, 0.0011, 0.0009, 0.0007}) {
    const TileGrid grid(Box{{0, 0}, {1, 1}}, GridOptions{{}, {}, spacing});
    const int n = grid.tiles_x();
    ASSERT_EQ(grid.tiles_y(), n);
    const Halves halves = halves_of(grid);
    EXPECT_LT(halves.cut, 2 * n) << n;
    EXPECT_NEAR(halves.rim[0], halves.rim[1], 0.1 * 4 * n + 2) << n;
  }
}

TEST(TileGrid, SlendersAreCutAcross) {
  const TileGrid grid(Box{{0, 0}, {64, 3}}, GridOptions{{}, {}, 0.03});
  ASSERT_GT(grid.tiles_x(), 8 * grid.tiles_y());
  EXPECT_LE(halves_of(grid).cut, 2 * grid.tiles_y() + 2);
}

TEST(TileGrid, PointsOutsideAreClampedToTheRim) {
  for (const TileGrid& grid : grids()) {
    const Box& box = grid.container();
    const double far = 1000 * std::max(box.width(), box.height());
    EXPECT_EQ(grid.place({box.min.x - far, box.min.y - far}).tile, grid.tile_at(0, 0));
    EXPECT_EQ(grid.place({box.max.x + far, box.max.y + far}).tile,
              grid.tile_at(grid.tiles_x() - 1, grid.tiles_y() - 1));
    EXPECT_EQ(grid.place({box.max.x + far, box.max.y + far}).bin, grid.bins_per_tile(grid.tile_count() - 1) - 1);
    EXPECT_EQ(grid.place({box.min.x - far, box.min.y - far}).bin, 0);
    const Vec2 infinite{INFINITY, -INFINITY};
    EXPECT_EQ(grid.place(infinite).tile, grid.tile_at(grid.tiles_x() - 1, 0));
  }
}

TEST(TileGrid, FixedPositionsAreMonotone) {
  for (const TileGrid& grid : grids()) {
    std::uint32_t last = 0;
    for (int k = -10; k <= 1010; ++k) {
      const std::uint32_t at = grid.x_axis().fixed(grid.container().min.x + grid.container().width() * k / 1000);
      EXPECT_GE(at, last);
      last = at;
    }
  }
}

TEST(TileGrid, KeepsTheGivenCells) {
  const TileGrid grid(Box{{0, 0}, {1, 1}}, GridOptions{7, 13, 0.05});
  EXPECT_EQ(grid.cells().x, 7u);
  EXPECT_EQ(grid.cells().y, 13u);
}

TEST(TileGrid, ABinHoldsAFewPointsOfTheGivenSpacing) {
  for (const double spacing : {0.3, 0.05, 0.01, 0.001}) {
    const TileGrid grid(Box{{0, 0}, {1, 1}}, GridOptions{{}, {}, spacing});
    const Box tile = grid.tile_box(0);
    const double points = tile.width() * tile.height() / (0.866 * spacing * spacing) / grid.bins_per_tile(0);
    EXPECT_GT(points, 1) << spacing;
    EXPECT_LT(points, 8) << spacing;
  }
}

} // namespace
} // namespace trime::mesh
