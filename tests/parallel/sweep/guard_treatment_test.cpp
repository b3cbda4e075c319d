// SPDX-License-Identifier: BSD-3-Clause
// Sites in the discs of the boundary are pushed out or go, the same on any ranks.
#include "sweep/guard_treatment.hpp"

#include "support/boundary_shapes.hpp"
#include "support/distributed.hpp"
#include "support/laid_sites.hpp"
#include "support/point_sets.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace trime::sweep {
namespace {

using geometry::Vec2;
using mesh::Site;
using mesh::SiteList;
using polygon::BoundaryGuard;
using polygon::BoundarySites;
using sites::SiteState;
using testing::make_boundary_sites;
using testing::unit_lattice;

struct Settled {
  bool any = false, again = false;
  std::vector<Vec2> places; // of all ranks
};

Settled settle(const comm::Communicator& comm, const SiteList& sites, const BoundaryGuard& guard) {
  SiteState state(comm, {{0, 0}, {1, 1}}, {{}, {}, 0.03});
  state.distribute(testing::dealt(comm, sites));
  const sizing::UniformSize size(0.05);
  const MoveContext context{guard, size, unit_lattice()};
  Settled result;
  result.any = settle_sites(state, context, 0.05);
  std::vector<Vec2> own;
  for (LocalIndex i = 0; i < state.points().owned(); ++i) {
    own.push_back(state.points().position(i));
    if (state.points().boundary(i) == mesh::free_site) {
      EXPECT_FALSE(guard.correct(own.back(), 0.05, unit_lattice())) << own.back().x << " " << own.back().y;
    }
  }
  result.places = testing::gather_all(comm, own);
  std::sort(result.places.begin(), result.places.end(), geometry::lexicographically_less);
  result.again = settle_sites(state, context, 0.05);
  return result;
}

TEST(SettleSites, EmptiesAllDiscsOnceAndForAll) {
  const geometry::Boundary boundary = testing::boundary_of(
      {testing::polygon_loop({{0.125, 0.125}, {0.875, 0.125}, {0.875, 0.875}, {0.5, 0.2}, {0.125, 0.875}}),
       testing::circle_loop({0.3, 0.3}, 0.08, true, 4, 2)});
  const BoundarySites on_boundary = make_boundary_sites(boundary, sizing::UniformSize(0.05), unit_lattice(), 30);
  const BoundaryGuard guard(on_boundary, unit_lattice());
  SiteList sites = testing::random_sites(1500, 5), clear;
  for (std::size_t k = 0; k < on_boundary.sites.size(); ++k)
    sites.push_back({on_boundary.sites[k].position, static_cast<std::int32_t>(k)});
  for (const Site& site : sites)
    if (site.boundary >= 0 || !guard.correct(site.position, 0.05, unit_lattice()))
      clear.push_back(site);
  const comm::Communicator world = comm::Communicator::world();
  const Settled settled = settle(world, sites, guard);
  EXPECT_TRUE(settled.any);
  EXPECT_FALSE(settled.again);
  EXPECT_GT(settled.places.size(), clear.size());
  EXPECT_LE(settled.places.size(), sites.size());
  EXPECT_EQ(settled.places, settle(comm::Communicator::self(), sites, guard).places);
  for (const Site& site : clear)
    EXPECT_TRUE(std::binary_search(settled.places.begin(), settled.places.end(), site.position,
                                   geometry::lexicographically_less))
        << "nobody else moves";
  EXPECT_FALSE(settle(world, clear, guard).any);
}

} // namespace
} // namespace trime::sweep
