// SPDX-License-Identifier: BSD-3-Clause
// What the clean-up asks of the sites: places made known, single stars, and sites that come and go.
#include "sites/site_state.hpp"

#include "support/distributed.hpp"
#include "support/moved_sites.hpp"
#include "support/periodic_shapes.hpp"
#include "support/star_checks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>

namespace trime::sites {
namespace {

using delaunay::StarBuilder;
using delaunay::StarWish;
using geometry::Vec2;
using mesh::Site;
using mesh::SiteList;
using testing::unit_lattice;

const geometry::Box square{{0, 0}, {1, 1}};

class GrowingSize final : public sizing::SizeField {
public:
  double size(Vec2 p) const override { return 0.02 + 0.05 * p.x; }
};

std::vector<Vec2> sorted(std::vector<Vec2> points) {
  std::sort(points.begin(), points.end(), geometry::lexicographically_less);
  return points;
}

/// Places of the sites in a disc; counts the bins that are not known.
std::vector<Vec2> sites_in(const SiteState& state, const Disc& disc, int& unknown) {
  std::vector<Vec2> found;
  state.points().for_each_near(
      disc.center, disc.radius,
      [&](LocalIndex begin, LocalIndex end) {
        for (LocalIndex j = begin; j < end; ++j)
          if (geometry::length(state.points().position(j) - disc.center) < disc.radius)
            found.push_back(state.points().position(j));
      },
      [&](mesh::BinRef) { ++unknown; });
  return sorted(std::move(found));
}

/// Fetches all sites in the discs, with their sizes. Collective.
void reveal(SiteState& state, const std::vector<Disc>& discs, const sizing::SizeField& size) {
  std::vector<mesh::BinRef> missing;
  for (const Disc& disc : discs)
    state.points().for_each_near(
        disc.center, disc.radius, [](LocalIndex, LocalIndex) {}, [&](mesh::BinRef bin) { missing.push_back(bin); });
  std::sort(missing.begin(), missing.end());
  missing.erase(std::unique(missing.begin(), missing.end()), missing.end());
  state.fetch(missing, size);
}

void expect_revealed(const geometry::Periods& periods) {
  const comm::Communicator world = comm::Communicator::world(), self = comm::Communicator::self();
  const mesh::GridOptions options{{}, {}, 0.03, periods};
  const SiteList sites = testing::random_sites(1200, 3);
  SiteState distributed(world, square, options), serial(self, square, options);
  distributed.distribute(testing::dealt(world, sites));
  serial.distribute(sites);
  const GrowingSize size;
  const StarBuilder builder(unit_lattice(), 0.08);
  distributed.compute_stars(builder, size, Wanted::all_sites);
  serial.compute_stars(builder, size, Wanted::all_sites);
  std::vector<Disc> discs; // of each rank others, of the last one none
  for (std::uint64_t k = 0; k < 6 && world.rank() + 1 < std::max(2, world.size()); ++k)
    discs.push_back(
        {testing::random_vec2(40 + static_cast<std::uint64_t>(world.rank()), k), 0.05 + 0.07 * static_cast<double>(k)});
  const testing::TriangleSet before = testing::triangles_of(distributed.points(), distributed.stars());
  reveal(distributed, discs, size);
  reveal(serial, discs, size);
  int unknown = 0;
  for (const Disc& disc : discs) {
    EXPECT_EQ(sites_in(distributed, disc, unknown), sites_in(serial, disc, unknown));
    EXPECT_GT(sites_in(serial, disc, unknown).size(), 2u);
  }
  EXPECT_EQ(unknown, 0);
  for (LocalIndex i = 0; i < distributed.points().size(); ++i)
    EXPECT_EQ(distributed.sizes()[i], size.size(periods.wrap(distributed.points().position(i))));
  EXPECT_TRUE(testing::triangles_of(distributed.points(), distributed.stars()) == before) << "ghosts were renumbered";
}

TEST(SiteState, RevealedDiscsAreKnown) {
  expect_revealed({});
  expect_revealed(testing::unit_torus().periods());
}

/// Tiles sleep by what is known of the drift around them, so a halo that grows must not change it.
TEST(SiteState, AFetchKeepsTheDriftThatTheOwnersKnow) {
  const comm::Communicator world = comm::Communicator::world();
  const SiteList sites = testing::random_sites(3000, 3);
  SiteState state(world, square, {{}, {}, 0.03});
  state.distribute(testing::dealt(world, sites));
  const GrowingSize size;
  state.refresh(size);
  mesh::BinnedPoints& points = state.points();
  const auto drift_of = [](LocalIndex tile) { return tile % 3 == 0 ? 0 : 1e-4 * (1 + tile % 5); };
  prepare_to_stay(points);
  for (LocalIndex tile = points.first_tile(); tile < points.last_tile(); ++tile)
    points.drifts().set(points.known_tile(tile), drift_of(tile));
  state.begin_advance(size, {1e-3, 0.25}, false);
  state.finish_advance(size);
  std::vector<mesh::BinRef> missing;
  if (world.rank() == 0) // the others fetch nothing
    points.for_each_near(
        {0.5, 0.5}, 0.4, [](LocalIndex, LocalIndex) {}, [&](mesh::BinRef b) { missing.push_back(b); });
  std::sort(missing.begin(), missing.end());
  missing.erase(std::unique(missing.begin(), missing.end()), missing.end());
  EXPECT_EQ(missing.empty(), world.rank() > 0 || world.size() == 1);
  state.fetch(missing, size);
  for (LocalIndex ghost = points.owned(); ghost < points.size(); ++ghost) {
    const LocalIndex tile = points.grid().tile_at(points.position(ghost));
    EXPECT_EQ(points.drifts().of(points.known_tile(tile)), drift_of(tile));
  }
  EXPECT_EQ(points.size() > points.owned(), world.size() > 1);
}

/// Sites that come: also where another rank owns the tile. Those that go: every seventh.
TEST(SiteState, SitesComeAndGoInOneMove) {
  const comm::Communicator world = comm::Communicator::world(), self = comm::Communicator::self();
  const SiteList sites = testing::random_sites(900, 4);
  SiteState state(world, square, {{}, {}, 0.035}), serial(self, square, {{}, {}, 0.035});
  state.distribute(testing::dealt(world, sites));
  serial.distribute(sites);
  const StarBuilder builder(unit_lattice(), 0.1);
  const sizing::UniformSize uniform;
  for (std::uint64_t round = 0; round < 3; ++round) {
    const auto change = [&](SiteState& of, const SiteList& added) {
      SiteList all;
      std::vector<std::uint8_t> deleted;
      for (LocalIndex i = 0; i < of.points().owned(); ++i) {
        all.push_back(of.points().site(i));
        deleted.push_back(of.grid().point_key(all.back().position) % 7 == round);
      }
      all.insert(all.end(), added.begin(), added.end());
      deleted.resize(all.size(), 0);
      testing::move_sites(of, all, deleted);
    };
    const SiteList added = testing::random_sites(150, 50 + round);
    change(state, testing::dealt(world, added));
    change(serial, added);
    state.compute_stars(builder, uniform, Wanted::all_sites);
    serial.compute_stars(builder, uniform, Wanted::all_sites);
    const auto positions = [](const SiteState& of) {
      const auto owned = of.points().positions().first(static_cast<std::size_t>(of.points().owned()));
      return std::vector<Vec2>(owned.begin(), owned.end());
    };
    EXPECT_EQ(sorted(testing::gather_all(world, positions(state))), sorted(positions(serial)));
    EXPECT_LT(serial.points().owned(), 1300);
    const auto count = [](const SiteState& of) {
      std::int64_t sum = 0;
      for (LocalIndex i = 0; i < of.points().owned(); ++i)
        sum += static_cast<std::int64_t>(of.stars().ring(i).size());
      return sum;
    };
    EXPECT_EQ(world.sum(count(state)), count(serial));
  }
}

/// Counts how often it is asked.
class CountingSize final : public sizing::SizeField {
public:
  double size(Vec2 p) const override {
    ++count;
    return 0.02 + 0.05 * p.x;
  }
  mutable std::atomic<int> count = 0;
};

TEST(SiteState, SizesOfSitesThatStayAreNotEvaluatedAgain) {
  const comm::Communicator world = comm::Communicator::world();
  SiteState state(world, square, {{}, {}, 0.03});
  state.distribute(testing::dealt(world, testing::random_sites(1500, 8)));
  const CountingSize size;
  const StarBuilder builder(unit_lattice(), 0.08);
  state.compute_stars(builder, size, Wanted::all_sites);
  for (int round = 0; round < 3; ++round) {
    SiteList sites;
    std::vector<std::uint8_t> deleted;
    int moved = 0;
    for (LocalIndex i = 0; i < state.points().owned(); ++i) {
      sites.push_back(state.points().site(i));
      const std::uint64_t key = state.grid().point_key(sites.back().position) + static_cast<std::uint64_t>(round);
      deleted.push_back(key % 31 == 0);
      if (key % 17 == 0 && ++moved)
        sites.back().position = unit_lattice().snap(0.9 * sites.back().position + Vec2{0.05, 0.05});
    }
    const SiteList added = testing::dealt(world, testing::random_sites(20, 50 + round));
    sites.insert(sites.end(), added.begin(), added.end());
    deleted.resize(sites.size(), 0);
    testing::move_sites(state, sites, deleted);
    const std::int64_t changed = world.sum(std::int64_t{moved}) + 20;
    size.count = 0;
    state.compute_stars(builder, size, Wanted::all_sites);
    const std::int64_t ghosts = world.sum(std::int64_t{state.points().size() - state.points().owned()});
    EXPECT_LE(world.sum(std::int64_t{size.count}), changed + 3 * ghosts); // those are asked for in each round
    for (LocalIndex i = 0; i < state.points().size(); ++i)
      EXPECT_EQ(state.sizes()[i], 0.02 + 0.05 * state.points().position(i).x);
  }
}

/// After a small change, stars are computed around it only: those are as right as if all had been computed.
TEST(SiteState, OnlyTheStarsThatAreWishedForAreComputed) {
  const comm::Communicator world = comm::Communicator::world();
  const SiteList sites = testing::hexagonal_lattice(24, 0.03);
  SiteState state(world, square, {{}, {}, 0.03}), all(world, square, {{}, {}, 0.03});
  const StarBuilder builder(unit_lattice(), 0.08);
  const sizing::UniformSize uniform;
  const Vec2 center = sites[24 * 12 + 12].position, to = unit_lattice().snap(center + Vec2{0.008, 0.004});
  for (SiteState* of : {&state, &all}) {
    of->distribute(testing::dealt(world, sites));
    of->compute_stars(builder, uniform, Wanted::all_sites);
    SiteList moved;
    for (LocalIndex i = 0; i < of->points().owned(); ++i) {
      moved.push_back(of->points().site(i));
      if (moved.back().position == center)
        moved.back().position = to;
    }
    testing::move_sites(*of, moved, std::vector<std::uint8_t>(moved.size(), 0));
  }
  std::vector<StarWish> wanted;
  for (LocalIndex i = 0; i < state.points().owned(); ++i)
    wanted.push_back(geometry::length(state.points().position(i) - center) < 0.1 ? StarWish::compute : StarWish::leave);
  state.compute_stars(builder, uniform, wanted);
  all.compute_stars(builder, uniform, Wanted::all_sites);
  ASSERT_EQ(state.points().owned(), all.points().owned());
  for (LocalIndex i = 0; i < state.points().owned(); ++i) {
    const bool near = wanted[static_cast<std::size_t>(i)] == StarWish::compute;
    EXPECT_EQ(state.stars().certain(i), near);
    const auto places = [&](const SiteState& of) {
      std::vector<Vec2> ring;
      for (const LocalIndex j : of.stars().ring(i))
        ring.push_back(j == delaunay::gap ? Vec2{-1, -1} : of.points().position(j));
      return ring;
    };
    if (near) {
      EXPECT_EQ(places(state), places(all));
    }
  }
  EXPECT_GT(world.sum(std::count(wanted.begin(), wanted.end(), StarWish::compute)), 25);
  EXPECT_GT(world.sum(std::count(wanted.begin(), wanted.end(), StarWish::leave)), 400);
  state.compute_stars(builder, uniform, Wanted::all_sites);
  EXPECT_TRUE(testing::triangles_of(state.points(), state.stars()) == testing::triangles_of(all.points(), all.stars()));
}

/// The ring of a site as places.
std::vector<Vec2> ring_places(const SiteState& state, LocalIndex i) {
  std::vector<Vec2> ring;
  for (const LocalIndex j : state.stars().ring(i))
    ring.push_back(j == delaunay::gap ? Vec2{-1, -1} : state.points().position(j));
  return ring;
}

/// Edits of some places, in several rounds: a state that is edited, and one that is sorted and computed anew.
void expect_edits_as_moves(const geometry::Periods& periods, const sizing::SizeField& size) {
  const comm::Communicator world = comm::Communicator::world();
  const mesh::GridOptions options{{}, {}, 0.02, periods};
  const SiteList sites = testing::random_sites(4000, 4);
  SiteState edited(world, square, options), moved(world, square, options);
  const StarBuilder builder(unit_lattice(), 2.5, 0.08);
  for (SiteState* of : {&edited, &moved}) {
    of->distribute(testing::dealt(world, sites));
    of->compute_stars(builder, size, Wanted::all_sites);
    of->points().release_leads();
  }
  std::int64_t kept = 0, doubted = 0;
  for (std::uint64_t round = 0; round < 3; ++round) {
    const auto is_near = [&](Vec2 p) {
      return geometry::length(p - Vec2{0.5, 0.45}) < 0.06 || geometry::length(p - Vec2{0.02, 0.8}) < 0.05;
    };
    std::vector<std::uint8_t> deleted;
    std::vector<LocalIndex> gone;
    for (LocalIndex i = 0; i < edited.points().owned(); ++i) {
      const Vec2 p = edited.points().position(i);
      deleted.push_back(is_near(p) && edited.grid().point_key(p) % 3 == round);
      if (deleted.back())
        gone.push_back(i);
    }
    SiteList come;
    std::vector<double> sizes;
    for (const mesh::Site& site : testing::random_sites(4000, 70 + round))
      if (is_near(site.position) && edited.partition().owner(edited.grid().tile_at(site.position)) == world.rank()) {
        come.push_back(site);
        sizes.push_back(size.size(site.position));
      }
    edited.edit_sites(builder, gone, come, sizes);
    prepare_to_stay(moved.points());
    moved.move_sites(deleted, come);
    moved.compute_stars(builder, size, Wanted::all_sites);
    ASSERT_EQ(edited.points().owned(), moved.points().owned());
    for (LocalIndex i = 0; i < edited.points().owned(); ++i) {
      EXPECT_EQ(edited.points().position(i), moved.points().position(i));
      EXPECT_EQ(edited.sizes()[i], moved.sizes()[i]);
      ++(edited.stars().certain(i) ? kept : doubted);
      if (edited.stars().certain(i)) {
        EXPECT_EQ(ring_places(edited, i), ring_places(moved, i));
      }
    }
    edited.compute_stars(builder, size, Wanted::all_sites);
    for (LocalIndex i = 0; i < edited.points().owned(); ++i)
      EXPECT_EQ(ring_places(edited, i), ring_places(moved, i));
  }
  kept = world.sum(kept);
  doubted = world.sum(doubted);
  EXPECT_GT(doubted, 200);
  EXPECT_EQ(kept > 5 * doubted, !periods.any());
  EXPECT_EQ(kept == 0, periods.any()); // images are not looked at
}

TEST(SiteState, EditsComeToWhatAMoveComesTo) {
  expect_edits_as_moves({}, GrowingSize());
  expect_edits_as_moves({}, sizing::UniformSize(0.016));
  expect_edits_as_moves(testing::unit_torus().periods(), sizing::UniformSize(0.016));
}

} // namespace
} // namespace trime::sites
