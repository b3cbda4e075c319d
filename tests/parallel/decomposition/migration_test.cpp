// SPDX-License-Identifier: BSD-3-Clause
// Sites travel to the owner of their tile; nobody is lost.
#include "core/angle.hpp"
#include "decomposition/migration.hpp"
#include "support/distributed.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace trime::decomposition {
namespace {

using mesh::Site;
using mesh::SiteList;

const geometry::Box square{{0, 0}, {1, 1}};

SiteList marked_sites(std::size_t n) {
  SiteList sites = testing::random_sites(n, 1);
  for (std::size_t k = 0; k < n; ++k) {
    sites[k].boundary = static_cast<std::int32_t>(k);
    sites[k].pushes = static_cast<std::int32_t>(k % 3);
    sites[k].lead = {0.5 * static_cast<double>(k), -1};
  }
  return sites;
}

TEST(TileWeights, CountTheSitesOfAllRanks) {
  const comm::Communicator comm = comm::Communicator::world();
  const mesh::TileGrid grid(square, {{}, {}, 0.05});
  const SiteList sites = marked_sites(500);
  const std::vector<std::int64_t> weights = tile_weights(comm, grid, testing::dealt(comm, sites));
  EXPECT_EQ(std::accumulate(weights.begin(), weights.end(), std::int64_t{0}), 500);
  EXPECT_EQ(weights, tile_weights(comm::Communicator::self(), grid, sites));
}

/// Around the middle, one over the square of the distance: densities differ by a factor of 10^6.
SiteList crowded_sites(std::size_t n) {
  SiteList sites;
  for (std::size_t k = 0; k < n; ++k) {
    const geometry::Vec2 u = testing::random_vec2(3, k);
    const double r = 4e-4 * std::exp(7 * u.x);
    sites.push_back({{0.5 + r * std::cos(2 * pi * u.y), 0.5 + r * std::sin(2 * pi * u.y)}});
  }
  return sites;
}

TEST(FitTiles, RanksGetEqualSharesHoweverTheDensityVaries) {
  const comm::Communicator comm = comm::Communicator::world();
  constexpr std::size_t n = 300'000;
  constexpr int ranks = 64;
  const SiteList sites = crowded_sites(n);
  mesh::TileGrid grid(square, {{}, {}, 0.002}), serial(square, {{}, {}, 0.01});
  const std::vector<std::int64_t> weights = fit_tiles(comm, grid, testing::dealt(comm, sites));
  EXPECT_EQ(weights, fit_tiles(comm::Communicator::self(), serial, sites)) << "neither ranks nor tiles at first matter";
  EXPECT_EQ(grid.tile_count(), serial.tile_count());
  const Partition partition(weights, ranks);
  std::int64_t most = 0;
  for (int rank = 0; rank < ranks; ++rank)
    most = std::max(most, std::accumulate(weights.begin() + partition.first_tile(rank),
                                          weights.begin() + partition.last_tile(rank), std::int64_t{0}));
  EXPECT_LT(static_cast<double>(most), 1.1 * n / ranks);
}

TEST(Migration, EverySiteArrivesAtItsOwnerWithAllThatBelongsToIt) {
  const comm::Communicator comm = comm::Communicator::world();
  for (const double spacing : {0.05, 5.0}) { // many tiles, and fewer tiles than ranks
    const mesh::TileGrid grid(square, {{}, {}, spacing});
    const SiteList all = marked_sites(500);
    const SiteList before = testing::dealt(comm, all);
    const Partition partition(tile_weights(comm, grid, before), comm.size());
    SiteList sites = before;
    migrate(comm, grid, partition, sites);
    for (const Site& site : sites)
      EXPECT_EQ(partition.owner(grid.place(site.position).tile), comm.rank());
    std::size_t next = 0;
    for (const Site& site : before)
      if (partition.owner(grid.place(site.position).tile) == comm.rank()) {
        ASSERT_LT(next, sites.size());
        EXPECT_EQ(sites[next++].boundary, site.boundary) << "those that stay keep their order in front";
      }
    std::vector<Site> together = testing::gather_all(comm, sites);
    ASSERT_EQ(together.size(), all.size());
    std::sort(together.begin(), together.end(), [](const Site& a, const Site& b) { return a.boundary < b.boundary; });
    for (std::size_t k = 0; k < all.size(); ++k) {
      EXPECT_EQ(together[k].boundary, static_cast<std::int32_t>(k));
      EXPECT_EQ(together[k].position, all[k].position);
      EXPECT_EQ(together[k].pushes, all[k].pushes);
      EXPECT_EQ(together[k].lead, all[k].lead);
    }
    const SiteList settled = sites;
    migrate(comm, grid, partition, sites);
    EXPECT_EQ(sites.size(), settled.size()) << "nobody travels twice";
  }
}

TEST(Migration, OneRankMayGetEverything) {
  const comm::Communicator comm = comm::Communicator::world();
  const mesh::TileGrid grid(square, {{}, {}, 0.05});
  std::vector<std::int64_t> weights(static_cast<std::size_t>(grid.tile_count()), 0);
  weights.back() = 1;
  const Partition partition(weights, comm.size());
  SiteList sites = testing::dealt(comm, marked_sites(100));
  migrate(comm, grid, partition, sites);
  EXPECT_EQ(comm.sum(static_cast<std::int64_t>(sites.size())), 100);
}

} // namespace
} // namespace trime::decomposition
