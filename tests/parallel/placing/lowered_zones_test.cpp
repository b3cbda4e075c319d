// SPDX-License-Identifier: BSD-3-Clause
// Where the boundary lowers a uniform size, sites lie along the Hilbert curve; elsewhere they are those of the lattice.
#include "placing/hilbert_start.hpp"
#include "placing/lattice_start.hpp"
#include "support/distributed.hpp"
#include "support/laid_sites.hpp"
#include "support/point_sets.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace trime::placing {
namespace {

using geometry::Vec2;
using mesh::Site;
using mesh::SiteList;
using polygon::BoundaryGuard;
using polygon::BoundarySites;
using sizing::LoweredSize;
using sizing::SizeLimit;
using testing::make_boundary_sites;
using testing::unit_lattice;

constexpr double uniform = 0.02, gradation = 0.2, margin = 1e-9;

/// A square in which the size is lowered around two places.
struct Stage {
  explicit Stage(const geometry::Periods& periods = {}) : lowered(size, {{limits, gradation}}, periods) {}

  bool is_lowered(Vec2 p) const { return lowered.size(p) < LoweredZones::hardly_lowered * uniform; }

  geometry::Boundary boundary =
      testing::boundary_of({testing::polygon_loop({{0.125, 0.125}, {0.875, 0.125}, {0.875, 0.875}, {0.125, 0.875}})});
  sizing::UniformSize size{uniform};
  std::vector<SizeLimit> limits = {{{0.3, 0.4}, 0.004}, {{0.6, 0.5}, 0.01}};
  LoweredSize lowered;
  BoundarySites sites = make_boundary_sites(boundary, size, unit_lattice(), 30);
  BoundaryGuard guard{sites, unit_lattice()};
  mesh::TileGrid grid{geometry::Box{{0, 0}, {1, 1}}, {{}, {}, 0.04}};
  LoweredZones zones{lowered, uniform, gradation};
  mesh::TileRange tiles{grid, 0, grid.tile_count()};
};

TEST(LoweredZones, HoldPlacesWhereTheSizeIsLowered) {
  const Stage stage;
  int held = 0;
  for (std::uint64_t key = 0; key < 2000; ++key) {
    const Vec2 p = testing::random_vec2(1, key);
    EXPECT_EQ(stage.zones.hold(p), stage.is_lowered(p)) << p.x << ' ' << p.y;
    held += stage.zones.hold(p);
  }
  EXPECT_GT(held, 20); // two discs with radii of 0.077 and 0.047: 2.6 % of the square
  EXPECT_LT(held, 100);
}

TEST(LoweredZones, WhatTheyDoNotTouchHasNoPlaceInThem) {
  for (const geometry::Periods& periods : {geometry::Periods{}, geometry::Periods{1, 1, {0, 0}}}) {
    Stage stage;
    const std::vector<SizeLimit> limits = {{{0.01, 0.4}, 0.004}}; // the zone lies across the left side
    const LoweredSize lowered(stage.size, {{limits, gradation}}, periods);
    const LoweredZones zones(lowered, uniform, gradation);
    int untouched = 0;
    for (std::uint64_t key = 0; key < 1000; ++key) {
      const Vec2 p = testing::random_vec2(2, key);
      const double reach = 0.1 * testing::random_vec2(3, key).x;
      if (zones.may_touch(p, reach))
        continue;
      ++untouched;
      for (int turn = 0; turn < 8; ++turn) {
        const Vec2 q = p + reach * (1 - margin) * Vec2{std::cos(0.8 * turn), std::sin(0.8 * turn)};
        EXPECT_FALSE(zones.hold(periods.wrap(q))) << q.x << ' ' << q.y;
      }
    }
    EXPECT_GT(untouched, 800);
  }
}

TEST(LoweredZones, TheLatticeLeavesThemOutAndKeepsItsOtherSites) {
  const Stage stage;
  const SiteList plain = LatticeStart(stage.boundary, stage.guard, unit_lattice()).sites(stage.tiles, uniform);
  const LatticeStart around(stage.boundary, stage.guard, unit_lattice(), &stage.zones);
  const SiteList made = around.sites(stage.tiles, uniform);
  std::vector<Vec2> expected, found;
  for (const Site& site : plain)
    if (!stage.is_lowered(site.position))
      expected.push_back(site.position);
  for (const Site& site : made)
    found.push_back(site.position);
  EXPECT_EQ(found, expected);
  EXPECT_LT(found.size(), plain.size());
}

TEST(LoweredZones, TheHilbertCurveFillsOnlyThem) {
  const comm::Communicator self = comm::Communicator::self();
  const Stage stage;
  const HilbertStart in_zones(self, stage.tiles, stage.guard, stage.lowered, unit_lattice(), 1000, 1, &stage.zones);
  const HilbertStart all(self, stage.tiles, stage.guard, stage.lowered, unit_lattice(), 1000);
  // Around a limit s the size is s + g r up to the radius r at which it is nearly h: the integral of 2 pi r / size^2.
  double sites = 0;
  for (const SizeLimit& limit : stage.limits) {
    const double end = LoweredZones::hardly_lowered * uniform;
    sites += 2 * M_PI / (std::sqrt(0.75) * gradation * gradation) * (std::log(end / limit.size) + limit.size / end - 1);
  }
  EXPECT_NEAR(in_zones.wanted(), sites, 0.03 * sites);
  EXPECT_GT(all.wanted(), 2 * in_zones.wanted());
  const SiteList made = in_zones.sites(std::llround(sites), 1);
  EXPECT_EQ(std::ssize(made), std::llround(sites));
  for (const Site& site : made) // a cell with its middle in a zone may reach out of it
    EXPECT_TRUE(stage.zones.may_touch(site.position, 0.5 * uniform)) << site.position.x << ' ' << site.position.y;
}

} // namespace
} // namespace trime::placing
