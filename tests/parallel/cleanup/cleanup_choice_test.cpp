// SPDX-License-Identifier: BSD-3-Clause
// Which contenders are chosen: none within the separation of another one, and the same ones on any ranks.
#include "cleanup/cleanup_choice.hpp"

#include "support/patch_sites.hpp"
#include "support/periodic_shapes.hpp"
#include "support/point_sets.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace trime::cleanup {
namespace {

using geometry::Vec2;

/// Of widths from 0.02 to 0.1; some share their x, some their separation.
std::vector<Contender> contenders() {
  std::vector<Contender> all;
  for (std::uint64_t k = 0; k < 600; ++k) {
    const Vec2 p = testing::random_vec2(70, k), q = testing::random_vec2(71, k);
    const double separation = k % 5 == 0 ? 0.05 : 0.02 + 0.08 * q.x;
    all.push_back({{k % 7 == 0 ? 0.5 : p.x, p.y}, separation, static_cast<std::uint64_t>(40 * q.y)}); // ties
  }
  return all;
}

/// The choice of the contenders on the tiles of this rank, and who its neighbours are.
struct Choosing {
  Choosing(const comm::Communicator& of, const geometry::Periods& its_periods)
      : comm(of), periods(its_periods), on(of, testing::random_sites(1200, 3), size, 0.03, its_periods),
        neighbours(of) {
    for (const Contender& one : contenders())
      if (on.sites->owner(one.place) == comm.rank())
        own.push_back(one);
  }
  void meet() {
    std::vector<int> ranks;
    for (const Contender& one : own)
      for (const int rank : on.sites->ranks_near({one.place, one.separation}))
        ranks.push_back(rank);
    neighbours.add(ranks);
  }
  Choice choose() const { return choose_apart(comm, neighbours, *on.sites, periods, own); }

  const comm::Communicator& comm;
  const geometry::Periods& periods;
  sizing::UniformSize size{0.03};
  testing::PatchSites on;
  comm::Neighbours neighbours;
  std::vector<Contender> own;
};

std::set<std::pair<double, double>> chosen_on(const comm::Communicator& comm, const geometry::Periods& periods) {
  Choosing choosing(comm, periods);
  choosing.meet();
  const Choice choice = choosing.choose();
  EXPECT_TRUE(choice.is_whole);
  std::vector<Vec2> places;
  for (const ChosenContender& one : choice.own) {
    EXPECT_EQ(one.contender.place, choosing.own[static_cast<std::size_t>(one.number)].place);
    EXPECT_TRUE(places.empty() || one.number > choice.own[places.size() - 1].number);
    places.push_back(one.contender.place);
  }
  std::set<std::pair<double, double>> all;
  for (const Vec2 p : comm::from_bytes<Vec2>(comm.all_gather(std::as_bytes(std::span<const Vec2>(places)))))
    all.insert({p.x, p.y});
  return all;
}

void expect_apart(const geometry::Periods& periods) {
  const comm::Communicator world = comm::Communicator::world(), self = comm::Communicator::self();
  const std::set<std::pair<double, double>> chosen = chosen_on(self, periods);
  EXPECT_EQ(chosen_on(world, periods), chosen);
  std::size_t count = 0, left = 0;
  const std::vector<Contender> all = contenders();
  const auto is_chosen = [&](const Contender& one) { return chosen.contains({one.place.x, one.place.y}); };
  for (const Contender& one : all) {
    bool has_rival = false; // among the chosen
    for (const Contender& other : all) {
      const double separation = std::max(one.separation, other.separation);
      const Vec2 way = periods.nearest_image(other.place, one.place) - one.place;
      has_rival |= &one != &other && is_chosen(other) && geometry::squared_length(way) < separation * separation;
    }
    EXPECT_FALSE(is_chosen(one) && has_rival) << one.place.x << " " << one.place.y;
    count += is_chosen(one);
    left += !is_chosen(one) && !has_rival;
  }
  EXPECT_GT(count, 80u);
  EXPECT_LT(left, 5u) << "with room for them: a few passes nearly find all";
}

/// Each rank is told of all patches that reach to its tiles, by their numbers, and of no others.
TEST(ChooseApart, PatchesAreKnownWhereTheyReach) {
  const comm::Communicator world = comm::Communicator::world();
  const geometry::Periods none;
  Choosing choosing(world, none);
  choosing.meet();
  const Choice choice = choosing.choose();
  struct Reach {
    std::int32_t to, from, number;
  };
  std::vector<Reach> own;
  std::set<int> partners;
  for (const ChosenContender& one : choice.own)
    for (const int rank : choosing.on.sites->ranks_near({one.contender.place, one.contender.separation})) {
      own.push_back({rank, one.rank, one.number});
      partners.insert(rank);
    }
  std::vector<std::pair<std::int32_t, std::int32_t>> expected, found;
  for (const Reach& reach : testing::gather_all(world, own))
    if (reach.to == world.rank()) {
      expected.push_back({reach.from, reach.number});
      partners.insert(reach.from);
    }
  for (const ChosenContender& one : choice.near)
    found.push_back({one.rank, one.number});
  EXPECT_EQ(found, expected);
  EXPECT_EQ(choice.partners, std::vector<int>(partners.begin(), partners.end()));
}

/// Ranks that are no neighbours cannot be told of a contender. All ranks come through, and one of them says so.
TEST(ChooseApart, AMissingNeighbourIsFoundAndNobodyWaits) {
  const comm::Communicator world = comm::Communicator::world();
  const geometry::Periods none;
  Choosing choosing(world, none);
  const Choice without = choosing.choose();
  EXPECT_EQ(world.sum(std::int64_t{!without.is_whole}) > 0, world.size() > 1);
  EXPECT_TRUE(without.partners.empty());
  choosing.meet();
  EXPECT_TRUE(choosing.choose().is_whole);
}

TEST(ChooseApart, NoTwoAreNearEachOther) {
  expect_apart({});
}

TEST(ChooseApart, NorAcrossAPeriodicBorder) {
  expect_apart(testing::unit_torus().periods());
}

} // namespace
} // namespace trime::cleanup
