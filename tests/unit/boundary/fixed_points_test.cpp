// SPDX-License-Identifier: BSD-3-Clause
// Fixed points before any mesh: where they lie, what becomes of the boundary, what is refused, what is taken out.
#include "boundary/fixed_points.hpp"

#include "boundary/rules.hpp"
#include "support/laid_sites.hpp"
#include "trime/core/error.hpp"
#include "trime/shape/region_shape.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace trime::boundary {
namespace {

using geometry::Vec2;
using polygon::BoundaryGuard;
using polygon::BoundarySite;
using polygon::BoundarySites;
using shape::Part;
using shape::RegionShape;

const geometry::Frame unit_frame(geometry::Box{{0, 0}, {1, 1}});
const RegionShape shape({Part::rectangle("r", {{0.25, 0.25}, {0.75, 0.75}}, unit_frame),
                         Part::circle("c", {0.5, 0.5}, 0.125, unit_frame)},
                        "difference(r, c)", unit_frame);

std::vector<FixedPoint> with_points(const std::vector<Vec2>& points) {
  std::vector<FixedPoint> given;
  for (std::size_t k = 0; k < points.size(); ++k)
    given.push_back({points[k], fmt::format("p.xy:{}", k + 1)});
  return given;
}

FixedPoints make(const std::vector<FixedPoint>& given) {
  Log log(LogLevel::silent, false);
  return FixedPoints(shape.boundary(), unit_frame.container(), given, unit_frame.lattice(), log);
}

template <class Work>
std::string error_of(const Work& work) {
  try {
    work();
  } catch (const GeometryError& error) {
    return error.what();
  }
  return "no error";
}

BoundarySites sites_for(const FixedPoints& fixed, double h) {
  return testing::make_boundary_sites(fixed.cornered_boundary(), sizing::UniformSize(h), unit_frame.lattice(), 30,
                                      fixed.inside());
}

std::vector<Vec2> corners_of(const BoundarySites& sites) {
  std::vector<Vec2> corners;
  for (const BoundarySite& site : sites.sites)
    if (site.corner)
      corners.push_back(site.position);
  return corners;
}

TEST(FixedPoints, OnTheBoundaryTheyAreCorners) {
  const double step = unit_frame.step();
  const Vec2 on_circle = unit_frame.lattice().snap({0.5 + 0.125 * 0.6, 0.5 - 0.125 * 0.8});
  const Vec2 off_side{0.25 + step, 0.4}, vertex{0.75, 0.25 + step}, quadrant{0.5, 0.625};
  const std::vector<FixedPoint> options = with_points({off_side, vertex, on_circle, quadrant, {0.375, 0.375}});
  const FixedPoints fixed = make(options);
  EXPECT_EQ(fixed.all().size(), 5u);
  EXPECT_EQ(fixed.inside().size(), 1u);
  EXPECT_NEAR(fixed.cornered_boundary().length(), shape.boundary().length(), 1e-12);
  for (const geometry::Loop& loop : fixed.cornered_boundary().loops)
    for (std::size_t k = 0; k < loop.pieces.size(); ++k)
      EXPECT_EQ(loop.pieces[k].end, loop.pieces[(k + 1) % loop.pieces.size()].start);
  const std::vector<Vec2> corners = corners_of(sites_for(fixed, 0.03));
  EXPECT_EQ(corners.size(), 7u); // the vertex was one before
  for (const Vec2 p : {unit_frame.lattice().snap(off_side), vertex, on_circle, quadrant})
    EXPECT_NE(std::find(corners.begin(), corners.end(), p), corners.end()) << p.x << " " << p.y;
}

TEST(FixedPoints, TwoOnTheBoundaryThatAreOneToItAreRefused) {
  const std::vector<FixedPoint> options = with_points({{0.25, 0.30000000005}, {0.4, 0.4}, {0.25, 0.3}});
  const std::string error = error_of([&] { make(options); });
  EXPECT_NE(error.find("p.xy:1: the fixed point (0.25, 0.30000000005"), std::string::npos) << error;
  EXPECT_NE(error.find("is 5e-11 from that of p.xy:3"), std::string::npos) << error;
  const std::vector<FixedPoint> apart = with_points({{0.25, 0.3000000002}, {0.25, 0.3}}),
                                inside = with_points({{0.3, 0.3}, {0.3, 0.30000000005}});
  EXPECT_EQ(corners_of(sites_for(make(apart), 0.03)).size(), 6u);
  EXPECT_EQ(make(inside).inside().size(), 2u);
}

/// Numbers of cells a tolerance wide, counted from zero, would not fit into 64 bits there.
TEST(FixedPoints, MayLieFarFromTheOrigin) {
  const double far = 0x1p31;
  const geometry::Frame frame(geometry::Box{{far, -far}, {far + 1, 1 - far}});
  const RegionShape square({Part::rectangle("s", {{far + 0.25, 0.25 - far}, {far + 0.75, 0.75 - far}}, frame)}, "s",
                           frame);
  const std::vector<FixedPoint> given = with_points({{far + 0.25, 0.375 - far}, {far + 0.25, 0.5 - far}});
  Log log(LogLevel::silent, false);
  const FixedPoints fixed(square.boundary(), frame.container(), given, frame.lattice(), log);
  EXPECT_TRUE(fixed.inside().empty());
  EXPECT_EQ(fixed.cornered_boundary().loops.at(0).pieces.size(), 6u);
}

TEST(FixedPoints, NoDiscOfASegmentHoldsOne) {
  const std::vector<FixedPoint> options =
      with_points({{0.325, 0.2501}, {0.425, 0.252}, {0.51, 0.6251}, {0.625, 0.7499999}});
  const FixedPoints fixed = make(options);
  const BoundarySites sites = sites_for(fixed, 0.05);
  for (LocalIndex i = 0; i < static_cast<LocalIndex>(sites.sites.size()); ++i)
    for (const Vec2 p : fixed.inside()) {
      const geometry::Segment chord = sites.chord(i);
      EXPECT_GT(dot(chord.a - p, chord.b - p), 0);
    }
  EXPECT_GT(sites.sites.size(), sites_for(make({}), 0.05).sites.size());
}

TEST(FixedPoints, WhatIsOutsideIsRefused) {
  const std::vector<FixedPoint> in_hole = with_points({{0.3, 0.3}, {0.5, 0.5}});
  const FixedPoints fixed = make(in_hole);
  const BoundarySites sites = sites_for(fixed, 0.05);
  const std::string message = error_of([&] { fixed.check_inside(BoundaryGuard(sites, unit_frame.lattice())); });
  EXPECT_NE(message.find("p.xy:2: the fixed point (0.5, 0.5) lies outside the shape, 0.125 from"), std::string::npos)
      << message;
  const std::string beyond = error_of([] { make(with_points({{0.3, 1.5}})); });
  EXPECT_NE(beyond.find("p.xy:1"), std::string::npos) << beyond;
  EXPECT_NE(beyond.find("outside the container"), std::string::npos) << beyond;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(error_of([&] { make(with_points({{nan, 0.5}})); }).find("finite"), std::string::npos);
}

TEST(FixedPoints, CoincidentOnesAreKeptOnce) {
  const std::vector<FixedPoint> options = with_points({{0.3, 0.3}, {0.3, 0.4}, {0.3, 0.3 + 1e-15}});
  EXPECT_EQ(make(options).all().size(), 2u);
}

TEST(FixedPoints, FreeSitesKeepAway) {
  const std::vector<FixedPoint> options = with_points({{0.375, 0.375}, {0.25, 0.5}});
  const FixedPoints fixed = make(options);
  const double h = 0.02;
  mesh::SiteList sites;
  for (int k = 0; k < 100; ++k)
    sites.push_back({unit_frame.lattice().snap({0.3 + 0.0015 * k, 0.376})});
  const mesh::TileGrid grid({{0, 0}, {1, 1}}, {{}, {}, h});
  fixed.place_among(sites, {grid, 0, grid.tile_count()}, sizing::UniformSize(h));
  std::vector<Vec2> fixed_ones;
  for (const mesh::Site& site : sites)
    if (site.boundary == mesh::fixed_site)
      fixed_ones.push_back(site.position);
    else
      EXPECT_GE(length(site.position - Vec2{0.375, 0.375}), BoundaryRules::fixed_clearance * h * (1 - 1e-9));
  EXPECT_EQ(fixed_ones, std::vector<Vec2>{(Vec2{0.375, 0.375})}); // the other one is a corner of the boundary
  EXPECT_EQ(sites.size(), 101u - 15u);
}

TEST(FixedPoints, WithNoneOnTheBoundaryItIsNotCopied) {
  EXPECT_EQ(&make({}).cornered_boundary(), &shape.boundary());
  const std::vector<FixedPoint> inside = with_points({{0.3, 0.3}});
  EXPECT_EQ(&make(inside).cornered_boundary(), &shape.boundary());
  const std::vector<FixedPoint> both = with_points({{0.3, 0.3}, {0.25, 0.4}});
  EXPECT_NE(&make(both).cornered_boundary(), &shape.boundary());
}

} // namespace
} // namespace trime::boundary
