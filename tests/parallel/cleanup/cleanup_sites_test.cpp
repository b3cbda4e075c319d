// SPDX-License-Identifier: BSD-3-Clause
// What the clean-up reads around a place: the same on any ranks, and whole, however the sites crowd.
#include "cleanup/cleanup_sites.hpp"

#include "support/patch_sites.hpp"
#include "support/periodic_shapes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace trime::cleanup {
namespace {

using geometry::Vec2;
using sites::Disc;

constexpr std::size_t most = 60;

/// Crowded towards the left: 200 times as dense there as on the right.
mesh::SiteList crowded_sites() {
  mesh::SiteList sites;
  for (std::uint64_t k = 0; k < 6000; ++k) {
    const Vec2 p = testing::random_vec2(9, k);
    sites.push_back({testing::unit_lattice().snap(Vec2{p.x * p.x * p.x, p.y})});
  }
  return sites;
}

bool is_less(const PatchSite& a, const PatchSite& b) {
  return geometry::lexicographically_less(a.position, b.position);
}

/// All ranks know all discs here, and are each other's partners.
std::vector<Surroundings> around(const comm::Communicator& comm, const CleanupSites& sites,
                                 const std::vector<Disc>& discs, std::size_t limit) {
  std::vector<PatchDisc> own, near;
  for (std::size_t k = 0; k < discs.size(); ++k)
    own.push_back({discs[k], comm.rank(), static_cast<std::int32_t>(3 * k)}); // others were not chosen
  for (const PatchDisc& disc : testing::gather_all(comm, own))
    if (disc.rank != comm.rank())
      near.push_back(disc);
  std::vector<int> partners;
  for (int rank = 0; rank < comm.size(); ++rank)
    if (rank != comm.rank())
      partners.push_back(rank);
  return sites.around(own, near, partners, limit);
}

/// Around some places, asked for by whichever rank owns them.
std::map<std::uint64_t, Surroundings> surroundings(const comm::Communicator& comm, const geometry::Periods& periods) {
  const sizing::UniformSize size(0.02);
  const testing::PatchSites on(comm, crowded_sites(), size, 0.02, periods);
  std::vector<Disc> discs;
  std::vector<std::uint64_t> keys;
  for (std::uint64_t k = 0; k < 80; ++k) {
    const Vec2 p = testing::random_vec2(17, k);
    if (on.sites->owner(p) == comm.rank()) {
      discs.push_back({p, 0.02 + 0.2 * testing::random_vec2(18, k).x});
      keys.push_back(k);
    }
  }
  std::vector<Surroundings> found = around(comm, *on.sites, discs, most);
  std::map<std::uint64_t, Surroundings> all;
  for (std::size_t k = 0; k < keys.size(); ++k) {
    std::sort(found[k].sites.begin(), found[k].sites.end(), is_less);
    // The widest of the discs that hold few enough, and all that lies in it.
    const auto count_in = [&](int narrowings) {
      std::size_t count = 0;
      const double radius = Surroundings::radius(discs[k].radius, narrowings);
      for (const mesh::Site& site : crowded_sites())
        count += geometry::squared_length(periods.nearest_image(site.position, discs[k].center) - discs[k].center) <
                 radius * radius;
      return count;
    };
    EXPECT_EQ(found[k].sites.size(), !found[k].is_crowded() ? count_in(found[k].narrowings) : 0);
    EXPECT_LE(found[k].sites.size(), most);
    if (found[k].narrowings > 0) {
      EXPECT_GT(count_in(found[k].narrowings - 1), most);
    }
    all[keys[k]] = std::move(found[k]);
  }
  return all;
}

void expect_whole(const geometry::Periods& periods) {
  const comm::Communicator world = comm::Communicator::world();
  const std::map<std::uint64_t, Surroundings> truth = surroundings(comm::Communicator::self(), periods);
  int narrowed = 0, crowded = 0;
  for (const auto& [key, one] : truth) {
    narrowed += !one.is_crowded() && one.narrowings > 0;
    crowded += one.is_crowded();
  }
  EXPECT_GT(narrowed, 10);
  EXPECT_GT(crowded, 2);
  std::int64_t checked = 0;
  for (const auto& [key, mine] : surroundings(world, periods)) {
    const Surroundings& its = truth.at(key);
    EXPECT_EQ(mine.narrowings, its.narrowings);
    ASSERT_EQ(mine.sites.size(), its.sites.size());
    for (std::size_t k = 0; k < its.sites.size(); ++k)
      EXPECT_EQ(mine.sites[k].position, its.sites[k].position);
    ++checked;
  }
  EXPECT_EQ(world.sum(checked), 80);
}

/// A crowd is given up as a whole: all its sites rest, whoever owns them.
TEST(CleanupSites, AllSitesOfACrowdRest) {
  const comm::Communicator world = comm::Communicator::world();
  const sizing::UniformSize size(0.02);
  testing::PatchSites on(world, crowded_sites(), size, 0.02, {});
  CleanupSites& sites = *on.sites;
  const Disc crowd{{0.05, 0.5}, 0.1};
  const auto is_in_crowd = [&](Vec2 p) {
    return geometry::squared_length(p - crowd.center) < crowd.radius * crowd.radius;
  };
  const std::vector<Vec2> own = sites.let_rest(crowd);
  std::int64_t expected = 0;
  for (const mesh::Site& site : crowded_sites())
    expected += is_in_crowd(site.position);
  EXPECT_EQ(world.sum(std::ssize(own)), expected);
  EXPECT_GT(expected, 500);
  const std::vector<Surroundings> read = around(world, sites, {{{0.1, 0.5}, 0.12}}, 10000);
  EXPECT_GT(read[0].sites.size(), 500u);
  for (const PatchSite& site : read[0].sites)
    EXPECT_EQ(site.rests != 0, is_in_crowd(site.position));
}

/// Pushes stay with a site until the clean-up moves it, to whichever rank: else settling would depend on the ranks.
TEST(CleanupSites, AMovedSiteBeginsAnewOnAnyRanks) {
  const comm::Communicator world = comm::Communicator::world();
  const sizing::UniformSize size(0.02);
  const mesh::SiteList all = testing::random_sites(2000, 5);
  testing::PatchSites on(world, all, size, 0.02, {});
  for (LocalIndex i = 0; i < on.state.points().owned(); ++i)
    on.state.points().set_pushes(i, 3);
  on.state.points().release_leads();
  std::vector<SiteEdit> edits;
  for (std::size_t k = 0; k < all.size(); k += 20) {
    const Vec2 p = all[k].position;
    edits.push_back({p, testing::unit_lattice().snap({p.y, p.x})}); // many to other ranks
    edits.back().size = 0.02;
  }
  on.sites->apply(edits, {});
  on.sites->finish(on.state, delaunay::StarBuilder(testing::unit_lattice(), 0.08));
  const auto owned_at = [&](Vec2 p) {
    LocalIndex found = -1;
    for (LocalIndex i = 0; i < on.state.points().owned(); ++i)
      if (on.state.points().position(i) == p)
        found = i;
    return found;
  };
  EXPECT_EQ(world.sum(std::int64_t{on.state.points().owned()}), 2000);
  std::int64_t at_new_places = 0, pushed = 0;
  for (const SiteEdit& edit : edits)
    if (const LocalIndex i = owned_at(edit.to); i >= 0) {
      ++at_new_places;
      EXPECT_EQ(on.state.points().pushes(i), 0);
    }
  for (LocalIndex i = 0; i < on.state.points().owned(); ++i)
    pushed += on.state.points().pushes(i) == 3;
  EXPECT_EQ(world.sum(at_new_places), 100);
  EXPECT_EQ(world.sum(pushed), 1900);
}

TEST(CleanupSites, SurroundingsAreWholeOnAnyRanks) {
  expect_whole({});
}

TEST(CleanupSites, AcrossAPeriodicBorderToo) {
  expect_whole(testing::unit_torus().periods());
}

} // namespace
} // namespace trime::cleanup
