// SPDX-License-Identifier: BSD-3-Clause
// Stars computed on several ranks are those of one rank, from the start and while sites move and migrate.
#include "sites/site_state.hpp"
#include "support/distributed.hpp"
#include "support/moved_sites.hpp"
#include "support/star_checks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace trime::sites {
namespace {

using delaunay::gap;
using delaunay::StarBuilder;
using geometry::Vec2;
using mesh::Site;
using mesh::SiteList;
using testing::unit_lattice;

const geometry::Box square{{0, 0}, {1, 1}};

/// The rings of the owned sites of all ranks as positions: site, neighbours, end mark; gaps are marked too.
std::vector<Vec2> rings(const comm::Communicator& comm, const SiteState& state) {
  std::vector<Vec2> mine;
  for (LocalIndex i = 0; i < state.points().owned(); ++i) {
    mine.push_back(state.points().position(i));
    for (const LocalIndex a : state.stars().ring(i))
      mine.push_back(a == gap ? Vec2{-1, -1} : state.points().position(a));
    mine.push_back({-2, -2});
  }
  return testing::gather_all(comm, mine);
}

/// Grows linearly with the distance from the origin.
class GrowingSize final : public sizing::SizeField {
public:
  double size(Vec2 p) const override { return 0.005 + 0.11 * geometry::length(p); }
};

/// Moves every site by a step that is a function of its position, so that it is the same on any ranks.
void shake(SiteState& state, double step, std::uint64_t round) {
  SiteList sites;
  for (LocalIndex i = 0; i < state.points().owned(); ++i) {
    Site site = state.points().site(i);
    const std::uint64_t key = state.grid().point_key(site.position);
    const Vec2 q = unit_lattice().snap(site.position + step * (testing::random_vec2(20 + round, key) - Vec2{0.5, 0.5}));
    if (square.contains(q))
      site.position = q;
    sites.push_back(site);
  }
  std::vector<std::uint8_t> deleted(sites.size(), 0);
  for (std::size_t k = 0; k < sites.size(); ++k)
    deleted[k] = state.grid().point_key(sites[k].position) % 97 == round; // some die on the way
  testing::move_sites(state, sites, deleted);
}

void expect_equal_stars(const SiteList& sites, double spacing, const StarBuilder& builder, double step,
                        const sizing::SizeField& size = sizing::UniformSize()) {
  const comm::Communicator world = comm::Communicator::world(), self = comm::Communicator::self();
  const mesh::GridOptions options{{}, {}, spacing};
  SiteState distributed(world, square, options), serial(self, square, options);
  distributed.distribute(testing::dealt(world, sites));
  serial.distribute(sites);
  for (std::uint64_t round = 0; round < 4; ++round) {
    distributed.compute_stars(builder, size, Wanted::all_sites);
    serial.compute_stars(builder, size, Wanted::all_sites);
    for (LocalIndex i = 0; i < distributed.points().owned(); ++i)
      EXPECT_TRUE(distributed.stars().certain(i));
    EXPECT_EQ(rings(world, distributed), rings(self, serial)) << "round " << round;
    EXPECT_EQ(distributed.compute_stars(builder, size, Wanted::all_sites).rebuilt, 0) << "ghosts keep their indices";
    EXPECT_EQ(rings(world, distributed), rings(self, serial)) << "round " << round << ", asked again";
    shake(distributed, step, round);
    shake(serial, step, round);
  }
}

void expect_equal_stars(const SiteList& sites, double spacing, double cap, double step) {
  expect_equal_stars(sites, spacing, StarBuilder(unit_lattice(), cap), step);
}

TEST(DistributedStars, EqualThoseOfOneRank) {
  expect_equal_stars(testing::random_sites(800, 1), 0.036, 0.09, 0.01);
  expect_equal_stars(testing::hexagonal_lattice(20, 0.03), 0.03, 0.075, 1e-6);
  expect_equal_stars(testing::square_lattice(16, 0.04), 0.04, 0.1, 0);
}

TEST(DistributedStars, EqualThoseOfOneRankInUglySets) {
  expect_equal_stars(testing::clusters(200, 2), 0.07, 1, 1e-4);
  expect_equal_stars(testing::near_duplicates(100, 3), 0.07, 0.3, 1e-12);
  expect_equal_stars(testing::cocircular_rings(), 0.1, 1, 0);
  expect_equal_stars(testing::wheel(40, {0.5, 0.5}, 0.3), 0.1, 1, 1e-3);
  expect_equal_stars(testing::collinear(30), 0.1, 1, 0);
}

TEST(DistributedStars, EqualThoseOfOneRankWhereTheDensityVariesAThousandfold) {
  const StarBuilder builder(unit_lattice(), 2.5, 1.0);
  expect_equal_stars(testing::graded_sites(1500, 5), 0.03, builder, 0.002, GrowingSize());
  const comm::Communicator world = comm::Communicator::world();
  SiteState state(world, square, {{}, {}, 0.03});
  state.distribute(testing::dealt(world, testing::graded_sites(1500, 5)));
  int least = 99, most = 0;
  for (LocalIndex tile = 0; tile < state.grid().tile_count(); ++tile) {
    least = std::min(least, state.grid().tile(tile).bin_shift());
    most = std::max(most, state.grid().tile(tile).bin_shift());
  }
  EXPECT_GE(most - least, 3);
}

TEST(DistributedStars, EqualThoseOfOneRankInTinySets) {
  for (const std::size_t n : {0, 1, 2, 3, 5})
    expect_equal_stars(testing::random_sites(n, 4), 0.3, 1, 0.1);
}

TEST(DistributedStars, EveryTriangleIsInTheStarsOfItsOwnedCorners) {
  const comm::Communicator world = comm::Communicator::world();
  SiteState state(world, square, {{}, {}, 0.036});
  state.distribute(testing::dealt(world, testing::random_sites(800, 5)));
  state.compute_stars(StarBuilder(unit_lattice(), 0.09), sizing::UniformSize(), Wanted::all_sites);
  testing::expect_well_formed(state.points(), state.stars());
  testing::expect_consistent(state.points(), state.stars());
  std::int64_t listings = 0;
  for (LocalIndex i = 0; i < state.points().owned(); ++i)
    testing::for_each_triangle(state.stars(), i, [&](LocalIndex, LocalIndex) { ++listings; });
  EXPECT_EQ(world.sum(listings) % 3, 0);
}

TEST(DistributedStars, SizesAreKnownAtOwnedSitesAndGhosts) {
  const comm::Communicator world = comm::Communicator::world();
  SiteState state(world, square, {{}, {}, 0.036});
  state.distribute(testing::dealt(world, testing::random_sites(800, 5)));
  EXPECT_FALSE(state.sizes().known(0));
  const StarBuilder builder(unit_lattice(), 0.09);
  for (int round = 0; round < 2; ++round) {
    state.compute_stars(builder, GrowingSize(), Wanted::all_sites);
    EXPECT_TRUE(state.comm().size() == 1 || state.points().size() > state.points().owned());
    for (LocalIndex i = 0; i < state.points().size(); ++i) {
      ASSERT_TRUE(state.sizes().known(i));
      EXPECT_EQ(state.sizes()[i], GrowingSize().size(state.points().position(i)));
    }
    shake(state, 0.01, 0);
    EXPECT_FALSE(state.sizes().known(0)) << "the sites have moved";
  }
  state.compute_stars(builder, sizing::UniformSize(0.25), Wanted::all_sites);
  EXPECT_TRUE(state.sizes().is_uniform());
  EXPECT_EQ(state.sizes()[0], 0.25);
}

TEST(DistributedStars, OnlyInnerSitesHaveStarsIfOnlyTheyAreWanted) {
  const comm::Communicator world = comm::Communicator::world();
  SiteList sites = testing::random_sites(300, 6);
  for (std::size_t k = 0; k < sites.size(); k += 4)
    sites[k].boundary = static_cast<std::int32_t>(k);
  SiteState state(world, square, {{}, {}, 0.06});
  state.distribute(testing::dealt(world, sites));
  const StarBuilder builder(unit_lattice(), 0.3);
  state.compute_stars(builder, sizing::UniformSize(), Wanted::inner_sites);
  for (LocalIndex i = 0; i < state.points().owned(); ++i)
    EXPECT_EQ(state.stars().ring(i).empty(), state.points().boundary(i) >= 0);
  state.compute_stars(builder, sizing::UniformSize(), Wanted::all_sites);
  for (LocalIndex i = 0; i < state.points().owned(); ++i)
    EXPECT_FALSE(state.stars().ring(i).empty());
}

} // namespace
} // namespace trime::sites
