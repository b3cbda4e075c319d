// SPDX-License-Identifier: BSD-3-Clause
#include "boundary/feature_rule.hpp"

#include "boundary/site_path.hpp"
#include "core/angle.hpp"
#include "core/random.hpp"
#include "geometry/predicates.hpp"
#include "sizing/lowered_size.hpp"
#include "support/boundary_shapes.hpp"
#include "support/laid_sites.hpp"
#include "trime/core/error.hpp"
#include "trime/shape/region_shape.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace trime::boundary {
namespace {

using geometry::Boundary;
using geometry::Vec2;
using polygon::BoundarySite;
using polygon::BoundarySites;
using polygon::DroppedLoops;
using sizing::UniformSize;
using testing::boundary_of;
using testing::polygon_loop;
using testing::unit_lattice;

constexpr double tolerance = 0.2;

std::vector<Vec2> regular_polygon(int n, Vec2 center, double radius, bool clockwise = false) {
  std::vector<Vec2> points;
  for (int k = 0; k < n; ++k) {
    const SinCos at = sin_cos(2 * pi * k / n);
    points.push_back(center + Vec2{radius * at.cos, radius * at.sin});
  }
  if (clockwise)
    std::reverse(points.begin(), points.end());
  return points;
}

/// A circle whose radius jumps at random from vertex to vertex.
std::vector<Vec2> ragged_circle(int n, double radius, double depth, std::uint64_t seed) {
  std::vector<Vec2> points = regular_polygon(n, {}, 1);
  for (int k = 0; k < n; ++k)
    points[k] = Vec2{0.5, 0.5} + (radius + depth * (random_unit(seed, RandomPurpose::test, k, 0) - 0.5)) * points[k];
  return points;
}

TEST(FeatureRule, LeavesOutAllComponentsButTheChosenOne) {
  // A ring with an island in its hole, and a larger disc without holes.
  const Boundary given = boundary_of({polygon_loop(regular_polygon(30, {0.3, 0.3}, 0.2), 1),
                                      polygon_loop(regular_polygon(30, {0.3, 0.3}, 0.1, true), 2),
                                      polygon_loop(regular_polygon(30, {0.3, 0.3}, 0.05), 3),
                                      polygon_loop(regular_polygon(30, {0.75, 0.75}, 0.19), 4)});
  const auto dropped_by = [&](Components components, Vec2 place = {}) {
    DroppedLoops dropped = drop_small_loops(given, UniformSize(0.01), 3);
    drop_other_components(given, {0, 3, components, place}, dropped);
    EXPECT_NEAR(boundary_without(given, dropped).area, given.area - dropped.others_area, 1e-12);
    return dropped;
  };
  using Flags = std::vector<char>;
  EXPECT_EQ(dropped_by(Components::all).dropped, Flags({0, 0, 0, 0}));
  EXPECT_EQ(dropped_by(Components::largest).dropped, Flags({1, 1, 1, 0}));
  EXPECT_EQ(dropped_by(Components::largest).others, 2);
  const std::vector<geometry::Loop> left_out = dropped_by(Components::largest).other_loops;
  EXPECT_TRUE(lies_within(left_out, {0.45, 0.3}) && lies_within(left_out, {0.3, 0.3}));
  EXPECT_FALSE(lies_within(left_out, {0.37, 0.3}) || lies_within(left_out, {0.75, 0.75}));
  EXPECT_EQ(dropped_by(Components::at, {0.45, 0.3}).dropped, Flags({0, 0, 1, 1}));
  EXPECT_EQ(dropped_by(Components::at, {0.3, 0.31}).dropped, Flags({1, 1, 0, 1}));
  EXPECT_EQ(dropped_by(Components::at, {0.37, 0.3}).dropped, Flags({1, 1, 0, 1})) << "in the hole, next to the island";
  FeatureOptions options;
  options.components = Components::at;
  options.component_place = {0.45, 0.3};
  check_choice_of_component(given, options);
  options.component_place = {0.37, 0.3};
  EXPECT_THROW(check_choice_of_component(given, options), GeometryError);
  options.component_place = {2, 2};
  EXPECT_THROW(check_choice_of_component(given, options), GeometryError);
}

BoundarySites sites_of(const Boundary& boundary, double h, double share = tolerance) {
  return testing::make_boundary_sites(boundary, UniformSize(h), unit_lattice(), 30, {}, {share, 0});
}

double distance_to_polygon(const BoundarySites& sites, Vec2 p) {
  double least = INFINITY;
  for (std::size_t k = 0; k < sites.sites.size(); ++k) {
    const geometry::Segment chord = sites.chord(static_cast<LocalIndex>(k));
    const Vec2 along = chord.b - chord.a;
    const double share = std::clamp(dot(p - chord.a, along) / squared_length(along), 0.0, 1.0);
    least = std::fmin(least, length(p - chord.a - share * along));
  }
  return least;
}

TEST(FeatureRule, CleanShapesKeepTheirCornersAndTheirSites) {
  const std::vector<Vec2> corner{{0.2, 0.2}, {0.8, 0.2}, {0.8, 0.5}, {0.5, 0.5}, {0.5, 0.8}, {0.2, 0.8}};
  for (const auto& points : {regular_polygon(3, {0.5, 0.5}, 0.3), regular_polygon(8, {0.5, 0.5}, 0.3), corner}) {
    const Boundary boundary = boundary_of({polygon_loop(points)});
    const BoundarySites all = sites_of(boundary, 0.02, 0), ruled = sites_of(boundary, 0.02);
    EXPECT_EQ(ruled.corners, std::ssize(points));
    EXPECT_EQ(ruled.left_out, 0);
    ASSERT_EQ(all.sites.size(), ruled.sites.size());
    for (std::size_t k = 0; k < all.sites.size(); ++k)
      EXPECT_EQ(all.sites[k].position, ruled.sites[k].position);
  }
}

TEST(FeatureRule, RaggedCurvesGetSitesAtAboutTheSizeOnTheCurveAndNearAllItsCorners) {
  constexpr double h = 0.05;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const std::vector<Vec2> points = ragged_circle(200, 0.35, 0.012, seed);
    const Boundary boundary = boundary_of({polygon_loop(points)});
    const BoundarySites all = sites_of(boundary, h, 0), ruled = sites_of(boundary, h);
    EXPECT_GT(all.sites.size(), 100u);
    EXPECT_NEAR(static_cast<double>(ruled.sites.size()), 2 * pi * 0.35 / h, 4);
    EXPECT_GT(ruled.left_out, 50);
    EXPECT_LE(ruled.deviation, 1.1 * tolerance); // places left out of the choice may lie a little farther
    const geometry::PieceTree pieces(boundary);
    for (std::size_t k = 0; k < ruled.sites.size(); ++k) {
      const geometry::Segment chord = ruled.chord(static_cast<LocalIndex>(k));
      EXPECT_LE(pieces.distance(chord.a), unit_lattice().step());
      EXPECT_NEAR(length(chord.b - chord.a), h, 0.35 * h);
      for (std::size_t j = 0; j < ruled.sites.size(); ++j)
        EXPECT_GE(geometry::diametral_side(chord.a, chord.b, ruled.sites[j].position), 0);
    }
    for (const Vec2 p : points)
      EXPECT_LE(distance_to_polygon(ruled, p), 1.1 * tolerance * h);
  }
}

/// Two ragged curves so near to each other that chords are halved. Where one is divided right at a corner that had been
/// left out, that one is a corner of the mesh again: else the clean-up would slide it away.
TEST(FeatureRule, EachCornerIsLeftOutOrASiteThatSaysSo) {
  constexpr double angle = 30;
  LocalIndex halvings = 0, left_out = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    std::vector<Vec2> inner = ragged_circle(300, 0.33, 0.006, seed + 100);
    std::reverse(inner.begin(), inner.end());
    const Boundary boundary = boundary_of({polygon_loop(ragged_circle(300, 0.35, 0.006, seed)), polygon_loop(inner)});
    const BoundarySites ruled = sites_of(boundary, 0.05);
    LocalIndex turns = 0, sites = 0;
    for (std::size_t l = 0; l < 2; ++l) {
      const geometry::Loop& loop = boundary.loops[l];
      for (std::size_t i = 0; i < loop.pieces.size(); ++i)
        turns += loop.turn_degrees(i) > angle;
      for (LocalIndex k = ruled.loop_start[l]; k < ruled.loop_start[l + 1]; ++k)
        if (const BoundarySite& site = ruled.sites[at(k)];
            site.along == 0 && loop.turn_degrees(at(site.piece)) > angle) {
          EXPECT_TRUE(site.corner) << "seed " << seed << ", loop " << l << ", piece " << site.piece;
          EXPECT_EQ(site.position, loop.pieces[at(site.piece)].start);
          ++sites;
        }
    }
    EXPECT_EQ(turns, sites + ruled.left_out) << "seed " << seed;
    EXPECT_EQ(ruled.corners, std::count_if(ruled.sites.begin(), ruled.sites.end(), std::mem_fn(&BoundarySite::corner)));
    halvings += ruled.halvings;
    left_out += ruled.left_out;
  }
  EXPECT_GT(halvings, 100) << "else it asks nothing";
  EXPECT_GT(left_out, 100);
}

TEST(FeatureRule, DetoursBeyondTheToleranceStay) {
  // A spike of 3 h out of a side, 0.4 h wide: its tip is a site, and so is the foot on both sides, nearly.
  constexpr double h = 0.05;
  const Vec2 tip = unit_lattice().snap(Vec2{0.5, 0.35});
  const Boundary boundary =
      boundary_of({polygon_loop({{0.2, 0.2}, {0.8, 0.2}, {0.8, 0.8}, {0.51, 0.8}, tip, {0.49, 0.8}, {0.2, 0.8}})});
  const BoundarySites ruled = sites_of(boundary, h);
  EXPECT_LE(distance_to_polygon(ruled, tip), tolerance * h);
  EXPECT_LE(distance_to_polygon(ruled, {0.51, 0.8}), tolerance * h);
}

TEST(FeatureRule, AFixedPointOnARaggedCurveStays) {
  Boundary boundary = boundary_of({polygon_loop(ragged_circle(200, 0.35, 0.012, 5))});
  boundary.loops[0].pieces[77].corner = true;
  const Vec2 place = boundary.loops[0].pieces[77].start;
  const BoundarySites ruled = sites_of(boundary, 0.05);
  EXPECT_TRUE(std::any_of(ruled.sites.begin(), ruled.sites.end(),
                          [&](const BoundarySite& site) { return site.corner && site.position == place; }));
}

/// A square with lakes and an island in one of them.
Boundary lakes(double radius) {
  const Vec2 big{0.35, 0.5};
  return boundary_of({polygon_loop({{0.1, 0.1}, {0.9, 0.1}, {0.9, 0.9}, {0.1, 0.9}}),
                      polygon_loop(regular_polygon(12, {0.7, 0.5}, radius, true)),
                      polygon_loop(regular_polygon(12, big, 0.15, true)),
                      polygon_loop(regular_polygon(12, big, radius))});
}

TEST(FeatureRule, SmallIslandsAndLakesAreDropped) {
  const Boundary boundary = lakes(0.02); // perimeters of 0.124
  const double area = 12 * 0.5 * 0.02 * 0.02 * 0.5;
  const DroppedLoops none = drop_small_loops(boundary, UniformSize(0.04), 3),
                     two = drop_small_loops(boundary, UniformSize(0.042), 3);
  EXPECT_EQ(none.dropped, (std::vector<char>{0, 0, 0, 0}));
  EXPECT_EQ(two.dropped, (std::vector<char>{0, 1, 0, 1}));
  EXPECT_EQ(two.components, 1);
  EXPECT_EQ(two.holes, 1);
  EXPECT_NEAR(two.area, 2 * area, 1e-12);
  EXPECT_NEAR(two.change, 0, 1e-12);
  EXPECT_EQ(drop_small_loops(boundary, UniformSize(0.042), 0).dropped, none.dropped); // keep_features
  const BoundarySites sites =
      testing::make_boundary_sites(boundary, UniformSize(0.042), unit_lattice(), 30, {}, {tolerance, 3});
  EXPECT_EQ(sites.loop_start.size(), 3u);
}

TEST(FeatureRule, WhatAStayingThingNeedsStays) {
  Boundary boundary = lakes(0.02);
  const std::vector<Vec2> on_island{{0.35, 0.5}};
  EXPECT_EQ(drop_small_loops(boundary, UniformSize(0.042), 3, on_island).dropped, (std::vector<char>{0, 1, 0, 0}));
  boundary.loops[3].pieces[0].corner = true; // a fixed point on the island: its lake stays, too, at any size
  EXPECT_EQ(drop_small_loops(boundary, UniformSize(1), 3).dropped, (std::vector<char>{0, 1, 0, 0}));
  boundary.loops[3].pieces[0].corner = false;
}

TEST(FeatureRule, WhatIsMoreThanAHundredthOfTheAreaStays) {
  EXPECT_EQ(drop_small_loops(lakes(0.02), UniformSize(10), 3).dropped, (std::vector<char>{0, 1, 0, 1}));
  // Two discs, a thin annulus: the size that makes few points of them is no reason to drop one.
  const Boundary two = boundary_of(
      {polygon_loop(regular_polygon(12, {0.3, 0.5}, 0.19)), polygon_loop(regular_polygon(12, {0.7, 0.5}, 0.19))});
  EXPECT_FALSE(drop_small_loops(two, UniformSize(10), 3).any());
  const Boundary annulus = boundary_of(
      {polygon_loop(regular_polygon(12, {0.5, 0.5}, 0.4)), polygon_loop(regular_polygon(12, {0.5, 0.5}, 0.399, true))});
  EXPECT_FALSE(drop_small_loops(annulus, UniformSize(10), 3).any());
}

TEST(FeatureRule, OneOfManySmallIslandsStays) {
  std::vector<geometry::Loop> islands;
  for (int k = 0; k < 144; ++k)
    islands.push_back(polygon_loop(regular_polygon(12, {0.08 * (k % 12) + 0.06, 0.08 * (k / 12) + 0.06}, 0.03)));
  const DroppedLoops dropped = drop_small_loops(boundary_of(islands), UniformSize(10), 3);
  EXPECT_EQ(dropped.components, 143);
}

/// The two corners at the end of a slit stay, however near to each other: its sides get sites in pairs.
TEST(FeatureRule, TheEndsOfASlitStay) {
  for (const double width : {1e-3, 1e-6, 1e-10}) {
    const Boundary boundary =
        boundary_of({polygon_loop({{0.1, 0.1}, {0.9, 0.1}, {0.9, 0.9}, {0.1, 0.9}}),
                     polygon_loop({{0.3, 0.5}, {0.3, 0.5 + width}, {0.7, 0.5 + width}, {0.7, 0.5}})});
    const BoundarySites ruled = sites_of(boundary, 0.03, 0.1);
    EXPECT_EQ(ruled.corners, 8);
    EXPECT_EQ(ruled.left_out, 0);
    EXPECT_LT(ruled.sites.size(), 150u);
  }
}

TEST(SitePath, AStraightLineIsDividedEvenlyAndACornerKept) {
  std::vector<SitePlace> places;
  for (int k = 0; k <= 40; ++k)
    places.push_back({0.25 * k, k <= 20 ? Vec2{0.25 * k, 0} : Vec2{5, 0.25 * (k - 20)}, 1, 0.2});
  const std::vector<LocalIndex> path = shortest_site_path(places, false);
  EXPECT_EQ(path, (std::vector<LocalIndex>{0, 4, 8, 12, 16, 20, 24, 28, 32, 36, 40}));
}

TEST(SitePath, NeighbouringPlacesAreJoinedIfNothingElseIsAllowed) {
  std::vector<SitePlace> places; // a zigzag far beyond the tolerance, and steps longer than any chord is wanted
  for (int k = 0; k <= 6; ++k)
    places.push_back({5.0 * k, {1.0 * k, k % 2 == 0 ? 0.0 : 5.0}, 1, 0.2});
  EXPECT_EQ(shortest_site_path(places, false).size(), places.size());
}

TEST(LoweredSize, GrowsFromTheLimitsAndSeesImages) {
  const UniformSize uniform(0.1);
  geometry::Periods periods;
  const std::vector<sizing::SizeLimit> limits{{{0.9, 0.5}, 0.02}, {{0.2, 0.5}, 0.5}}, steep{{{0.5, 0.5}, 0.01}};
  const sizing::LoweredSize plain(uniform, {{limits, 0.2}}, periods);
  EXPECT_DOUBLE_EQ(plain.size({0.9, 0.5}), 0.02);
  EXPECT_NEAR(plain.size({0.8, 0.5}), 0.04, 1e-12);
  EXPECT_DOUBLE_EQ(plain.size({0.2, 0.5}), 0.1);
  EXPECT_DOUBLE_EQ(plain.size({0.05, 0.5}), 0.1);
  const sizing::LoweredSize both(uniform, {{limits, 0.2}, {steep, 0.5}}, periods);
  EXPECT_DOUBLE_EQ(both.size({0.9, 0.5}), 0.02);
  EXPECT_NEAR(both.size({0.5, 0.6}), 0.06, 1e-12);
  periods.x = 1;
  EXPECT_NEAR(sizing::LoweredSize(uniform, {{limits, 0.2}}, periods).size({0.05, 0.5}), 0.05, 1e-12);
}

} // namespace
} // namespace trime::boundary
