// SPDX-License-Identifier: BSD-3-Clause
// The lattice start: regular, clear of the boundary, and the same set however the tiles are split.
#include "placing/lattice_start.hpp"
#include "support/laid_sites.hpp"
#include "support/periodic_shapes.hpp"
#include "support/point_sets.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace trime::placing {
namespace {

using geometry::Vec2;
using mesh::Site;
using mesh::SiteList;
using polygon::BoundaryGuard;
using polygon::BoundarySites;
using testing::make_boundary_sites;
using testing::unit_lattice;

/// A shape with all that a start needs.
struct Stage {
  explicit Stage(std::vector<geometry::Loop> loops, double h)
      : boundary(testing::boundary_of(std::move(loops))), size(h),
        sites(make_boundary_sites(boundary, size, unit_lattice(), 30)), guard(sites, unit_lattice()),
        grid(geometry::Box{{0, 0}, {1, 1}}, {{}, {}, h}), start(boundary, guard, unit_lattice()) {}
  SiteList all(double spacing) const { return start.sites({grid, 0, grid.tile_count()}, spacing); }

  geometry::Boundary boundary;
  sizing::UniformSize size;
  BoundarySites sites;
  BoundaryGuard guard;
  mesh::TileGrid grid;
  LatticeStart start;
};

std::vector<geometry::Loop> tilted_square() {
  return {testing::polygon_loop({{0.2, 0.1}, {0.9, 0.25}, {0.75, 0.9}, {0.1, 0.8}})};
}
std::vector<geometry::Loop> ring() {
  return {testing::circle_loop({0.5, 0.5}, 0.4), testing::circle_loop({0.45, 0.5}, 0.15, true, 4, 2)};
}

double smallest_distance(const SiteList& sites) {
  double smallest = INFINITY;
  for (std::size_t i = 0; i < sites.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      smallest = std::min(smallest, geometry::length(sites[i].position - sites[j].position));
  return smallest;
}

TEST(LatticeStart, SitesAreASpacingApartAndClearOfTheBoundary) {
  for (const auto& loops : {tilted_square(), ring()}) {
    const double h = 0.04;
    const Stage stage(loops, h);
    const SiteList sites = stage.all(h);
    ASSERT_GT(sites.size(), 100u);
    EXPECT_NEAR(smallest_distance(sites), h, 1e-9 * h);
    for (const Site& site : sites) {
      EXPECT_EQ(site.boundary, -1);
      EXPECT_EQ(unit_lattice().snap(site.position), site.position);
      EXPECT_TRUE(stage.guard.inside(site.position));
      EXPECT_FALSE(stage.guard.encroaches(site.position));
      EXPECT_GE(stage.guard.distance(site.position, h), 0.45 * h * (1 - 1e-12));
    }
  }
}

TEST(LatticeStart, LeavesNoHoles) {
  const double h = 0.04;
  const Stage stage(ring(), h);
  const SiteList sites = stage.all(h);
  for (std::uint64_t key = 0; key < 500; ++key) {
    const Vec2 p = testing::random_vec2(1, key);
    if (!stage.guard.inside(p) || stage.guard.distance(p, 2 * h) < 1.1 * h)
      continue; // a lattice triangle around p stays within 0.58 h of it
    const auto near = [&](const Site& site) { return geometry::length(site.position - p) < 0.5774 * h * (1 + 1e-9); };
    EXPECT_TRUE(std::any_of(sites.begin(), sites.end(), near)) << p.x << ' ' << p.y;
  }
}

TEST(LatticeStart, RowsRunAlongTheLongestSideOneRowHeightFromIt) {
  const double h = 0.05;
  const Stage stage({testing::polygon_loop({{0.125, 0.125}, {0.875, 0.125}, {0.875, 0.5}, {0.125, 0.5}})}, h);
  double lowest = 1;
  for (const Site& site : stage.all(h))
    lowest = std::min(lowest, site.position.y);
  EXPECT_NEAR(lowest, 0.125 + std::sqrt(0.75) * h, 1e-9);
}

TEST(LatticeStart, IsTheSameForEverySplitOfTheTilesAndAnyThreads) {
  const double h = 0.03;
  const Stage stage(tilted_square(), h);
  const SiteList whole = stage.all(h);
  const LocalIndex tiles = stage.grid.tile_count();
  for (const LocalIndex cut : {LocalIndex{0}, LocalIndex{1}, static_cast<LocalIndex>(tiles / 3), tiles}) {
    const testing::OnThreads on(cut % 2 == 0 ? 3 : 1);
    SiteList joined = stage.start.sites({stage.grid, 0, cut}, h);
    const SiteList rest = stage.start.sites({stage.grid, cut, tiles}, h);
    EXPECT_EQ(stage.start.runs({stage.grid, 0, cut}, h).count(), static_cast<std::int64_t>(joined.size()));
    joined.insert(joined.end(), rest.begin(), rest.end());
    ASSERT_EQ(joined.size(), whole.size());
    for (std::size_t k = 0; k < whole.size(); ++k)
      EXPECT_EQ(joined[k].position, whole[k].position);
  }
}

/// The same for a shape in a periodic container, with tiles over all of it.
struct PeriodicStage {
  PeriodicStage(const shape::RegionShape& whole, double h)
      : shape(whole), size(h), sites(make_boundary_sites(shape.boundary(), size, shape.frame().lattice(), 30)),
        guard(sites, shape.frame().lattice()), grid(shape.frame().inner(), {{}, {}, h}),
        start(shape.boundary(), guard, shape.frame().lattice()) {}
  SiteList all(double spacing) const { return start.sites({grid, 0, grid.tile_count()}, spacing); }
  double distance(Vec2 p, Vec2 q) const { return geometry::length(shape.frame().periods().nearest_image(q, p) - p); }

  shape::RegionShape shape;
  sizing::UniformSize size;
  BoundarySites sites;
  BoundaryGuard guard;
  mesh::TileGrid grid;
  LatticeStart start;
};

shape::RegionShape hexagonal_torus(int columns, int rows, bool turned = false) {
  geometry::Box box = testing::hexagonal_container(columns, rows);
  if (turned)
    box.max = {box.max.y, box.max.x};
  return {{}, "domain", geometry::Frame(box, true, true)};
}

TEST(PeriodicLatticeStart, ATorusThatTheLatticeFitsIsFilledExactly) {
  for (const auto& [columns, rows] : {std::pair{12, 10}, {7, 8}, {40, 46}, {5, 30}})
    for (const bool turned : {false, true}) {
      const double h = 1.0 / columns;
      const PeriodicStage stage(hexagonal_torus(columns, rows, turned), h);
      const SiteList sites = stage.all(h);
      ASSERT_EQ(sites.size(), static_cast<std::size_t>(columns * rows));
      for (std::size_t i = 0; i < sites.size(); ++i) {
        int neighbours = 0;
        for (std::size_t j = 0; j < sites.size(); ++j)
          if (j != i) {
            const double distance = stage.distance(sites[i].position, sites[j].position);
            ASSERT_GT(distance, h * (1 - 1e-11));
            neighbours += distance < h * (1 + 1e-11) ? 1 : 0;
          }
        EXPECT_EQ(neighbours, 6);
      }
    }
}

TEST(PeriodicLatticeStart, AnyTorusGetsNearlyTheWantedNumberOfNearlyEquilateralTriangles) {
  for (const double height : {1.0, 0.37, 2.9})
    for (const int wanted : {100, 999, 5000}) {
      const double h = std::sqrt(height / (std::sqrt(0.75) * wanted));
      const PeriodicStage stage({{}, "domain", geometry::Frame({{-0.3, 2}, {0.7, 2 + height}}, true, true)}, h);
      const SiteList sites = stage.all(h);
      EXPECT_LE(std::ssize(sites), wanted);
      EXPECT_GE(std::ssize(sites), wanted * (wanted > 500 ? 0.985 : 0.95));
      std::size_t few = std::min<std::size_t>(sites.size(), 300);
      for (std::size_t i = 0; i < few; ++i) {
        double nearest = INFINITY;
        for (std::size_t j = 0; j < sites.size(); ++j)
          if (j != i)
            nearest = std::min(nearest, stage.distance(sites[i].position, sites[j].position));
        ASSERT_GT(nearest, (wanted > 500 ? 0.95 : 0.9) * h);
        ASSERT_LT(nearest, 1.05 * h);
      }
    }
}

TEST(PeriodicLatticeStart, IsTheSameForEverySplitAndFillsAllShapesUpToTheirBoundary) {
  for (const shape::RegionShape& shape : testing::periodic_shapes()) {
    SCOPED_TRACE(shape.region().text());
    const double h = 0.03;
    const PeriodicStage stage(shape, h);
    const SiteList whole = stage.all(h);
    const LocalIndex tiles = stage.grid.tile_count(), cut = tiles / 3;
    SiteList joined = stage.start.sites({stage.grid, 0, cut}, h);
    const SiteList rest = stage.start.sites({stage.grid, cut, tiles}, h);
    joined.insert(joined.end(), rest.begin(), rest.end());
    ASSERT_EQ(joined.size(), whole.size());
    EXPECT_EQ(stage.start.runs({stage.grid, 0, tiles}, h).count(), std::ssize(whole));
    for (std::size_t k = 0; k < whole.size(); ++k) {
      ASSERT_EQ(joined[k].position, whole[k].position);
      EXPECT_TRUE(stage.guard.inside(whole[k].position));
      EXPECT_FALSE(stage.guard.encroaches(whole[k].position));
    }
    for (std::uint64_t key = 0; key < 300; ++key) {
      const Vec2 p = testing::random_vec2(1, key);
      if (!stage.guard.inside(p) || stage.guard.distance(p, 2 * h) < 1.1 * h)
        continue;
      EXPECT_TRUE(std::any_of(whole.begin(), whole.end(),
                              [&](const Site& site) { return stage.distance(p, site.position) < 0.62 * h; }))
          << p.x << ' ' << p.y;
    }
  }
}

TEST(PeriodicLatticeStart, ASpacingLargerThanThePeriodGivesNoSites) {
  for (const shape::RegionShape& shape : testing::periodic_shapes()) {
    const PeriodicStage stage(shape, 0.1);
    EXPECT_TRUE(stage.all(10).empty());
  }
}

TEST(LatticeStart, ASpacingLargerThanTheShapeGivesNoSites) {
  const Stage stage(tilted_square(), 0.05);
  EXPECT_TRUE(stage.all(10).empty());
  EXPECT_EQ(stage.start.runs({stage.grid, 0, stage.grid.tile_count()}, 10).count(), 0);
}

} // namespace
} // namespace trime::placing
