// SPDX-License-Identifier: BSD-3-Clause
// Boundary sites and guard in periodic containers, against the definitions with all images.
#include "core/random.hpp"
#include "geometry/predicates.hpp"
#include "polygon/boundary_guard.hpp"
#include "support/laid_sites.hpp"
#include "support/periodic_shapes.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace trime::boundary {
namespace {

using geometry::Segment;
using geometry::Vec2;
using polygon::BoundaryGuard;
using polygon::BoundarySite;
using polygon::BoundarySites;
using shape::RegionShape;
using testing::for_each_image;

BoundarySites sites_of(const RegionShape& shape, double h) {
  return testing::make_boundary_sites(shape.boundary(), sizing::UniformSize(h), shape.frame().lattice(), 30);
}

std::vector<Segment> chords_of(const BoundarySites& sites) {
  std::vector<Segment> chords;
  for (LocalIndex k = 0; k < std::ssize(sites.sites); ++k)
    chords.push_back(sites.chord(k));
  return chords;
}

/// Chords are linked up to images, each loop closes up to its winding, and no image of a site lies in any disc.
void expect_sound(const RegionShape& shape, const BoundarySites& result) {
  SCOPED_TRACE(shape.region().text());
  const geometry::Periods& periods = shape.frame().periods();
  const std::vector<Segment> chords = chords_of(result);
  ASSERT_EQ(result.loop_start.size(), shape.boundary().loops.size() + 1);
  for (std::size_t loop = 0; loop + 1 < result.loop_start.size(); ++loop) {
    const LocalIndex first = result.loop_start[loop], end = result.loop_start[loop + 1];
    ASSERT_GE(end - first, 3);
    Vec2 sum;
    for (LocalIndex k = first; k < end; ++k) {
      const BoundarySite& site = result.sites[k];
      EXPECT_EQ(site.next, k + 1 < end ? k + 1 : first);
      EXPECT_EQ(result.sites[site.next].previous, k);
      EXPECT_EQ(periods.wrap(chords[k].b), result.sites[site.next].position);
      EXPECT_EQ(periods.wrap(site.position), site.position);
      EXPECT_LT(shape.distance_to_boundary(site.position), 1e-12);
      sum = sum + (chords[k].b - chords[k].a);
    }
    EXPECT_EQ(sum, shape.boundary().loops[loop].winding);
  }
  for (LocalIndex k = 0; k < std::ssize(chords); ++k)
    for (LocalIndex j = 0; j < std::ssize(chords); ++j)
      for_each_image(periods, [&](Vec2 shift) {
        const Vec2 p = result.sites[j].position + shift;
        const int side = geometry::diametral_side(chords[k].a, chords[k].b, p);
        ASSERT_GE(side, 0) << p.x << " " << p.y;
      });
}

TEST(PeriodicBoundarySites, KeepTheDiscsEmptyOfAllImages) {
  for (const RegionShape& shape : testing::periodic_shapes())
    for (const double h : {0.02, 0.1, 1.0, 10.0})
      expect_sound(shape, sites_of(shape, h));
}

TEST(PeriodicBoundarySites, ABandHasEvenlySpacedSitesOnBothSides) {
  const BoundarySites result = sites_of(testing::band(), 0.05);
  EXPECT_EQ(result.sites.size(), 40u);
  EXPECT_EQ(result.corners, 0);
  for (const Segment& chord : chords_of(result))
    EXPECT_NEAR(geometry::length(chord.b - chord.a), 0.05, 1e-12);
}

TEST(PeriodicBoundarySites, ThinGapsAcrossTheBorderAreResolved) {
  // The two discs are 0.002 apart across the corner of the torus.
  const geometry::Frame& frame = testing::unit_torus();
  const double away = 0.101 / std::sqrt(2.0);
  const RegionShape shape(
      {shape::Part::circle("a", {away, away}, 0.1, frame), shape::Part::circle("b", {1 - away, 1 - away}, 0.1, frame)},
      "difference(domain, a, b)", frame);
  const BoundarySites result = sites_of(shape, 0.05);
  EXPECT_GT(result.halvings, 8);
  EXPECT_LT(result.shortest, 0.02);
  expect_sound(shape, result);
}

TEST(PeriodicBoundarySites, TheWholeTorusHasNone) {
  const BoundarySites result = sites_of(testing::whole_torus(), 0.1);
  EXPECT_TRUE(result.sites.empty());
  EXPECT_EQ(result.loop_start, std::vector<LocalIndex>{0});
  const geometry::Frame& frame = testing::unit_torus();
  const BoundaryGuard guard(result, frame.lattice());
  for (const Vec2 p : {Vec2{0, 0}, Vec2{0.5, 0.25}, Vec2{-3, 7}}) {
    EXPECT_TRUE(guard.inside(p));
    EXPECT_FALSE(guard.encroaches(p));
    EXPECT_FALSE(guard.correct(p, 0.1, frame.lattice()).has_value());
    EXPECT_EQ(guard.distance(p, 0.3), 0.3);
  }
}

/// Random points all over, and points close to the chords and to the sides of the container.
std::vector<Vec2> queries_for(const RegionShape& shape, const std::vector<Segment>& chords) {
  const geometry::Lattice& lattice = shape.frame().lattice();
  std::vector<Vec2> queries;
  for (std::uint64_t k = 0; k < 600; ++k) {
    const auto random = [k](int slot) { return random_unit(5, RandomPurpose::test, k, slot); };
    queries.push_back(lattice.snap(Vec2{random(0), random(1)}));
    queries.push_back(lattice.snap(Vec2{1e-3 * (random(2) - 0.5), random(3)}));
    queries.push_back({queries.back().y, 1 - 0x1p-44});
  }
  for (const Segment& chord : chords)
    for (const double across : {-0.6, -0.2, -0.01, 0.01, 0.049, 0.2, 0.6})
      for (const double along : {-0.03, 0.4, 1.01})
        queries.push_back(
            lattice.snap(chord.a + along * (chord.b - chord.a) + across * geometry::left_normal(chord.b - chord.a)));
  return queries;
}

TEST(PeriodicBoundaryGuard, AgreesWithTheDefinitionsForAllImages) {
  for (const RegionShape& shape : testing::periodic_shapes())
    for (const double h : {0.2, 0.04}) {
      if (shape.boundary().loops.empty())
        continue;
      SCOPED_TRACE(shape.region().text());
      const geometry::Lattice& lattice = shape.frame().lattice();
      const geometry::Periods& periods = shape.frame().periods();
      const BoundarySites sites = sites_of(shape, h);
      const BoundaryGuard guard(sites, lattice);
      const std::vector<Segment> chords = chords_of(sites);
      for (const Vec2 p : queries_for(shape, chords)) {
        bool strictly = false, closed = false, close = false;
        double nearest = 1;
        for_each_image(periods, [&](Vec2 shift) {
          for (const Segment& chord : chords) {
            const Segment image{chord.a + shift, chord.b + shift};
            const int side = geometry::diametral_side(image.a, image.b, p);
            const double distance = std::sqrt(geometry::squared_distance(p, image));
            strictly |= side < 0;
            closed |= side <= 0;
            close |= distance < 0.05 * geometry::length(chord.b - chord.a) * (1 - 1e-12);
            nearest = std::fmin(nearest, distance);
          }
        });
        const bool inside = guard.inside(p);
        if (nearest > 0.3 * h) { // farther than the chords stray from the curve
          ASSERT_EQ(inside, shape.inside(p)) << p.x << " " << p.y;
        }
        ASSERT_NEAR(guard.distance(p, 1), nearest, 1e-13) << p.x << " " << p.y;
        ASSERT_EQ(guard.encroaches(p), !inside || strictly || close) << p.x << " " << p.y;
        const auto pushed = guard.correct(p, h, lattice);
        ASSERT_EQ(pushed.has_value(), !inside || closed) << p.x << " " << p.y;
        const Vec2 far{p.x - 2 * periods.x, p.y + 3 * periods.y};
        const auto pushed_far = guard.correct(far, h, lattice);
        ASSERT_EQ(guard.inside(far), inside);
        ASSERT_EQ(pushed_far.has_value(), pushed.has_value());
        if (pushed) {
          EXPECT_EQ(*pushed_far - far, *pushed - p);
          EXPECT_LT(geometry::length(*pushed - p), nearest + 1.2 * h);
        }
      }
    }
}

TEST(PeriodicBoundaryGuard, TheSidesOfEachChordAreInAndOut) {
  for (const RegionShape& shape : testing::periodic_shapes())
    for (const double h : {0.3, 0.02}) {
      const BoundarySites sites = sites_of(shape, h);
      const BoundaryGuard guard(sites, shape.frame().lattice());
      for (const Segment& chord : chords_of(sites)) {
        const Vec2 middle = 0.5 * (chord.a + chord.b), normal = geometry::left_normal(chord.b - chord.a);
        for (const double across : {1e-3, 0.1, 0.45}) {
          EXPECT_TRUE(guard.inside(shape.frame().lattice().snap(middle + across * normal)));
          EXPECT_FALSE(guard.inside(shape.frame().lattice().snap(middle - across * normal)));
        }
      }
    }
}

} // namespace
} // namespace trime::boundary
