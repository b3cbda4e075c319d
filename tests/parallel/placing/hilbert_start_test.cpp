// SPDX-License-Identifier: BSD-3-Clause
// The quantile start: the exact number of sites, spread by h, the same on any ranks.
#include "decomposition/partition.hpp"
#include "placing/hilbert_start.hpp"
#include "support/distributed.hpp"
#include "support/laid_sites.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace trime::placing {
namespace {

using geometry::Vec2;
using mesh::Site;
using mesh::SiteList;
using polygon::BoundaryGuard;
using polygon::BoundarySites;
using testing::make_boundary_sites;
using testing::unit_lattice;

class GradedSize final : public sizing::SizeField {
public:
  double size(Vec2 p) const override { return 0.02 * (1 + 3 * p.x); }
};

/// A square with a round hole; graded size.
struct Stage {
  Stage()
      : boundary(testing::boundary_of(
            {testing::polygon_loop({{0.125, 0.125}, {0.875, 0.125}, {0.875, 0.875}, {0.125, 0.875}}),
             testing::circle_loop({0.5, 0.5}, 0.2, true, 4, 2)})),
        sites(make_boundary_sites(boundary, size, unit_lattice(), 30)), guard(sites, unit_lattice()),
        grid(geometry::Box{{0, 0}, {1, 1}}, {{}, {}, 0.04}) {}

  /// The sites of all ranks, if rank r fills tiles cuts[r] .. cuts[r + 1].
  SiteList start(const comm::Communicator& comm, const decomposition::Partition& split, std::int64_t n,
                 std::uint64_t seed = 1) const {
    const mesh::TileRange tiles{grid, split.first_tile(comm.rank()), split.last_tile(comm.rank())};
    const HilbertStart hilbert(comm, tiles, guard, size, unit_lattice(), static_cast<double>(n));
    const std::vector<Site> all = testing::gather_all(comm, hilbert.sites(n, seed));
    return {all.begin(), all.end()};
  }

  geometry::Boundary boundary;
  GradedSize size;
  BoundarySites sites;
  BoundaryGuard guard;
  mesh::TileGrid grid;
};

bool same(const SiteList& a, const SiteList& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Site& s, const Site& t) { return s.position == t.position; });
}

TEST(HilbertStart, MakesExactlyTheNumberAskedForAndTheSameOnAnySplit) {
  const comm::Communicator world = comm::Communicator::world(), self = comm::Communicator::self();
  const Stage stage;
  const LocalIndex tiles = stage.grid.tile_count();
  std::vector<std::int64_t> last_only(static_cast<std::size_t>(tiles), 0);
  last_only.back() = 1;
  for (const std::int64_t n : {0, 1, 17, 1000}) {
    const SiteList serial = stage.start(self, decomposition::Partition(tiles, 1), n);
    EXPECT_EQ(static_cast<std::int64_t>(serial.size()), n);
    EXPECT_TRUE(same(stage.start(world, decomposition::Partition(tiles, world.size()), n), serial));
    EXPECT_TRUE(same(stage.start(world, decomposition::Partition(last_only, world.size()), n), serial));
    const testing::OnThreads on(3);
    EXPECT_TRUE(same(stage.start(world, decomposition::Partition(tiles, world.size()), n), serial));
  }
}

TEST(HilbertStart, FollowsTheSizeFieldAndTheSeed) {
  const comm::Communicator self = comm::Communicator::self();
  const Stage stage;
  const decomposition::Partition all(stage.grid.tile_count(), 1);
  const SiteList sites = stage.start(self, all, 1000);
  EXPECT_FALSE(same(stage.start(self, all, 1000, 2), sites));
  std::int64_t fine = 0, coarse = 0;
  for (const Site& site : sites) {
    EXPECT_EQ(unit_lattice().snap(site.position), site.position);
    fine += site.position.x < 0.3;
    coarse += site.position.x > 0.7;
  }
  // The integral of h^-2 over the two strips is as 4.3 to 1; the free strip along the boundary takes more of the
  // coarse.
  EXPECT_GT(static_cast<double>(fine) / static_cast<double>(coarse), 3.9);
  EXPECT_LT(static_cast<double>(fine) / static_cast<double>(coarse), 5.8);
}

} // namespace
} // namespace trime::placing
