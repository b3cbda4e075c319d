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
  all.emplace_back(Box{{0, 0}, {1, 2}}, GridOptions{{}, {}, 0.005, {1, 2, {}}});
  all.emplace_back(Box{{0, 0}, {1, 1}}, GridOptions{{}, {}, 0.0068, {1, 0, {}}});
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
    const FixedRect limits = grid.limits();
    std::int64_t area = 0;
    for (LocalIndex tile = 0; tile < grid.tile_count(); ++tile) {
      const FixedRect part = common_part(rect_of(grid.tile(tile)), limits);
      ASSERT_FALSE(part.is_empty());
      area += ((part.x1 - part.x0 + 1) >> 8) * ((part.y1 - part.y0 + 1) >> 8);
      for (const auto& [x, y] : {std::pair{part.x0, part.y0}, std::pair{part.x1, part.y1}})
        EXPECT_EQ(grid.tile_at(x, y), tile);
    }
    EXPECT_EQ(area, (grid.x_axis().length() >> 8) * (grid.y_axis().length() >> 8));
    const double slack = 1e-12 * std::max(grid.container().width(), grid.container().height());
    const Box box = grid.box_of(limits);
    EXPECT_NEAR(box.max.x, grid.container().max.x, slack + 1e-15 * std::fabs(box.max.x));
    EXPECT_NEAR(box.max.y, grid.container().max.y, slack + 1e-15 * std::fabs(box.max.y));
  }
}

TEST(TileGrid, TilesAreNearlySquare) {
  for (const TileGrid& grid : grids()) {
    const Box box = grid.tile_box(0);
    EXPECT_NEAR(box.width() / box.height(), 1, 1.0 / 32);
  }
}

/// The halves of a container of equal tiles in the order of the curve, as a partition for two ranks has them.
struct Halves {
  int cut = 0;              ///< neighbouring tiles in different halves
  std::array<int, 2> rim{}; ///< tiles of each at the border of the container
};

Halves halves_of(const TileGrid& grid) {
  const auto half_of = [&](LocalIndex tile) { return 2 * tile >= grid.tile_count() ? 1 : 0; };
  Halves halves;
  for (LocalIndex tile = 0; tile < grid.tile_count(); ++tile) {
    const FixedRect around = rect_of(grid.tile(tile)).grown(1);
    halves.rim[static_cast<std::size_t>(half_of(tile))] += !grid.limits().contains(around);
    grid.for_each_in(common_part(around, grid.limits()), [&](LocalIndex other, int, const FixedRect&) {
      const bool beside = grid.tile(other).x == grid.tile(tile).x || grid.tile(other).y == grid.tile(tile).y;
      halves.cut += other > tile && beside && half_of(other) != half_of(tile);
    });
  }
  return halves;
}

TEST(TileGrid, HalvesOfASquareAreCompactAndHaveHalfOfItsBorder) {
  for (const double spacing : {0.03, 0.01, 0.0034, 0.0011}) {
    const TileGrid grid(Box{{0, 0}, {1, 1}}, GridOptions{{}, {}, spacing});
    const int n = static_cast<int>(std::lround(std::sqrt(grid.tile_count())));
    const Halves halves = halves_of(grid);
    EXPECT_LT(halves.cut, 2 * n) << n;
    EXPECT_NEAR(halves.rim[0], halves.rim[1], 0.1 * 4 * n + 2) << n;
  }
}

TEST(TileGrid, SlendersAreCutAcross) {
  const TileGrid grid(Box{{0, 0}, {64, 3}}, GridOptions{{}, {}, 0.03});
  const double across = 3 / grid.tile_box(0).height();
  ASSERT_GT(across, 2);
  EXPECT_LE(halves_of(grid).cut, 2 * across + 4);
}

TEST(TileGrid, PointsOutsideAreClampedToTheRim) {
  for (const TileGrid& grid : grids()) {
    const Box& box = grid.container();
    const FixedRect limits = grid.limits();
    const double far = 1000 * std::max(box.width(), box.height());
    EXPECT_EQ(grid.tile_at({box.min.x - far, box.min.y - far}), grid.tile_at(limits.x0, limits.y0));
    EXPECT_EQ(grid.tile_at({box.max.x + far, box.max.y + far}), grid.tile_at(limits.x1, limits.y1));
    const Vec2 infinite{INFINITY, -INFINITY};
    EXPECT_EQ(grid.tile_at(infinite), grid.tile_at(limits.x1, limits.y0));
  }
}

TEST(TileGrid, ImagesOfTilesLieOnePeriodAway) {
  const TileGrid grid(Box{{0, 0}, {1, 2}}, GridOptions{{}, {}, 0.02, {1, 2, {}}});
  int images = 0;
  grid.for_each_in(grid.rect_around({0.001, 1.999}, 0.01), [&](LocalIndex tile, int image, const FixedRect& part) {
    EXPECT_TRUE(grid.limits().contains(part));
    EXPECT_TRUE(rect_of(grid.tile(tile)).meets(part));
    const Vec2 place = grid.box_of(part).min + grid.shift(image);
    EXPECT_LT(std::max(std::fabs(place.x), std::fabs(place.y - 2)), 0.02);
    images |= 1 << image;
  });
  EXPECT_EQ(images, 1 << 0 | 1 << 2 | 1 << 3 | 1 << 5); // left of it, above it, and both
}

/// Tiles of all sizes: a tile is divided if it holds the point.
TEST(TileGrid, SquaresMeetTheTilesOfAnyLevelOnce) {
  TileGrid grid(Box{{0, 0}, {1, 0.7}}, GridOptions{{}, {}, 0.03});
  const Vec2 dense{0.371, 0.222};
  for (int level = 0; level < 9; ++level) {
    std::vector<Tile> tiles;
    for (LocalIndex tile = 0; tile < grid.tile_count(); ++tile)
      if (tile != grid.tile_at(dense))
        tiles.push_back(grid.tile(tile));
      else
        for (const CurveSquare& quarter : grid.quarters(grid.tile(tile).on_curve()))
          tiles.push_back(tile_of(quarter, 2));
    grid.set_tiles(std::move(tiles));
  }
  for (const double reach : {0.0, 1e-4, 0.01, 0.2})
    for (std::uint64_t k = 0; k < 50; ++k) {
      const Vec2 center = k % 2 ? random_point(grid.container(), k) : dense;
      const FixedRect rect = grid.rect_around(center, reach);
      std::set<LocalIndex> met;
      grid.for_each_in(rect, [&](LocalIndex tile, int, const FixedRect&) { EXPECT_TRUE(met.insert(tile).second); });
      for (LocalIndex tile = 0; tile < grid.tile_count(); ++tile)
        ASSERT_EQ(met.contains(tile), rect_of(grid.tile(tile)).meets(rect));
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
