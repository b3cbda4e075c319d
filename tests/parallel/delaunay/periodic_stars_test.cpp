// SPDX-License-Identifier: BSD-3-Clause
// Stars in periodic containers: those of the planar set of all images, the same on any ranks and threads, with exactly
// the triangles of a torus.
#include "decomposition/numbering.hpp"
#include "sites/site_state.hpp"
#include "support/distributed.hpp"
#include "support/moved_sites.hpp"
#include "support/star_checks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <set>

namespace trime::sites {
namespace {

using delaunay::gap;
using delaunay::StarBuilder;
using geometry::Periods;
using geometry::Vec2;
using mesh::Site;
using mesh::SiteList;
using testing::OnThreads;
using testing::unit_lattice;

const geometry::Box square{{0, 0}, {1, 1}};
constexpr double cap = 0.24;

Periods periods_of(bool x, bool y) {
  return Periods::of(square, unit_lattice(), x, y);
}

struct Rings {
  explicit Rings(const SiteState& state) {
    for (LocalIndex i = 0; i < state.points().owned(); ++i) {
      EXPECT_TRUE(state.stars().certain(i));
      positions.push_back(state.points().position(i));
      for (const LocalIndex a : state.stars().ring(i))
        positions.push_back(a == gap ? Vec2{-10, -10} : state.points().position(a));
      positions.push_back({-20, -20});
    }
    positions = testing::gather_all(state.comm(), positions);
  }
  /// Site -> its ring.
  std::map<std::pair<double, double>, std::vector<Vec2>> by_site() const {
    std::map<std::pair<double, double>, std::vector<Vec2>> rings;
    for (std::size_t k = 0; k < positions.size(); ++k) {
      std::vector<Vec2>& ring = rings[{positions[k].x, positions[k].y}];
      while (!(positions[++k] == Vec2{-20, -20}))
        ring.push_back(positions[k]);
    }
    return rings;
  }
  std::vector<Vec2> positions;
};

std::unique_ptr<SiteState> state_of(const comm::Communicator& comm, const SiteList& sites, const Periods& periods,
                                    double spacing) {
  auto state = std::make_unique<SiteState>(comm, square, mesh::GridOptions{{}, {}, spacing, periods});
  state->distribute(testing::dealt(comm, sites));
  state->compute_stars(StarBuilder(unit_lattice(), cap), sizing::UniformSize(), Wanted::all_sites);
  return state;
}

/// Half of the sites next to a border, so that much happens there.
SiteList random_torus(std::size_t n, std::uint64_t seed) {
  SiteList sites = testing::random_sites(n, seed);
  for (std::size_t k = 0; k < n; k += 2) {
    Vec2& p = sites[k].position;
    (k % 4 == 0 ? p.x : p.y) = unit_lattice().snap(0.1 * (k % 4 == 0 ? p.x : p.y) + (k % 8 < 4 ? 0.9 : 0));
    p = periods_of(true, true).wrap(p);
  }
  return sites;
}

/// n x n square or sheared lattice that fills the torus: ties everywhere in the first.
SiteList lattice_torus(int n, bool hexagonal) {
  SiteList sites;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      sites.push_back({periods_of(true, true)
                           .wrap(unit_lattice().snap(
                               Vec2{(i + (hexagonal ? 0.5 * (j % 2) : 0)) / n, static_cast<double>(j) / n}))});
  return sites;
}

TEST(PeriodicStars, AreThoseOfAllImagesInThePlane) {
  const comm::Communicator world = comm::Communicator::world(), self = comm::Communicator::self();
  for (const auto& [x, y] : {std::pair{true, true}, {true, false}, {false, true}}) {
    const Periods periods = periods_of(x, y);
    const SiteList sites = random_torus(300, 3);
    SiteList images;
    for (const Site& site : sites)
      for (int i = x ? -1 : 0; i <= (x ? 1 : 0); ++i)
        for (int j = y ? -1 : 0; j <= (y ? 1 : 0); ++j)
          images.push_back({site.position + Vec2{i * periods.x, j * periods.y}});
    SiteState plane(self, {{-1, -1}, {2, 2}}, {{}, {}, 0.06});
    plane.distribute(images);
    plane.compute_stars(StarBuilder(unit_lattice(), cap), sizing::UniformSize(), Wanted::all_sites);
    const auto expected = Rings(plane).by_site();
    for (const double spacing : {0.06, 0.5}) {
      const auto found = Rings(*state_of(world, sites, periods, spacing)).by_site();
      ASSERT_EQ(found.size(), sites.size());
      for (const auto& [site, ring] : found)
        EXPECT_EQ(ring, expected.at(site)) << site.first << ' ' << site.second;
    }
  }
}

/// On the torus: every triangle in three stars, no site in any disc by the canonical order of ties, two triangles a
/// site (Euler characteristic 0).
void expect_torus(const SiteList& sites, double spacing) {
  const comm::Communicator self = comm::Communicator::self();
  const Periods periods = periods_of(true, true);
  const auto owner = state_of(self, sites, periods, spacing);
  const SiteState& state = *owner;
  const mesh::BinnedPoints& points = state.points();
  testing::expect_well_formed(points, state.stars());
  const decomposition::Numbering numbering = decomposition::canonical_numbering(self, points, state.halo());
  ASSERT_EQ(static_cast<LocalIndex>(numbering.site_vertex.size()), points.size());
  EXPECT_TRUE(numbering.foreign.empty()); // images are the vertices of their sites
  const auto id_of = [&](LocalIndex i) { return numbering.global_id(numbering.vertex(i)); };
  std::map<std::array<GlobalId, 3>, int> listings;
  for (LocalIndex i = 0; i < points.owned(); ++i)
    testing::for_each_triangle(state.stars(), i, [&](LocalIndex a, LocalIndex b) {
      std::array<GlobalId, 3> ids{id_of(i), id_of(a), id_of(b)};
      EXPECT_TRUE(ids[0] != ids[1] && ids[1] != ids[2] && ids[2] != ids[0]);
      std::rotate(ids.begin(), std::min_element(ids.begin(), ids.end()), ids.end());
      ++listings[ids];
      for (const Site& site : sites)
        for (const double x : {-1., 0., 1.})
          for (const double y : {-1., 0., 1.}) {
            const Vec2 q = site.position + Vec2{x * periods.x, y * periods.y};
            const Vec2 p = points.position(i), r = points.position(a), s = points.position(b);
            if (geometry::length(q - p) < 2 * cap && !(q == p) && !(q == r) && !(q == s)) {
              EXPECT_LT(geometry::in_circle(p, r, s, q, unit_lattice(), periods), 0);
            }
          }
    });
  EXPECT_EQ(listings.size(), 2 * sites.size());
  for (const auto& [ids, count] : listings)
    EXPECT_EQ(count, 3);
}

TEST(PeriodicStars, FormATorus) {
  expect_torus(random_torus(100, 4), 0.1);
  expect_torus(lattice_torus(10, true), 0.1);
}

TEST(PeriodicStars, AgreeOnTiesAcrossTheBorder) {
  expect_torus(lattice_torus(8, false), 0.125);
  expect_torus(lattice_torus(8, false), 0.5); // one tile
}

/// Moves every site by a step that is a function of its position; some leave the container.
void shake(SiteState& state, double step, std::uint64_t round) {
  SiteList sites;
  for (LocalIndex i = 0; i < state.points().owned(); ++i) {
    Site site = state.points().site(i);
    const std::uint64_t key = state.grid().point_key(site.position);
    site.position =
        unit_lattice().snap(site.position + step * (testing::random_vec2(20 + round, key) - Vec2{0.5, 0.5}));
    sites.push_back(site);
  }
  testing::move_sites(state, sites, std::vector<std::uint8_t>(sites.size(), 0));
}

TEST(PeriodicStars, AreTheSameOnAnyRanksAndThreadsWhileSitesMove) {
  const comm::Communicator world = comm::Communicator::world(), self = comm::Communicator::self();
  const StarBuilder builder(unit_lattice(), cap);
  const Periods periods = periods_of(true, true);
  for (const bool ties : {false, true}) {
    const SiteList sites = ties ? lattice_torus(24, false) : random_torus(600, 5);
    const auto serial_state = state_of(self, sites, periods, 0.04);
    const OnThreads on(2);
    const auto distributed_state = state_of(world, sites, periods, 0.04);
    SiteState &serial = *serial_state, &distributed = *distributed_state;
    for (std::uint64_t round = 0; round < 4; ++round) {
      EXPECT_EQ(Rings(distributed).positions, Rings(serial).positions) << "round " << round;
      if (ties)
        break;
      shake(distributed, 0.02, round);
      shake(serial, 0.02, round);
      distributed.compute_stars(builder, sizing::UniformSize(), Wanted::all_sites);
      serial.compute_stars(builder, sizing::UniformSize(), Wanted::all_sites);
      for (LocalIndex i = 0; i < distributed.points().owned(); ++i)
        EXPECT_EQ(distributed.points().position(i), periods.wrap(distributed.points().position(i)));
    }
  }
}

} // namespace
} // namespace trime::sites
