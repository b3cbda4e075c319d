// SPDX-License-Identifier: BSD-3-Clause
// Boundary sites on easy and ugly shapes: invariants by brute force.
#include "support/laid_sites.hpp"

#include "core/random.hpp"
#include "geometry/predicates.hpp"
#include "support/boundary_shapes.hpp"
#include "trime/core/error.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace trime::boundary {
namespace {

using geometry::Boundary;
using geometry::Vec2;
using polygon::BoundarySite;
using polygon::BoundarySites;
using sizing::UniformSize;
using testing::boundary_of;
using testing::circle_loop;
using testing::polygon_loop;
using testing::unit_lattice;

std::vector<Vec2> loop_positions(const BoundarySites& result, std::size_t loop) {
  std::vector<Vec2> positions;
  for (LocalIndex k = result.loop_start[loop]; k < result.loop_start[loop + 1]; ++k)
    positions.push_back(result.sites[k].position);
  return positions;
}

void expect_linked_loops(const Boundary& boundary, const BoundarySites& result) {
  ASSERT_EQ(result.loop_start.size(), boundary.loops.size() + 1);
  ASSERT_EQ(result.loop_start.back(), std::ssize(result.sites));
  for (std::size_t loop = 0; loop < boundary.loops.size(); ++loop) {
    const LocalIndex first = result.loop_start[loop], end = result.loop_start[loop + 1];
    ASSERT_GE(end - first, 3);
    for (LocalIndex k = first; k < end; ++k) {
      ASSERT_EQ(result.sites[k].next, k + 1 < end ? k + 1 : first);
      ASSERT_EQ(result.sites[result.sites[k].next].previous, k);
      ASSERT_EQ(result.sites[k].tag, boundary.loops[loop].tag);
      ASSERT_EQ(result.sites[k].position, unit_lattice().snap(result.sites[k].position));
    }
    EXPECT_EQ(testing::signed_area(loop_positions(result, loop)) > 0, boundary.loops[loop].outer);
  }
}

void expect_corners_kept(const Boundary& boundary, const BoundarySites& result, double corner_angle) {
  std::size_t corners = 0;
  for (const geometry::Loop& loop : boundary.loops)
    for (std::size_t i = 0; i < loop.pieces.size(); ++i)
      if (loop.turn_degrees(i) > std::fmin(corner_angle, 120)) {
        ++corners;
        EXPECT_TRUE(std::any_of(result.sites.begin(), result.sites.end(), [&](const BoundarySite& site) {
          return site.corner && site.position == loop.pieces[i].start;
        }));
      }
  EXPECT_EQ(corners, result.corners);
}

/// No site in any open diametral disc, no two sites at one place, no two chords that cross.
void expect_gabriel_and_simple(const BoundarySites& result) {
  const auto& sites = result.sites;
  std::vector<Vec2> positions;
  for (const BoundarySite& site : sites)
    positions.push_back(site.position);
  std::sort(positions.begin(), positions.end(), geometry::lexicographically_less);
  ASSERT_EQ(std::adjacent_find(positions.begin(), positions.end()), positions.end());
  for (const BoundarySite& site : sites)
    for (const Vec2 p : positions)
      ASSERT_GE(geometry::diametral_side(site.position, sites[site.next].position, p), 0) << p.x << " " << p.y;
  for (std::size_t i = 0; i < std::min<std::size_t>(sites.size(), 1000); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Vec2 a = sites[i].position, b = sites[sites[i].next].position;
      const Vec2 c = sites[j].position, d = sites[sites[j].next].position;
      ASSERT_FALSE(geometry::orient2d(a, b, c) * geometry::orient2d(a, b, d) < 0 &&
                   geometry::orient2d(c, d, a) * geometry::orient2d(c, d, b) < 0);
    }
}

BoundarySites expect_sound(const Boundary& boundary, const sizing::SizeField& size, double corner_angle = 30) {
  const BoundarySites result = testing::make_boundary_sites(boundary, size, unit_lattice(), corner_angle);
  expect_linked_loops(boundary, result);
  expect_corners_kept(boundary, result, corner_angle);
  expect_gabriel_and_simple(result);
  const BoundarySites again = testing::make_boundary_sites(boundary, size, unit_lattice(), corner_angle);
  EXPECT_EQ(again.sites.size(), result.sites.size());
  for (std::size_t k = 0; k < result.sites.size(); ++k)
    EXPECT_EQ(again.sites[k].position, result.sites[k].position);
  return result;
}

void expect_spacing(const BoundarySites& result, double h) {
  for (const BoundarySite& site : result.sites) {
    const double spacing = geometry::length(result.sites[site.next].position - site.position);
    EXPECT_GE(spacing, 0.5 * h);
    EXPECT_LE(spacing, 1.5 * h);
  }
}

Boundary square() {
  return boundary_of({polygon_loop({{0.1, 0.1}, {0.9, 0.1}, {0.9, 0.9}, {0.1, 0.9}})});
}

TEST(BoundarySites, SquareIsDividedEvenly) {
  const BoundarySites result = expect_sound(square(), UniformSize(0.05));
  EXPECT_EQ(result.sites.size(), 64u);
  EXPECT_EQ(result.halvings, 0);
  for (const BoundarySite& site : result.sites)
    EXPECT_NEAR(geometry::length(result.sites[site.next].position - site.position), 0.05, 1e-12);
}

TEST(BoundarySites, SquareSmallerThanOneElementKeepsItsCorners) {
  EXPECT_EQ(expect_sound(square(), UniformSize(100)).sites.size(), 4u);
}

TEST(BoundarySites, CirclesOfAnySizeAreRoundPolygons) {
  for (const double h : {0.003, 0.02, 0.11, 0.4, 3.0})
    for (const int arcs : {1, 2, 4}) {
      const BoundarySites result =
          expect_sound(boundary_of({circle_loop({0.5, 0.5}, 0.4, false, arcs)}), UniformSize(h));
      EXPECT_GE(result.sites.size(), 6u);
      EXPECT_EQ(result.corners, 0);
      EXPECT_EQ(result.halvings, 0) << h;
      if (h < 0.4)
        expect_spacing(result, h);
      for (const BoundarySite& site : result.sites)
        EXPECT_NEAR(geometry::length(site.position - Vec2{0.5, 0.5}), 0.4, 1e-12);
    }
}

TEST(BoundarySites, SmoothPolygonsWithManyPiecesPerSiteKeepTheSpacing) {
  std::vector<Vec2> points;
  for (int k = 0; k < 5000; ++k) {
    const SinCos direction = sin_cos(2 * pi * k / 5000);
    points.push_back({0.5 + 0.4 * direction.cos, 0.5 + 0.2 * direction.sin});
  }
  expect_spacing(expect_sound(boundary_of({polygon_loop(points)}), UniformSize(0.01)), 0.01);
}

class Graded final : public sizing::SizeField {
public:
  double size(Vec2 p) const override { return 0.002 + 0.1 * p.x; }
};

TEST(BoundarySites, GradedSizeIsFollowed) {
  const Graded size;
  const BoundarySites result = expect_sound(square(), size);
  for (const BoundarySite& site : result.sites) {
    const Vec2 to = result.sites[site.next].position;
    const double ratio = geometry::length(to - site.position) / size.size(0.5 * (to + site.position));
    EXPECT_GT(ratio, 0.9);
    EXPECT_LT(ratio, 1.1);
  }
}

TEST(BoundarySites, ThinWedgesGetShells) {
  for (const double degrees : {40.0, 10.0, 1.0, 0.01}) {
    const double width = std::tan(degrees * pi / 180);
    const Boundary wedge = boundary_of({polygon_loop({{0.1, 0.5}, {0.9, 0.5}, {0.9, 0.5 + 0.8 * width}})});
    const BoundarySites result = expect_sound(wedge, UniformSize(0.03));
    EXPECT_GE(result.sharp_corners, 1);
    EXPECT_LT(result.sites.size(), 400 + 2 / width) << degrees;
  }
}

TEST(BoundarySites, ArmsOfASharpCornerAreDividedAtEqualRadii) {
  const Boundary wedge = boundary_of({polygon_loop({{0.1, 0.5}, {0.9, 0.35}, {0.9, 0.65}})});
  const BoundarySites result = expect_sound(wedge, UniformSize(0.05));
  const auto apex = std::find_if(result.sites.begin(), result.sites.end(),
                                 [](const BoundarySite& s) { return s.corner && s.position.x < 0.2; });
  LocalIndex ahead = apex->next, behind = apex->previous;
  for (int shell = 0; shell < 2; ++shell) {
    const double r = geometry::length(result.sites[ahead].position - apex->position);
    EXPECT_NEAR(r, 0.05 * (shell + 1), 1e-9);
    EXPECT_NEAR(geometry::length(result.sites[behind].position - apex->position), r, 1e-9);
    ahead = result.sites[ahead].next;
    behind = result.sites[behind].previous;
  }
}

TEST(BoundarySites, CombWithNarrowChannels) {
  const double h = 0.05, width = h / 4;
  std::vector<Vec2> points{{0.1, 0.1}, {0.1 + 21 * width, 0.1}};
  for (int k = 20; k >= 0; --k) {
    const double x = 0.1 + k * width, y = k % 2 ? 0.2 : 0.8;
    points.push_back({x + width, y});
    points.push_back({x, y});
  }
  std::vector<Vec2> distinct;
  for (const Vec2 p : points)
    if (distinct.empty() || !(distinct.back() == p))
      distinct.push_back(p);
  EXPECT_LT(expect_sound(boundary_of({polygon_loop(distinct)}), UniformSize(h)).sites.size(), 5000u);
}

TEST(BoundarySites, StarWithAHundredSpikes) {
  std::vector<Vec2> points;
  for (int k = 0; k < 200; ++k) {
    const SinCos direction = sin_cos(2 * pi * k / 200);
    points.push_back(Vec2{0.5, 0.5} + (k % 2 ? 0.05 : 0.45) * Vec2{direction.cos, direction.sin});
  }
  for (const double h : {0.3, 0.02}) {
    const BoundarySites result = expect_sound(boundary_of({polygon_loop(points)}), UniformSize(h));
    EXPECT_EQ(result.corners, 200);
    EXPECT_LT(result.sites.size(), 8000u);
  }
}

TEST(BoundarySites, NotchFromTheExterior) {
  const Boundary notched = boundary_of(
      {polygon_loop({{0.1, 0.1}, {0.9, 0.1}, {0.9, 0.9}, {0.501, 0.9}, {0.5, 0.3}, {0.499, 0.9}, {0.1, 0.9}})});
  EXPECT_EQ(expect_sound(notched, UniformSize(0.03)).sharp_corners, 1);
}

TEST(BoundarySites, TinyIslandNearACoast) {
  for (const double gap : {1e-2, 1e-4, 1e-7}) {
    Boundary boundary = square();
    boundary.loops.push_back(circle_loop({0.5, 0.1 + gap + 1e-3}, 1e-3, true, 4, 2));
    boundary.loops.push_back(
        polygon_loop({{0.3, 0.1 + gap}, {0.3 - gap, 0.1 + 3 * gap}, {0.3 + gap, 0.1 + 2 * gap}}, 3));
    const BoundarySites result = expect_sound(boundary, UniformSize(0.05));
    EXPECT_LT(result.sites.size(), 1000u) << gap;
  }
}

TEST(BoundarySites, IslandBetweenACurveAndItsChordStaysInside) {
  Boundary boundary = boundary_of({circle_loop({0.5, 0.5}, 0.4, false, 4, 1)});
  boundary.loops.push_back(circle_loop({0.5, 0.11}, 0.004, true, 4, 2));
  const BoundarySites result = expect_sound(boundary, UniformSize(0.4));
  std::vector<Vec2> outer = loop_positions(result, 0);
  for (const Vec2 p : loop_positions(result, 1))
    for (std::size_t k = 0; k < outer.size(); ++k) // the outer polygon is convex
      EXPECT_GT(geometry::orient2d(outer[k], outer[(k + 1) % outer.size()], p), 0);
}

TEST(BoundarySites, LensOfTwoArcs) {
  // Two arcs of the circles of radius 0.5 around (0.5, 0.0) and (0.5, 0.8): corners at the ends only.
  const Vec2 left = unit_lattice().snap(Vec2{0.2, 0.4}), right = unit_lattice().snap(Vec2{0.8, 0.4});
  const double half = angle_of(0.3, 0.4);
  geometry::Piece low, high;
  low.circular = high.circular = true;
  low.radius = high.radius = 0.5;
  low.start = high.end = left;
  low.end = high.start = right;
  low.center = {0.5, 0.8};
  low.start_angle = -0.5 * pi - half;
  low.sweep = 2 * half;
  high.center = {0.5, 0};
  high.start_angle = 0.5 * pi - half;
  high.sweep = 2 * half;
  geometry::Loop loop;
  loop.pieces = {low, high};
  for (const double h : {2.0, 0.1, 0.01})
    EXPECT_EQ(expect_sound(boundary_of({loop}), UniformSize(h)).corners, 2);
}

/// Koch-like curve with random bumps: long detours, sharp corners of all kinds.
std::vector<Vec2> rough_coast(int depth, std::uint64_t seed) {
  std::vector<Vec2> points{{0.2, 0.25}, {0.8, 0.25}, {0.5, 0.8}};
  for (int level = 0; level < depth; ++level) {
    std::vector<Vec2> finer;
    for (std::size_t k = 0; k < points.size(); ++k) {
      const Vec2 a = points[k], d = points[(k + 1) % points.size()] - a;
      const double height = 0.29 * random_unit(seed, RandomPurpose::test, k, level);
      const double sign = random_unit(seed, RandomPurpose::test, k, 100 + level) < 0.7 ? -1 : 0.5;
      finer.insert(finer.end(),
                   {a, a + (1 / 3.0) * d, a + 0.5 * d + sign * height * geometry::left_normal(d), a + (2 / 3.0) * d});
    }
    points = finer;
  }
  return points;
}

/// Falls to nearly nothing on a line.
class ValleySize final : public sizing::SizeField {
public:
  explicit ValleySize(double slope) : slope_(slope) {}
  double size(Vec2 p) const override { return slope_ * std::fabs(p.x - 0.8796) + 1e-6; }

private:
  double slope_;
};

TEST(BoundarySites, ATinyTipOfWhichACornerIsLeftOutIsNoTwoSites) {
  const Boundary tip = boundary_of({polygon_loop({{0.9, 0.45}, {0.857227, 0.449389}, {0.857227, 0.44694}})});
  for (double slope = 0.5; slope < 64; slope *= 1.25) {
    SCOPED_TRACE(slope);
    const BoundarySites result = testing::make_boundary_sites(tip, ValleySize(slope), unit_lattice(), 30, {}, {0.1, 0});
    expect_linked_loops(tip, result);
  }
}

TEST(BoundarySites, RoughCoasts) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed)
    for (const double h : {0.2, 0.03, 0.004}) {
      const BoundarySites result = expect_sound(boundary_of({polygon_loop(rough_coast(4, seed))}), UniformSize(h));
      EXPECT_LT(result.sites.size(), 6000u);
    }
}

TEST(BoundarySites, LargeCornerAnglesStillEnd) {
  for (const double angle : {89.0, 130.0, 180.0}) {
    const BoundarySites result = expect_sound(boundary_of({polygon_loop(rough_coast(3, 9))}), UniformSize(0.1), angle);
    EXPECT_LT(result.sites.size(), 6000u);
  }
}

/// Teeth on a bar, as wide as the gaps between them.
std::vector<Vec2> comb(int teeth, double width) {
  std::vector<Vec2> ring{{0.1, 0.1}, {0.1 + (2 * teeth - 1) * width, 0.1}};
  for (int tooth = teeth - 1; tooth >= 0; --tooth) {
    const double left = 0.1 + 2 * tooth * width;
    ring.insert(ring.end(), {{left + width, 0.5}, {left, 0.5}});
    if (tooth > 0)
      ring.insert(ring.end(), {{left, 0.2}, {left - width, 0.2}});
  }
  return ring;
}

TEST(BoundarySites, HalvingMayRunThroughTheWholeBoundary) { // from tooth to tooth, a round for each
  const Graded size;
  const BoundarySites result = expect_sound(boundary_of({polygon_loop(comb(60, 0.006))}), size);
  EXPECT_GT(result.rounds, 25);
  EXPECT_FALSE(result.overfull);
}

TEST(BoundarySites, HalvingEndsWhereThereAreMoreSitesThanAffordable) {
  const Graded size;
  const Boundary boundary = boundary_of({polygon_loop(comb(60, 0.006))});
  const std::size_t all = testing::make_boundary_sites(boundary, size, unit_lattice(), 30).sites.size();
  const BoundarySites result = testing::make_boundary_sites(boundary, size, unit_lattice(), 30, {}, {}, all / 2);
  EXPECT_TRUE(result.overfull);
  EXPECT_EQ(result.sites.size(), all / 2);
}

TEST(BoundarySites, PartsCloserThanTheLatticeAreRefusedWithThePlace) {
  Boundary boundary = square();
  boundary.loops.push_back(polygon_loop({{0.312, 0.1 + 1e-13}, {0.4, 0.3}, {0.5, 0.2}}));
  try {
    testing::make_boundary_sites(boundary, UniformSize(0.05), unit_lattice(), 30);
    FAIL() << "expected a GeometryError";
  } catch (const GeometryError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("(0.31"), std::string::npos) << message;
    EXPECT_NE(message.find("simplify the contour"), std::string::npos) << message;
  }
}

TEST(BoundarySites, TouchingLoopsAreRefused) {
  Boundary boundary = square();
  boundary.loops.push_back(polygon_loop({{0.1, 0.1}, {0.4, 0.3}, {0.5, 0.2}}));
  EXPECT_THROW(testing::make_boundary_sites(boundary, UniformSize(0.05), unit_lattice(), 30), GeometryError);
}

TEST(BoundarySites, AbsurdSizesAreRefused) {
  EXPECT_THROW(testing::make_boundary_sites(square(), UniformSize(0), unit_lattice(), 30), GeometryError);
  EXPECT_THROW(testing::make_boundary_sites(square(), UniformSize(-1), unit_lattice(), 30), GeometryError);
  EXPECT_THROW(testing::make_boundary_sites(square(), UniformSize(1e-13), unit_lattice(), 30), GeometryError);
  EXPECT_THROW(testing::make_boundary_sites(square(), UniformSize(std::nan("")), unit_lattice(), 30), GeometryError);
}

} // namespace
} // namespace trime::boundary
