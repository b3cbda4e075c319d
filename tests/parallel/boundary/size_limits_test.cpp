// SPDX-License-Identifier: BSD-3-Clause
// Limits of the size that ranks find together are those that one finds alone, bit for bit.
#include "boundary/size_limits.hpp"

#include "support/boundary_shapes.hpp"
#include "support/laid_sites.hpp"

#include <gtest/gtest.h>

namespace trime::boundary {
namespace {

using geometry::Vec2;

TEST(SizeLimits, DoNotDependOnTheRanks) {
  const comm::Communicator world = comm::Communicator::world();
  // Channels between teeth, each narrower than the one before.
  std::vector<Vec2> comb{{0.1, 0.1}, {0.9, 0.1}};
  for (int k = 0; k < 6; ++k) {
    const double right = 0.9 - 0.13 * k, gap = 0.06 / (k + 1);
    comb.insert(comb.end(), {{right, 0.8}, {right - 0.05, 0.8}, {right - 0.05, 0.2}, {right - 0.05 - gap, 0.2}});
  }
  comb.push_back({0.1, 0.8});
  const geometry::Boundary boundary = testing::boundary_of({testing::polygon_loop(comb)});
  for (const double h : {0.1, 0.03}) {
    const sizing::UniformSize size(h);
    const polygon::BoundarySites sites = testing::make_boundary_sites(boundary, size, testing::unit_lattice(), 30);
    const auto alone = size_limits(sites, size, size, 0.2), together = size_limits(world, sites, size, size, 0.2);
    ASSERT_FALSE(alone.empty());
    ASSERT_EQ(together.size(), alone.size());
    for (std::size_t k = 0; k < alone.size(); ++k) {
      EXPECT_EQ(together[k].place, alone[k].place);
      EXPECT_EQ(together[k].size, alone[k].size);
    }
  }
}

} // namespace
} // namespace trime::boundary
