// SPDX-License-Identifier: BSD-3-Clause
// Two sites that come to the same place: one of them goes before the next move, so that the stars stay those of
// emptiness.
#include "support/boundary_shapes.hpp"
#include "support/distributed.hpp"
#include "support/laid_sites.hpp"
#include "support/point_sets.hpp"
#include "sweep/sweeper.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace trime::sweep {
namespace {

using geometry::Vec2;

constexpr double move = 0.05; // [1] an upper bound on the way of the site that moves

/// Sites on the boundary of a square, and at random places inside.
class CoincidentSites : public ::testing::Test {
protected:
  CoincidentSites() {
    mesh::SiteList inside;
    for (const mesh::Site& site : testing::random_sites(1100, 5))
      if (guard_.inside(site.position) && !guard_.correct(site.position, 0.03, testing::unit_lattice()))
        inside.push_back(site);
    moved_ = inside[0].position;
    target_ = std::ranges::min_element(inside.begin() + 1, inside.end(), {}, [&](const mesh::Site& site) {
                return geometry::length(site.position - moved_);
              })->position;
    for (std::size_t k = 0; k < on_boundary_.sites.size(); ++k)
      inside.push_back({on_boundary_.sites[k].position, static_cast<std::int32_t>(k)});
    placed_ = std::ssize(inside);
    state_.distribute(testing::dealt(world_, inside));
    state_.compute_stars(builder_, size_, sites::Wanted::inner_sites);
  }

  /// Moves a site to the place of the nearest one, with a lead that will part them again.
  void put_together() {
    mesh::BinnedPoints& points = state_.points();
    prepare_to_stay(points);
    for (LocalIndex i = 0; i < points.owned(); ++i)
      if (points.position(i) == moved_) {
        points.next().positions()[static_cast<std::size_t>(i)] = target_;
        points.next().leads()[static_cast<std::size_t>(i)] = {0.25 * move, 0};
      }
    for (LocalIndex tile = points.first_tile(); tile < points.last_tile(); ++tile)
      points.drifts().set(points.known_tile(tile), move);
    state_.begin_advance(size_, {move, 0.9}, false);
    state_.finish_advance(size_);
  }

  std::int64_t count() { return world_.sum(std::int64_t{state_.points().owned()}); }

  const comm::Communicator world_ = comm::Communicator::world();
  const polygon::BoundarySites on_boundary_ = testing::make_boundary_sites(
      testing::boundary_of({testing::polygon_loop({{0.125, 0.125}, {0.875, 0.125}, {0.875, 0.875}, {0.125, 0.875}})}),
      sizing::UniformSize(0.05), testing::unit_lattice(), 30);
  const polygon::BoundaryGuard guard_{on_boundary_, testing::unit_lattice()};
  sites::SiteState state_{world_, geometry::Box{{0, 0}, {1, 1}}, {{}, {}, 0.035}};
  const sizing::UniformSize size_{0.03};
  const delaunay::StarBuilder builder_{testing::unit_lattice(), 0.2};
  const MoveContext context_{guard_, size_, testing::unit_lattice()};
  Vec2 moved_, target_;
  std::int64_t placed_ = 0;
};

TEST_F(CoincidentSites, OneOfThemGoes) {
  ASSERT_LT(geometry::length(moved_ - target_), move);
  Sweeper sweeper(state_, builder_, context_);
  put_together();
  EXPECT_GT(world_.sum(std::int64_t{has_coincident_sites(state_.points())}), 0);
  CvdRule rule;
  rule.begin_sweep({});
  sweeper.prepare(rule);
  EXPECT_EQ(count(), placed_ - 1);
  EXPECT_EQ(world_.sum(std::int64_t{has_coincident_sites(state_.points())}), 0);
  EXPECT_NO_THROW(sweeper.verify());
  sweeper.commit();
  sweeper.prepare(rule);
  EXPECT_NO_THROW(sweeper.verify());
}

TEST_F(CoincidentSites, AreFoundByTheSearchForOneStar) {
  put_together();
  StarCertifier certifier(state_, builder_, context_, LemmaReach::nowhere);
  certifier.begin_sweep();
  std::vector<LocalIndex> all;
  for (LocalIndex i = 0; i < state_.points().owned(); ++i)
    if (state_.points().boundary(i) < 0)
      all.push_back(i);
  certifier.suspect(all);
  certifier.certify_suspects();
  EXPECT_EQ(world_.sum(certifier.coincident()), 2);
}

} // namespace
} // namespace trime::sweep
