// SPDX-License-Identifier: BSD-3-Clause
// Who makes which sites: shared out by what a lattice holds, none of them has to move.
#include "placing/lattice_start.hpp"
#include "placing/work_share.hpp"
#include "support/distributed.hpp"
#include "support/laid_sites.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <utility>

namespace trime::placing {
namespace {

using testing::unit_lattice;

constexpr double spacing = 0.004;

/// A square with a round hole, without inner sites.
struct Layout {
  Layout(const comm::Communicator& comm, const geometry::Boundary& boundary, const sizing::SizeField& size) {
    stage.polygon = testing::make_boundary_sites(boundary, size, unit_lattice(), 30);
    stage.guard = std::make_unique<polygon::BoundaryGuard>(stage.polygon, unit_lattice());
    stage.state =
        std::make_unique<sites::SiteState>(comm, geometry::Box{{0, 0}, {1, 1}}, mesh::GridOptions{{}, {}, spacing, {}});
    share_by_density(stage, size, unit_lattice(), 1);
  }
  /// The runs with which ranks are to begin, and how often tiles were counted.
  std::pair<LatticeRuns, int> share(const LatticeStart& lattice) {
    LatticeRuns runs = lattice.runs(own_share(stage), spacing);
    int rounds = 0;
    for (bool shared = false; !shared && rounds < 32; ++rounds) {
      shared = share_by_count(stage, runs.counts());
      runs = lattice.runs(own_share(stage), spacing);
    }
    return {std::move(runs), rounds};
  }
  void add_boundary(mesh::SiteList& sites) const {
    const mesh::TileRange tiles = own_share(stage);
    for (std::size_t b = 0; b < stage.polygon.sites.size(); ++b)
      if (const LocalIndex tile = tiles.grid.place(stage.polygon.sites[b].position).tile;
          tile >= tiles.first && tile < tiles.last)
        sites.push_back({stage.polygon.sites[b].position, static_cast<std::int32_t>(b)});
  }

  sites::Stage stage;
};

TEST(WorkShare, NoSiteOfALatticeMovesAfterItsTilesWereCounted) {
  const comm::Communicator world = comm::Communicator::world();
  const geometry::Boundary boundary =
      testing::boundary_of({testing::polygon_loop({{0.125, 0.125}, {0.875, 0.125}, {0.875, 0.875}, {0.125, 0.875}}),
                            testing::circle_loop({0.5, 0.5}, 0.2, true, 4, 2)});
  const sizing::UniformSize size(spacing);
  Layout layout(world, boundary, size);
  const LatticeStart lattice(boundary, *layout.stage.guard, unit_lattice());
  const std::int64_t all = world.sum(lattice.runs(own_share(layout.stage), spacing).count());
  const auto [runs, rounds] = layout.share(lattice);
  EXPECT_LT(rounds, 8);
  EXPECT_EQ(world.sum(runs.count()), all);
  mesh::SiteList sites = lattice.sites(runs);
  layout.add_boundary(sites);
  const std::ptrdiff_t made = std::ssize(sites);
  world.counters().take();
  layout.stage.state->distribute(std::move(sites));
  EXPECT_EQ(world.counters().take()[Counter::sites_migrated], 0);
  EXPECT_EQ(layout.stage.state->points().owned(), made);
  EXPECT_LT(static_cast<double>(world.max(std::int64_t{made})), 1.2 * static_cast<double>(all) / world.size() + 500);
}

TEST(WorkShare, TilesByCountAreThoseOfOneRank) {
  const comm::Communicator world = comm::Communicator::world(), self = comm::Communicator::self();
  const geometry::Boundary boundary = testing::boundary_of({testing::circle_loop({0.5, 0.5}, 0.3, false)});
  const sizing::UniformSize size(spacing);
  const auto tiles_on = [&](const comm::Communicator& comm) {
    Layout layout(comm, boundary, size);
    layout.share(LatticeStart(boundary, *layout.stage.guard, unit_lattice()));
    return layout.stage.state->grid().tiles();
  };
  const std::vector<mesh::Tile> shared = tiles_on(world), alone = tiles_on(self);
  EXPECT_TRUE(std::equal(
      shared.begin(), shared.end(), alone.begin(), alone.end(),
      [](const mesh::Tile& a, const mesh::Tile& b) { return a.x == b.x && a.y == b.y && a.shift == b.shift; }));
}

} // namespace
} // namespace trime::placing
