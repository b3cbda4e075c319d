// SPDX-License-Identifier: BSD-3-Clause
// The DistMesh rule and the sums that steer it.
#include "support/point_sets.hpp"
#include "trime/delaunay/star_builder.hpp"
#include "trime/meshing/update_rule.hpp"

#include <gtest/gtest.h>

namespace trime::meshing {
namespace {

using geometry::Vec2;
using mesh::Site;
using testing::OnThreads;

constexpr double spacing = 0.03125;

/// Sites with their stars; sites marked as boundary do not move.
struct Cloud {
  explicit Cloud(const std::vector<Site>& sites, double h = spacing)
      : grid(geometry::Box{{0, 0}, {1, 1}}, {{}, {}, spacing}), points(grid), size(h) {
    points.assign_owned(sites, 0, grid.tile_count());
    stars.reset(points.owned());
    std::vector<mesh::BinRef> missing;
    delaunay::StarBuilder(testing::unit_lattice(), 2.5 * spacing).update(points, stars, {}, {}, missing);
  }
  StarView view() const { return {points, stars, size}; }
  /// The site nearest to the middle.
  LocalIndex middle() const {
    LocalIndex best = 0;
    for (LocalIndex i = 0; i < points.owned(); ++i)
      if (geometry::length(points.position(i) - Vec2{0.5, 0.5}) <
          geometry::length(points.position(best) - Vec2{0.5, 0.5}))
        best = i;
    return best;
  }

  mesh::TileGrid grid;
  mesh::BinnedPoints points;
  delaunay::StarTable stars;
  sizing::UniformSize size;
};

std::vector<Site> lattice(double jitter = 0) {
  std::vector<Site> sites = testing::hexagonal_lattice(24, spacing);
  for (std::size_t k = 0; k < sites.size(); ++k)
    sites[k].position = testing::unit_lattice().snap(
        sites[k].position + (jitter * spacing) * (testing::random_vec2(4, k) - Vec2{0.5, 0.5}));
  return sites;
}

TEST(SweepSums, OfAPerfectLattice) {
  const Cloud cloud(lattice());
  const SweepSums sums = measure(cloud.view(), spacing);
  // 24 rows of 24: two triangles in each of 23 x 23 rhombi, and half of the ragged ends are small enough to count.
  EXPECT_GE(sums.triangles, 2 * 23 * 23);
  EXPECT_NEAR(sums.squared_length_ratio.value() / sums.squared_size_ratio.value(), 1, 0.1);
  EXPECT_LT(sums.excess_alpha.value() / static_cast<double>(sums.triangles), 0.05);
}

TEST(SweepSums, DoNotDependOnThreadsAndCountEachTriangleOnce) {
  const Cloud cloud(lattice(0.5));
  std::int64_t triangles = 0;
  for (LocalIndex i = 0; i < cloud.points.owned(); ++i) {
    const auto ring = cloud.stars.ring(i);
    for (std::size_t k = 0; k < ring.size(); ++k)
      triangles += ring[k] != delaunay::gap && ring[(k + 1) % ring.size()] != delaunay::gap;
  }
  const OnThreads one(1);
  const SweepSums reference = measure(cloud.view(), spacing);
  EXPECT_EQ(3 * reference.triangles, triangles);
  const OnThreads four(4);
  const SweepSums sums = measure(cloud.view(), spacing);
  EXPECT_EQ(sums.squared_length_ratio.value(), reference.squared_length_ratio.value());
  EXPECT_EQ(sums.squared_size_ratio.value(), reference.squared_size_ratio.value());
  EXPECT_EQ(sums.excess_alpha.value(), reference.excess_alpha.value());
  EXPECT_EQ(sums.max_alpha, reference.max_alpha);
}

TEST(SweepSums, TrianglesAmongBoundarySitesAreNotMeasured) {
  std::vector<Site> sites = lattice();
  for (std::size_t k = 0; k < sites.size(); ++k)
    sites[k].boundary = static_cast<std::int32_t>(k);
  const Cloud all(sites);
  EXPECT_EQ(measure(all.view(), spacing).triangles, 0);
  EXPECT_EQ(measure(all.view(), spacing).squared_size_ratio.value(), 0);
  const LocalIndex i = all.middle();
  const std::int32_t k = all.points.boundary(i);
  sites[static_cast<std::size_t>(k)].boundary = -1;
  EXPECT_EQ(measure(Cloud(sites).view(), spacing).triangles, 6);
}

TEST(DistMeshRule, LeavesAPerfectLatticeAlone) {
  const Cloud cloud(lattice());
  DistMeshRule rule;
  rule.begin_sweep(measure(cloud.view(), spacing));
  EXPECT_LT(geometry::length(rule.displacement(cloud.view(), cloud.middle())), 1e-8 * spacing);
}

TEST(DistMeshRule, PushesASiteAwayFromTheNeighbourItCameTooNear) {
  std::vector<Site> sites = lattice();
  const Cloud before(sites);
  const Vec2 middle = before.points.position(before.middle());
  for (Site& site : sites)
    if (site.position == middle)
      site.position = testing::unit_lattice().snap(middle + Vec2{0.2 * spacing, 0});
  const Cloud cloud(sites);
  DistMeshRule rule;
  rule.begin_sweep(measure(cloud.view(), spacing));
  const Vec2 back = rule.displacement(cloud.view(), cloud.middle());
  EXPECT_LT(back.x, -0.01 * spacing);
  EXPECT_GT(back.x, -0.4 * spacing);
  EXPECT_NEAR(back.y, 0, 0.01 * spacing);
}

TEST(DistMeshRule, WhatABarDoesToOneEndItDoesReversedToTheOther) {
  const Cloud cloud(lattice(0.7)); // all sites are inner: the forces of all bars cancel
  DistMeshRule rule;
  rule.begin_sweep(measure(cloud.view(), spacing));
  Vec2 sum;
  double lengths = 0;
  for (LocalIndex i = 0; i < cloud.points.owned(); ++i) {
    sum = sum + rule.displacement(cloud.view(), i);
    lengths += geometry::length(rule.displacement(cloud.view(), i));
  }
  EXPECT_GT(lengths, spacing);
  EXPECT_LT(geometry::length(sum), 1e-12 * lengths);
}

TEST(DistMeshRule, BarsLongerThanTheirRestLengthDoNotPull) {
  const Cloud cloud(lattice(0.3), 1e-3 * spacing);
  DistMeshRule rule;
  rule.begin_sweep({}); // no bars at all: the rest length is 1.2 h
  for (LocalIndex i = 0; i < cloud.points.owned(); ++i)
    EXPECT_EQ(rule.displacement(cloud.view(), i), (Vec2{0, 0}));
}

} // namespace
} // namespace trime::meshing
