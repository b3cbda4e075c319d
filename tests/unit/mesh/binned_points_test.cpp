// SPDX-License-Identifier: BSD-3-Clause
// Sites in tiles and bins: nothing is lost, nothing is found twice, what is unknown is said.
#include "core/thread_loop.hpp"
#include "mesh/binned_points.hpp"
#include "mesh/tile_grid.hpp"
#include "support/point_sets.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace trime::mesh {
namespace {

using geometry::Vec2;
using testing::OnThreads;

const geometry::Box square{{0, 0}, {1, 1}};

TileGrid small_grid() {
  return TileGrid(square, {{}, {}, 0.02});
}

/// Sites of `sites` in tiles [first, last).
SiteList in_tiles(const TileGrid& grid, const SiteList& sites, LocalIndex first, LocalIndex last) {
  SiteList chosen;
  for (const Site& site : sites)
    if (const LocalIndex tile = grid.place(site.position).tile; tile >= first && tile < last)
      chosen.push_back(site);
  return chosen;
}

TEST(BinnedPoints, RestoredSitesStayInTheTilesThatTheyHaveLeft) {
  const TileGrid grid = small_grid();
  SiteList sites;
  std::vector<std::int64_t> counts(static_cast<std::size_t>(grid.tile_count()), 0);
  std::vector<LocalIndex> tiles;
  for (LocalIndex tile = 0; tile < grid.tile_count(); ++tile)
    for (const Site& site : in_tiles(grid, testing::random_sites(2000, 1), tile, tile + 1)) {
      const double away = 0.3 * grid.side_of(tile);
      const Vec2 moved = site.position + Vec2{away, -away};
      sites.push_back({moved.x < 1 && moved.y > 0 ? moved : site.position});
      ++counts[static_cast<std::size_t>(tile)];
      tiles.push_back(tile);
    }
  BinnedPoints points(grid);
  std::vector<LocalIndex> new_index;
  points.restore_owned(sites, counts, 0, grid.tile_count(), new_index);
  ASSERT_EQ(points.owned(), std::ssize(sites));
  int left = 0;
  for (std::size_t k = 0; k < sites.size(); ++k) {
    const LocalIndex i = new_index[k];
    EXPECT_EQ(points.position(i), sites[k].position);
    const auto [begin, end] = points.tile_range(tiles[k]);
    EXPECT_TRUE(i >= begin && i < end);
    left += grid.tile_at(sites[k].position) != tiles[k];
    const TileGrid::TileBin home = grid.place(grid.nearest_in(tiles[k], sites[k].position));
    EXPECT_EQ(home.tile, tiles[k]);
    const auto bin = points.bin_range({home.tile, home.bin});
    EXPECT_TRUE(i >= bin.begin && i < bin.end);
  }
  EXPECT_GT(left, 100);
}

/// A run without a break drops one of them when it sorts, not before.
TEST(BinnedPoints, RestoredSitesThatHaveMetAreKept) {
  const TileGrid grid = small_grid();
  SiteList sites{{{0.01, 0.01}}, {{0.01, 0.01}}, {{0.012, 0.01}}};
  std::vector<std::int64_t> counts(static_cast<std::size_t>(grid.tile_count()), 0);
  counts[static_cast<std::size_t>(grid.tile_at({0.01, 0.01}))] = 3;
  BinnedPoints points(grid);
  std::vector<LocalIndex> new_index;
  points.restore_owned(sites, counts, 0, grid.tile_count(), new_index);
  EXPECT_EQ(points.owned(), 3);
  EXPECT_EQ(points.assign_owned(sites, 0, grid.tile_count()), 1);
}

TEST(BinnedPoints, EverySiteIsInItsBinAndKnowsItsNewIndex) {
  const TileGrid grid = small_grid();
  const SiteList sites = testing::random_sites(2000, 1);
  for (const int threads : {1, 3}) {
    const OnThreads on(threads);
    BinnedPoints points(grid);
    std::vector<LocalIndex> new_index;
    EXPECT_EQ(points.assign_owned(sites, 0, grid.tile_count(), &new_index), 0);
    ASSERT_EQ(points.owned(), 2000);
    for (std::size_t k = 0; k < sites.size(); ++k)
      EXPECT_EQ(points.position(new_index[k]), sites[k].position);
    LocalIndex next = 0;
    for (LocalIndex tile = 0; tile < grid.tile_count(); ++tile) {
      EXPECT_EQ(points.tile_range(tile).begin, next);
      for (int bin = 0; bin < grid.bins_per_tile(tile); ++bin) {
        const auto [begin, end] = points.bin_range({tile, bin});
        EXPECT_EQ(begin, next);
        for (LocalIndex i = begin; i < end; ++i) {
          EXPECT_EQ(grid.place(points.position(i)).tile, tile);
          EXPECT_EQ(grid.place(points.position(i)).bin, bin);
        }
        next = end;
      }
      EXPECT_EQ(points.tile_range(tile).end, next);
    }
    EXPECT_EQ(next, points.owned());
  }
}

/// Divides tiles until each holds a few sites.
void fit_to(TileGrid& grid, const SiteList& sites) {
  for (bool divided = true; divided;) {
    std::vector<std::int64_t> weights(static_cast<std::size_t>(grid.tile_count()), 0);
    for (const Site& site : sites)
      ++weights[static_cast<std::size_t>(grid.tile_at(site.position))];
    WeightedTiles fit = fit_tiles(grid, weights, most_per_tile(static_cast<double>(sites.size())));
    grid.set_tiles(std::move(fit.tiles));
    divided = fit.divided;
  }
}

TEST(BinnedPoints, BinsThatSuitTheirTilesHoldAFewSitesEach) {
  TileGrid grid(geometry::Box{{0, 0}, {1, 1}}, {{}, {}, 0.02});
  const SiteList sites = testing::graded_sites(3000, 3);
  BinnedPoints points(grid);
  const auto mean_in_bin = [&] { // seen from the sites
    double pairs = 0;
    for (LocalIndex tile = 0; tile < grid.tile_count(); ++tile)
      for (int bin = 0; bin < grid.bins_per_tile(tile); ++bin) {
        const auto [begin, end] = points.bin_range({tile, bin});
        pairs += static_cast<double>(end - begin) * static_cast<double>(end - begin);
      }
    return pairs / static_cast<double>(points.owned());
  };
  points.assign_owned(sites, 0, grid.tile_count());
  EXPECT_GT(mean_in_bin(), 50);
  fit_to(grid, sites);
  grid.set_bin_bits(points.suitable_bin_bits(sites, 0, grid.tile_count()));
  points.assign_owned(sites, 0, grid.tile_count());
  EXPECT_LT(mean_in_bin(), 8);
  BinnedPoints anew(grid); // without what was found out before
  anew.assign_owned(sites, 0, grid.tile_count());
  EXPECT_TRUE(std::ranges::equal(points.positions(), anew.positions()));
  int bins = 0;
  for (LocalIndex tile = 0; tile < grid.tile_count(); ++tile)
    bins += grid.bins_per_tile(tile);
  EXPECT_LT(bins, 4 * 3000 + grid.tile_count());
  for (const double reach : {0.001, 0.02, 0.3}) // tiles of different levels are met
    for (std::size_t k = 0; k < sites.size(); k += 100) {
      const Vec2 center = sites[k].position;
      std::size_t near = 0, expected = 0;
      points.for_each_near(
          center, reach,
          [&](LocalIndex begin, LocalIndex end) {
            for (LocalIndex i = begin; i < end; ++i)
              near += geometry::length(points.position(i) - center) <= reach;
          },
          [](BinRef) { ADD_FAILURE() << "all bins are known"; });
      for (const Site& site : sites)
        expected += geometry::length(site.position - center) <= reach;
      EXPECT_EQ(near, expected);
    }
}

TEST(BinnedPoints, TheOrderOfTheInputDoesNotMatter) {
  const TileGrid grid = small_grid();
  SiteList sites = testing::random_sites(1000, 2);
  BinnedPoints one(grid), other(grid);
  one.assign_owned(sites, 0, grid.tile_count());
  std::reverse(sites.begin(), sites.end());
  other.assign_owned(sites, 0, grid.tile_count());
  EXPECT_TRUE(std::equal(one.positions().begin(), one.positions().end(), other.positions().begin()));
}

TEST(BinnedPoints, OfSitesAtOnePlaceTheBoundarySiteStaysElseTheOneMostPushed) {
  const TileGrid grid = small_grid();
  const Vec2 p{0.25, 0.5}, q{0.75, 0.5};
  const SiteList sites{{p, -1, 2}, {p, 7, 0}, {p, -1, 1}, {q, -1, 1}, {q, -1, 3}, {q, -1, 0}, {{0.3, 0.3}}};
  BinnedPoints points(grid);
  std::vector<LocalIndex> new_index;
  EXPECT_EQ(points.assign_owned(sites, 0, grid.tile_count(), &new_index), 4);
  ASSERT_EQ(points.owned(), 3);
  for (const std::size_t dropped : {0, 2, 3, 5})
    EXPECT_EQ(new_index[dropped], -1);
  EXPECT_EQ(points.boundary(new_index[1]), 7);
  EXPECT_EQ(points.site(new_index[4]).pushes, 3);
}

TEST(BinnedPoints, NothingIsASetOfSitesToo) {
  const TileGrid grid = small_grid();
  BinnedPoints points(grid);
  EXPECT_EQ(points.assign_owned({}, 0, grid.tile_count()), 0);
  EXPECT_EQ(points.owned(), 0);
  EXPECT_EQ(points.assign_owned({}, 3, 3), 0); // a rank without tiles
  EXPECT_EQ(points.size(), 0);
  int missing = 0;
  points.for_each_near(
      {0.5, 0.5}, 0.01, [](LocalIndex, LocalIndex) {}, [&](BinRef) { ++missing; });
  EXPECT_GT(missing, 0);
}

TEST(BinnedPoints, SearchFindsAllSitesNearEvenBeyondTheRim) {
  const TileGrid grid = small_grid();
  SiteList sites = testing::random_sites(1500, 3);
  sites.push_back({{1.05, 0.5}}); // outside of the container: kept in the bins of the rim
  sites.push_back({{-0.2, -0.3}});
  BinnedPoints points(grid);
  points.assign_owned(sites, 0, grid.tile_count());
  for (std::uint64_t key = 0; key < 200; ++key) {
    const Vec2 center = testing::random_vec2(9, key);
    const double reach = 0.3 * testing::random_vec2(10, key).x;
    std::set<LocalIndex> found;
    points.for_each_near(
        center, reach,
        [&](LocalIndex begin, LocalIndex end) {
          for (LocalIndex i = begin; i < end; ++i)
            EXPECT_TRUE(found.insert(i).second) << "visited twice";
        },
        [](BinRef) { ADD_FAILURE() << "every bin is known"; });
    for (LocalIndex i = 0; i < points.size(); ++i)
      EXPECT_TRUE(geometry::length(points.position(i) - center) > reach || found.count(i))
          << "site " << i << " is lost";
  }
}

/// The shortest side of a tile and of those beside it.
double narrowest_around(const TileGrid& grid, LocalIndex tile) {
  double narrowest = grid.side_of(tile);
  grid.for_each_in(
      common_part(rect_of(grid.tile(tile)).grown(1), grid.limits()),
      [&](LocalIndex other, int, const FixedRect&) { narrowest = std::min(narrowest, grid.side_of(other)); });
  return narrowest;
}

/// All sites come as far as they may without being sorted: far where tiles are large. A search among small tiles must
/// find what has come near, and look no farther than such tiles let sites go. Else ranks with small tiles would ask for
/// halos as wide as the moves of the coarsest place.
TEST(BinnedPoints, SearchGoesAsFarAsSitesMayHaveComeThere) {
  constexpr double share = 0.25;
  TileGrid grid(square, {{}, {}, 0.02});
  const SiteList sites = testing::graded_sites(6000, 3);
  fit_to(grid, sites);
  BinnedPoints points(grid);
  points.assign_owned(sites, 0, grid.tile_count());
  prepare_to_stay(points);
  DriftBound bound{0, share};
  LocalIndex densest = 0;
  for (LocalIndex tile = 0; tile < grid.tile_count(); ++tile) {
    const double drift = share * narrowest_around(grid, tile);
    const auto [begin, end] = points.tile_range(tile);
    for (LocalIndex i = begin; i < end; ++i) {
      const double angle = 6.28 * testing::random_vec2(7, at(i)).x;
      points.next().positions()[at(i)] =
          points.position(i) + (drift * (1 - 1e-12)) * Vec2{std::cos(angle), std::sin(angle)};
    }
    bound.distance = std::max(bound.distance, drift);
    if (grid.side_of(tile) < grid.side_of(densest))
      densest = tile;
  }
  points.advance();
  for (LocalIndex tile = 0; tile < grid.tile_count(); ++tile)
    points.drifts().set(tile, share * narrowest_around(grid, tile));
  points.drifts().set_largest(bound);
  ASSERT_GT(bound.distance, 2 * grid.side_of(densest)) << "sizes do not differ enough to tell anything";
  for (LocalIndex i = 0; i < points.owned(); i += 7) {
    const Vec2 center = points.position(i);
    const double reach = 0.3 * grid.side_of(grid.tile_at(center));
    std::set<LocalIndex> found;
    points.for_each_near(
        center, reach,
        [&](LocalIndex begin, LocalIndex end) {
          for (LocalIndex j = begin; j < end; ++j)
            found.insert(j);
        },
        [](BinRef) { ADD_FAILURE() << "all bins are known"; });
    for (LocalIndex j = 0; j < points.owned(); ++j)
      EXPECT_TRUE(geometry::length(points.position(j) - center) > reach || found.count(j))
          << "site " << j << " is lost";
  }
  BinnedPoints other(grid); // a rank that knows the densest tile only
  other.assign_owned(in_tiles(grid, sites, densest, densest + 1), densest, densest + 1);
  other.drifts().set_largest(bound);
  const geometry::Box box = grid.tile_box(densest);
  const double side = grid.side_of(densest);
  int missing = 0;
  other.for_each_near(
      0.5 * (box.min + box.max), 0.2 * side, [](LocalIndex, LocalIndex) {}, [&](BinRef) { ++missing; });
  EXPECT_EQ(missing, 0) << "a quarter of its side beyond 0.2 sides from its middle is still the same tile";
}

TEST(BinnedPoints, UnknownBinsAreReportedUntilTheirSitesArrive) {
  const TileGrid grid = small_grid();
  const SiteList sites = testing::random_sites(1500, 4);
  const LocalIndex half = grid.tile_count() / 2;
  BinnedPoints points(grid), all(grid);
  all.assign_owned(sites, 0, grid.tile_count());
  const SiteList mine = in_tiles(grid, sites, 0, half);
  points.assign_owned(mine, 0, half);
  const Vec2 center{0.5, 0.5};
  const double reach = 0.2;
  std::set<BinRef> missing;
  points.for_each_near(
      center, reach, [](LocalIndex, LocalIndex) {}, [&](BinRef bin) { missing.insert(bin); });
  ASSERT_FALSE(missing.empty());
  std::vector<BinRef> bins;
  std::vector<std::int32_t> counts;
  std::vector<mesh::Ghost> ghosts;
  for (const BinRef& bin : missing) {
    EXPECT_GE(bin.tile, half);
    const auto [begin, end] = all.bin_range(bin);
    bins.push_back(bin);
    counts.push_back(end - begin);
    for (LocalIndex i = begin; i < end; ++i)
      ghosts.push_back(Ghost{all.position(i), all.boundary(i)});
  }
  for (int round = 0; round < 2; ++round) // the same ghosts again replace the ghosts
    points.assign_ghosts(bins, counts, ghosts);
  EXPECT_EQ(points.owned(), static_cast<LocalIndex>(mine.size()));
  EXPECT_EQ(points.size(), static_cast<LocalIndex>(mine.size() + ghosts.size()));
  std::size_t near = 0, expected = 0;
  points.for_each_near(
      center, reach,
      [&](LocalIndex begin, LocalIndex end) {
        for (LocalIndex i = begin; i < end; ++i)
          near += geometry::length(points.position(i) - center) <= reach;
      },
      [](BinRef) { ADD_FAILURE() << "all bins near are known now"; });
  for (const Site& site : sites)
    expected += geometry::length(site.position - center) <= reach;
  EXPECT_EQ(near, expected);
  int still = 0;
  points.for_each_near(
      center, 0.4, [](LocalIndex, LocalIndex) {}, [&](BinRef bin) { still += !missing.count(bin); });
  EXPECT_GT(still, 0) << "bins farther away are still unknown";
  points.assign_owned(mine, 0, half);
  EXPECT_EQ(points.size(), points.owned()) << "new owned sites forget the ghosts";
}

/// Moved sites, some gone and some new, lie as if a list of them had been sorted.
TEST(BinnedPoints, MovedSitesAreSortedAsAListIs) {
  const TileGrid grid(square, {{}, {}, 0.02});
  const SiteList sites = testing::random_sites(3000, 3), more = testing::random_sites(200, 4);
  BinnedPoints points(grid), expected(grid);
  points.assign_owned(sites, 0, grid.tile_count());
  prepare_to_stay(points);
  SiteList list;
  std::vector<std::uint8_t> gone;
  for (LocalIndex i = 0; i < points.owned(); ++i) {
    const std::size_t at = static_cast<std::size_t>(i);
    points.next().positions()[at] = testing::random_vec2(5, at);
    points.next().leads()[at] = testing::random_vec2(6, at);
    points.set_pushes(i, i % 3);
    gone.push_back(i % 7 == 0);
    if (!gone.back())
      list.push_back(next_site(points, i));
  }
  list.insert(list.end(), more.begin(), more.end());
  expected.assign_owned(list, 0, grid.tile_count());
  std::vector<LocalIndex> new_index;
  points.sort_moved(gone, more, new_index);
  ASSERT_EQ(points.owned(), expected.owned());
  ASSERT_EQ(new_index.size(), gone.size() + more.size());
  for (LocalIndex i = 0; i < points.owned(); ++i) {
    EXPECT_EQ(points.position(i), expected.position(i));
    EXPECT_EQ(points.site(i).lead, expected.site(i).lead);
    EXPECT_EQ(points.pushes(i), expected.pushes(i));
  }
  std::size_t next = 0;
  for (std::size_t k = 0; k < new_index.size(); ++k)
    if (k < gone.size() && gone[k])
      EXPECT_EQ(new_index[k], -1);
    else
      EXPECT_EQ(points.position(new_index[k]), list[next++].position);
}

/// Few sites that go and come: also to places of others, of each other, and of those that go.
TEST(BinnedPoints, EditedSitesLieAsIfAllHadBeenSorted) {
  const TileGrid grid(square, {{}, {}, 0.02});
  const SiteList sites = testing::random_sites(3000, 3);
  for (const bool is_sparse : {true, false}) {
    BinnedPoints points(grid), expected(grid);
    std::vector<LocalIndex> gone;
    std::vector<std::uint8_t> is_gone;
    SiteList come = testing::random_sites(is_sparse ? 20 : 900, 4);
    for (BinnedPoints* of : {&points, &expected}) {
      of->assign_owned(sites, 0, grid.tile_count());
      for (LocalIndex i = 0; i < of->owned(); ++i) {
        of->set_pushes(i, i % 3);
        of->set_boundary(i, i % 5 == 0 ? i : free_site);
      }
      of->release_leads();
    }
    for (LocalIndex i = 0; i < points.owned(); ++i) {
      is_gone.push_back(i % (is_sparse ? 211 : 5) == 1);
      if (is_gone.back())
        gone.push_back(i);
    }
    for (const LocalIndex i : {0, 10, 11, 12, 212, 213, 2999}) // 212 goes if edits are sparse
      come.push_back({points.position(i), free_site, 3 - (i + 1) % 3});
    come.push_back({come[3].position, free_site, 1}); // no two are equal
    come.push_back({come[4].position, 17});
    std::vector<LocalIndex> new_index, expected_index;
    prepare_to_stay(expected);
    expected.sort_moved(is_gone, come, expected_index);
    const LocalIndex before = points.owned();
    const IndexShift shift = points.edit(gone, come, new_index);
    ASSERT_EQ(points.owned(), expected.owned());
    EXPECT_EQ(shift.before(), before);
    EXPECT_EQ(shift.after(), points.owned());
    const std::vector<LocalIndex> stay = shift.new_indices();
    for (std::size_t k = 0; k < stay.size(); ++k)
      EXPECT_EQ(stay[k], expected_index[k]);
    for (std::size_t k = 0; k < come.size(); ++k)
      EXPECT_EQ(new_index[k], expected_index[stay.size() + k]);
    for (LocalIndex i = 0; i < points.owned(); ++i) {
      EXPECT_EQ(points.position(i), expected.position(i));
      EXPECT_EQ(points.boundary(i), expected.boundary(i));
      EXPECT_EQ(points.pushes(i), expected.pushes(i));
    }
    for (LocalIndex tile = 0; tile < grid.tile_count(); ++tile) {
      EXPECT_EQ(points.tile_range(tile).begin, expected.tile_range(tile).begin);
      EXPECT_EQ(points.tile_range(tile).end, expected.tile_range(tile).end);
      for (int bin = 0; bin < grid.bins_per_tile(tile); ++bin) {
        EXPECT_EQ(points.bin_range({tile, bin}).begin, expected.bin_range({tile, bin}).begin);
        EXPECT_EQ(points.bin_range({tile, bin}).end, expected.bin_range({tile, bin}).end);
      }
    }
  }
}

} // namespace
} // namespace trime::mesh
