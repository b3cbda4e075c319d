// SPDX-License-Identifier: BSD-3-Clause
#include "boundary/short_edges.hpp"

#include <gtest/gtest.h>

#include <array>

namespace trime::boundary {
namespace {

using geometry::Vec2;

/// A loop with these sites.
polygon::BoundarySites loop_of(const std::vector<Vec2>& places) {
  polygon::BoundarySites boundary;
  const auto n = static_cast<LocalIndex>(places.size());
  for (LocalIndex k = 0; k < n; ++k) {
    polygon::BoundarySite site{};
    site.position = places[static_cast<std::size_t>(k)];
    site.previous = (k + n - 1) % n;
    site.next = (k + 1) % n;
    boundary.sites.push_back(site);
  }
  boundary.loop_start = {0, n};
  return boundary;
}

TEST(ShortEdges, FindsEdgesAndSitesAcross) {
  // A slit of width 0.02 that ends in a short edge; its sides have one pair of sites that face each other.
  const polygon::BoundarySites boundary =
      loop_of({{0, 0}, {1, 0}, {1, 0.4}, {0.7, 0.4}, {0.3, 0.4}, {0.3, 0.42}, {0.7, 0.42}, {1, 0.42}, {1, 1}, {0, 1}});
  const comm::Communicator world = comm::Communicator::world();
  const std::vector<geometry::ShortEdge> found = short_edges(world, boundary, 0.1);
  const std::array expected{Vec2{1, 0.41}, Vec2{0.7, 0.41}, Vec2{0.3, 0.41}};
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k) {
    EXPECT_LT(geometry::length(found[k].middle - expected[k]), 1e-15);
    EXPECT_NEAR(found[k].length, 0.02, 1e-15);
  }
  EXPECT_TRUE(short_edges(world, boundary, 0.015).empty());
}

} // namespace
} // namespace trime::boundary
