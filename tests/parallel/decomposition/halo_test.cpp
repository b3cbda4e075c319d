// SPDX-License-Identifier: BSD-3-Clause
// Ghosts are the sites of their owners; subscriptions grow; the numbering of the mesh does not know the ranks.
#include "decomposition/halo.hpp"
#include "decomposition/numbering.hpp"
#include "sites/site_state.hpp"
#include "support/distributed.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace trime::decomposition {
namespace {

using geometry::Vec2;
using mesh::BinRef;
using mesh::Site;
using mesh::SiteList;

const geometry::Box square{{0, 0}, {1, 1}};

double size_of(Vec2 p) {
  return p.x + 7 * p.y;
}

/// Sites of the whole square, distributed; and all of them on this rank as the truth.
struct Stage {
  explicit Stage(SiteList sites, double spacing = 0.03)
      : grid(square, {{}, {}, spacing}), points(grid), truth(grid), halo(comm, grid), partition(grid.tile_count(), 1) {
    truth.assign_owned(sites, 0, grid.tile_count());
    sites = testing::dealt(comm, sites);
    partition = Partition(tile_weights(comm, grid, sites), comm.size());
    migrate(comm, grid, partition, sites);
    points.assign_owned(sites, partition.first_tile(comm.rank()), partition.last_tile(comm.rank()));
  }

  /// The known bins of foreign tiles, ascending.
  std::vector<BinRef> foreign_bins() const {
    std::set<BinRef> unknown;
    points.for_each_near(
        {0.5, 0.5}, 0.5, [](LocalIndex, LocalIndex) {}, [&](BinRef bin) { unknown.insert(bin); });
    std::vector<BinRef> known;
    for (LocalIndex tile = 0; tile < grid.tile_count(); ++tile)
      for (int bin = 0; bin < grid.bins_per_tile(tile) && partition.owner(tile) != comm.rank(); ++bin)
        if (!unknown.contains({tile, bin}))
          known.push_back({tile, bin});
    return known;
  }

  /// Each of them holds the sites of the truth, in the same order, and there are no other ghosts.
  void expect_true_ghosts() const {
    std::vector<LocalIndex> begins;
    LocalIndex ghosts = 0;
    for (const BinRef& bin : foreign_bins()) {
      const auto [begin, end] = points.bin_range(bin);
      const auto [first, last] = truth.bin_range(bin);
      ASSERT_EQ(end - begin, last - first);
      ASSERT_GE(begin, points.owned());
      for (LocalIndex i = 0; i < end - begin; ++i) {
        EXPECT_EQ(points.position(begin + i), truth.position(first + i));
        EXPECT_EQ(points.boundary(begin + i), truth.boundary(first + i));
      }
      ghosts += end - begin;
      if (end > begin)
        begins.push_back(begin);
    }
    EXPECT_EQ(points.owned() + ghosts, points.size());
    std::sort(begins.begin(), begins.end());
    EXPECT_TRUE(std::adjacent_find(begins.begin(), begins.end()) == begins.end()) << "bins have sites of their own";
  }

  comm::Communicator comm = comm::Communicator::world();
  mesh::TileGrid grid;
  mesh::BinnedPoints points, truth;
  Halo halo;
  Partition partition;
};

TEST(Halo, GhostsEqualTheSitesOfTheirOwners) {
  Stage stage(testing::random_sites(1500, 1));
  for (const int margin : {0, 1, 2, 9}) {
    stage.halo.reset(stage.partition, margin);
    stage.halo.refresh(stage.points);
    stage.expect_true_ghosts();
    EXPECT_TRUE(margin > 0 || stage.points.size() == stage.points.owned());
    int unknown = 0; // within the margin around an owned tile everything is known
    const double bin = stage.grid.tile_box(0).width() / stage.grid.bins_per_side(0);
    for (LocalIndex i = 0; i < stage.points.owned() && margin > 0; ++i)
      stage.points.for_each_near(
          stage.points.position(i), 0.99 * margin * bin, [](LocalIndex, LocalIndex) {}, [&](BinRef) { ++unknown; });
    EXPECT_EQ(unknown, 0);
  }
}

TEST(Halo, SubscriptionsGrowAndOldGhostsKeepTheirIdentity) {
  Stage stage(testing::random_sites(1200, 2));
  stage.halo.reset(stage.partition, 1);
  stage.halo.refresh(stage.points);
  for (int round = 0; round < 3; ++round) {
    std::vector<Vec2> old;
    for (LocalIndex i = stage.points.owned(); i < stage.points.size(); ++i)
      old.push_back(stage.points.position(i));
    const std::vector<BinRef> known = stage.foreign_bins();
    std::vector<BinRef> more; // every seventh foreign bin that is not known, twice, on some ranks only
    if (comm::Communicator::world().rank() % 2 == round % 2)
      for (LocalIndex tile = 0; tile < stage.grid.tile_count(); ++tile)
        for (int bin = round; bin < stage.grid.bins_per_tile(tile); bin += 7)
          if (stage.partition.owner(tile) != stage.comm.rank() &&
              !std::binary_search(known.begin(), known.end(), BinRef{tile, bin}))
            more.insert(more.end(), 2, {tile, bin});
    std::vector<double> sizes;
    for (LocalIndex i = 0; i < stage.points.size(); ++i)
      sizes.push_back(size_of(stage.points.position(i)));
    stage.halo.extend(stage.points, more, round == 0 ? nullptr : &sizes);
    stage.expect_true_ghosts();
    ASSERT_LE(static_cast<LocalIndex>(old.size()), stage.points.size() - stage.points.owned());
    for (std::size_t k = 0; k < old.size(); ++k)
      EXPECT_EQ(stage.points.position(stage.points.owned() + static_cast<LocalIndex>(k)), old[k]);
    for (LocalIndex i = 0; i < stage.points.size() && round > 0; ++i)
      EXPECT_EQ(sizes[static_cast<std::size_t>(i)], size_of(stage.points.position(i)));
  }
  const std::vector<BinRef> before = stage.foreign_bins();
  stage.halo.refresh(stage.points); // subscriptions stay
  EXPECT_EQ(stage.foreign_bins(), before);
  stage.expect_true_ghosts();
}

TEST(Halo, ExchangeBringsTheValuesOfTheOwners) {
  Stage stage(testing::random_sites(1000, 3));
  stage.halo.reset(stage.partition, 2);
  stage.halo.refresh(stage.points);
  const auto value_of = [](Vec2 p) {
    return static_cast<GlobalId>(p.x * 0x1p40) ^ static_cast<GlobalId>(p.y * 0x1p30);
  };
  std::vector<GlobalId> values;
  for (LocalIndex i = 0; i < stage.points.owned(); ++i)
    values.push_back(value_of(stage.points.position(i)));
  const std::vector<GlobalId> ghosts = stage.halo.exchange(stage.points, values);
  ASSERT_EQ(static_cast<LocalIndex>(ghosts.size()), stage.points.size() - stage.points.owned());
  for (std::size_t k = 0; k < ghosts.size(); ++k)
    EXPECT_EQ(ghosts[k], value_of(stage.points.position(stage.points.owned() + static_cast<LocalIndex>(k))));
}

/// Every third ghost, also those that were fetched later; the cause is the first site of this rank.
TEST(Halo, NewsReachTheOwnersOfGhosts) {
  Stage stage(testing::random_sites(1000, 6));
  stage.halo.reset(stage.partition, 1);
  stage.halo.refresh(stage.points);
  std::vector<BinRef> more;
  if (stage.comm.rank() == 0)
    for (LocalIndex tile = 0; tile < stage.grid.tile_count(); tile += 5)
      if (stage.partition.owner(tile) != 0 && std::ranges::count(stage.foreign_bins(), BinRef{tile, 0}) == 0)
        more.push_back({tile, 0});
  stage.halo.extend(stage.points, more, nullptr);
  std::vector<LocalIndex> ghosts;
  std::vector<GhostNews> news;
  for (LocalIndex i = stage.points.owned(); i < stage.points.size(); i += 3) {
    ghosts.push_back(i);
    news.push_back({stage.points.position(i), stage.points.position(0)});
  }
  const std::vector<GhostNews> heard = stage.halo.tell_owners(stage.points, ghosts, news);
  EXPECT_EQ(stage.comm.sum(std::ssize(heard)), stage.comm.sum(std::ssize(news)));
  std::vector<Vec2> own;
  for (LocalIndex i = 0; i < stage.points.owned(); ++i)
    own.push_back(stage.points.position(i));
  for (const GhostNews& of : heard) {
    EXPECT_EQ(std::ranges::count(own, of.ghost), 1);
    EXPECT_EQ(std::ranges::count(own, of.cause), 0);
  }
  EXPECT_TRUE(stage.halo.tell_owners(stage.points, {}, {}).empty());
}

TEST(Halo, WorksForRanksWithoutTilesAndWithoutSites) {
  Stage few(testing::random_sites(3, 4), 5.0); // one tile
  few.halo.reset(few.partition, 3);
  few.halo.refresh(few.points);
  few.expect_true_ghosts();
  Stage empty(SiteList{});
  empty.halo.reset(empty.partition, 2);
  empty.halo.refresh(empty.points);
  EXPECT_EQ(empty.points.size(), 0);
}

TEST(Numbering, IsThatOfOneRankAndFollowsTheHilbertCurve) {
  for (const double spacing : {0.03, 5.0}) {
    Stage stage(testing::near_duplicates(500, 5), spacing);
    stage.halo.reset(stage.partition, 2);
    stage.halo.refresh(stage.points);
    const Numbering numbering = canonical_numbering(stage.comm, stage.points, stage.halo);

    const comm::Communicator self = comm::Communicator::self();
    Halo nothing(self, stage.grid);
    nothing.reset(Partition(stage.grid.tile_count(), 1), 0);
    const Numbering truth = canonical_numbering(self, stage.truth, nothing);

    EXPECT_EQ(numbering.total, truth.total);
    EXPECT_EQ(numbering.first, stage.comm.exclusive_scan(stage.points.owned()));
    ASSERT_EQ(static_cast<LocalIndex>(numbering.site_vertex.size()), stage.points.size());
    const auto id_of = [&](LocalIndex site) { return numbering.global_id(numbering.vertex(site)); };
    const auto place = [&](GlobalId id) { return stage.truth.position(truth.order[static_cast<std::size_t>(id)]); };
    for (LocalIndex i = 0; i < stage.points.size(); ++i)
      EXPECT_EQ(place(id_of(i)), stage.points.position(i));
    for (std::size_t k = 0; k < numbering.order.size(); ++k)
      EXPECT_EQ(id_of(numbering.order[k]), numbering.first + static_cast<GlobalId>(k));
    for (LocalIndex i = 0; i < stage.points.size(); ++i)
      for (LocalIndex j = 0; j < stage.points.size(); j += 17) {
        const LocalIndex u = numbering.vertex(i), v = numbering.vertex(j);
        ASSERT_EQ(numbering.place(u) < numbering.place(v), numbering.global_id(u) < numbering.global_id(v));
      }
    for (GlobalId id = 1; id < truth.total; ++id) {
      const std::uint64_t before = stage.grid.point_key(place(id - 1)), key = stage.grid.point_key(place(id));
      EXPECT_TRUE(before < key || (before == key && geometry::lexicographically_less(place(id - 1), place(id))));
    }
  }
}

} // namespace
} // namespace trime::decomposition
