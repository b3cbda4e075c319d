// SPDX-License-Identifier: BSD-3-Clause
// Curves inside a shape: from lines to arcs, from arcs to chords, and what the guard does with the chords.
#include "core/random.hpp"
#include "generalise/thin_inner_curves.hpp"
#include "geometry/predicates.hpp"
#include "polygon/both_sides.hpp"
#include "polygon/boundary_guard.hpp"
#include "polygon/rules.hpp"
#include "support/boundary_shapes.hpp"
#include "support/laid_sites.hpp"
#include "trime/core/error.hpp"
#include "trime/shape/region_shape.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace trime::boundary {
namespace {

using geometry::InnerArc;
using geometry::InnerCurves;
using geometry::Vec2;
using polygon::BoundarySites;
using polygon::InnerChord;
using sizing::UniformSize;
using testing::unit_lattice;

const geometry::Frame frame(geometry::unit_square);

/// The unit square with these lines; each line is a curve.
geometry::Domain square_with(const std::vector<std::vector<Vec2>>& lines, bool closed = false) {
  shape::InnerParts curves;
  for (std::size_t k = 0; k < lines.size(); ++k)
    curves.curves.push_back(shape::Part::curve("curve" + std::to_string(k), {{lines[k], closed}}, frame));
  return shape::domain_of({}, "domain", frame, curves);
}

BoundarySites laid(const geometry::Domain& domain, double h) {
  return testing::make_boundary_sites(domain.boundary(), UniformSize(h), unit_lattice(), 30, {}, {},
                                      std::numeric_limits<std::size_t>::max(), domain.curves());
}

double length_of(const InnerCurves& curves) {
  double sum = 0;
  for (const InnerArc& arc : curves.arcs)
    for (const geometry::Piece& piece : arc.pieces)
      sum += piece.length();
  return sum;
}

/// Lines from above and from below end on a line from left to right, at a distance of 0.004.
geometry::Domain close_crossings() {
  return square_with({{{0.1, 0.5}, {0.9, 0.5}}, {{0.5, 0.5}, {0.5, 0.8}}, {{0.504, 0.5}, {0.504, 0.2}}});
}

TEST(InnerCurves, CloseNodesBecomeOne) {
  const geometry::Domain domain = close_crossings();
  ASSERT_EQ(domain.curves().arcs.size(), 5U);
  for (const double h : {0.1, 0.01}) {
    const InnerCurves thinned =
        generalise::thin_inner_curves(domain.curves(), domain.boundary(), UniformSize(h), unit_lattice(), {});
    EXPECT_EQ(thinned.joined_nodes, h == 0.1 ? 1 : 0);
    EXPECT_EQ(thinned.arcs.size(), h == 0.1 ? 4U : 5U);
    EXPECT_NEAR(length_of(thinned), length_of(domain.curves()), 0.02);
  }
}

TEST(InnerCurves, FlatFacesKeepTheirTwoSides) {
  const geometry::Domain domain = square_with({{{0.25, 0.5}, {0.5, 0.503}, {0.75, 0.5}},
                                               {{0.25, 0.5}, {0.5, 0.497}, {0.75, 0.5}},
                                               {{0.375, 0}, {0.4375, 0.004}, {0.5, 0}}});
  InnerCurves given = domain.curves();
  given.kinds.assign(3, {});
  given.kinds[1].split = given.kinds[2].split = true; // so they do not become one line with others
  const InnerCurves thinned =
      generalise::thin_inner_curves(given, domain.boundary(), UniformSize(0.1), unit_lattice(), {});
  ASSERT_EQ(thinned.arcs.size(), 3U);
  for (const InnerArc& arc : thinned.arcs)
    EXPECT_EQ(arc.pieces.size(), 2U); // two straight arcs would be one edge, or lie on the boundary
}

TEST(InnerCurves, AStraightLineAcrossTheShapeLosesItsVertices) {
  const geometry::Domain domain = square_with({{{0, 0.3}, {0.0001, 0.3}, {0.4, 0.3}, {0.7, 0.3}, {1, 0.3}}});
  const InnerCurves thinned =
      generalise::thin_inner_curves(domain.curves(), domain.boundary(), UniformSize(0.1), unit_lattice(), {});
  ASSERT_EQ(thinned.arcs.size(), 1U);
  EXPECT_EQ(thinned.arcs[0].pieces.size(), 2U); // between two places of the boundary it keeps one vertex
  EXPECT_GT(thinned.arcs[0].pieces[0].length(), 0.1);
}

TEST(InnerCurves, CloseNodesStayWhereAPointIsFixed) {
  const geometry::Domain domain = close_crossings();
  std::vector<Vec2> fixed;
  for (const InnerArc& arc : domain.curves().arcs)
    for (const Vec2 end : {arc.pieces.front().start, arc.pieces.back().end})
      fixed.push_back(end);
  std::sort(fixed.begin(), fixed.end(), geometry::lexicographically_less);
  EXPECT_EQ(generalise::thin_inner_curves(domain.curves(), domain.boundary(), UniformSize(0.1), unit_lattice(), fixed)
                .joined_nodes,
            0);
}

InnerCurves simplified(const geometry::Domain& domain, double h) {
  return generalise::thin_inner_curves(domain.curves(), domain.boundary(), UniformSize(h), unit_lattice(), {});
}

TEST(InnerCurves, SmallTrianglesBetweenThreeLinesClose) {
  const geometry::Domain domain =
      square_with({{{0.1, 0.5}, {0.9, 0.5}}, {{0.3, 0.2}, {0.702, 0.8}}, {{0.7, 0.2}, {0.31, 0.8}}});
  ASSERT_EQ(domain.curves().arcs.size(), 9U);
  const InnerCurves joined = simplified(domain, 0.1);
  ASSERT_EQ(joined.arcs.size(), 6U);
  EXPECT_EQ(joined.joined_nodes, 2);
  Vec2 low{1, 1}, high{0, 0}; // of the ends in the middle
  for (const InnerArc& arc : joined.arcs)
    for (const Vec2 p : {arc.pieces.front().start, arc.pieces.back().end})
      if (geometry::length(p - Vec2{0.5, 0.5}) < 0.1) {
        low = {std::fmin(low.x, p.x), std::fmin(low.y, p.y)};
        high = {std::fmax(high.x, p.x), std::fmax(high.y, p.y)};
      }
  EXPECT_EQ(low, high);
  EXPECT_EQ(simplified(domain, 0.001).arcs.size(), 9U);
}

TEST(InnerCurves, AreCutAtCrossings) {
  const Vec2 middle{0.5, 0.5};
  const geometry::Domain domain = square_with({{{0.25, 0.25}, {0.75, 0.75}}, {{0.25, 0.75}, {0.75, 0.25}}});
  ASSERT_EQ(domain.curves().arcs.size(), 4U);
  for (const InnerArc& arc : domain.curves().arcs) {
    EXPECT_FALSE(arc.closed);
    EXPECT_TRUE(arc.pieces.front().start == middle || arc.pieces.back().end == middle);
    EXPECT_EQ(arc.start_wedge, 0);
  }
  EXPECT_EQ(domain.boundary().loops.at(0).pieces.size(), 4U);
}

TEST(InnerCurves, MakeCornersOfTheBoundary) {
  const geometry::Domain domain = square_with({{{0, 0.5}, {1, 0.5}}});
  ASSERT_EQ(domain.curves().arcs.size(), 1U);
  int corners = 0;
  for (const geometry::Piece& piece : domain.boundary().loops.at(0).pieces)
    corners += piece.corner ? 1 : 0;
  EXPECT_EQ(corners, 2);
}

TEST(InnerCurves, HaveNodesWhereOneMeetsItself) {
  const geometry::Domain domain = square_with({{{0.25, 0.5}, {0.75, 0.5}, {0.75, 0.75}, {0.5, 0.75}, {0.5, 0.25}}});
  EXPECT_EQ(domain.curves().arcs.size(), 3U); // two ends, and a ring from the crossing to itself
}

TEST(InnerCurves, KnowSharpAngles) {
  const geometry::Domain domain = square_with({{{0.25, 0.5}, {0.75, 0.5}}, {{0.25, 0.5}, {0.75, 0.625}}});
  ASSERT_EQ(domain.curves().arcs.size(), 2U);
  for (const InnerArc& arc : domain.curves().arcs)
    EXPECT_NEAR(arc.start_wedge, std::atan(0.25), 1e-12);
}

TEST(InnerCurves, MustLieInside) {
  EXPECT_THROW(square_with({{{0.5, 0.5}, {1.5, 0.5}}}), GeometryError);
  shape::InnerParts curves;
  curves.curves.push_back(shape::Part::curve("long", {{{{0.5, 0.5}, {1.5, 0.5}}, false}}, frame));
  curves.clip = {1};
  const geometry::Domain domain = shape::domain_of({}, "domain", frame, curves);
  EXPECT_EQ(length_of(domain.curves()), 0.5);
  EXPECT_EQ(domain.curves().outside.at(0), 0.5);
}

TEST(InnerCurves, AreRefusedWithoutExtent) {
  EXPECT_THROW(shape::Part::curve("point", {{{{0.5, 0.5}, {0.5, 0.5}}, false}}, frame), GeometryError);
}

/// No end of a chord and no boundary site lies in the circle of another chord.
void expect_empty_circles(const BoundarySites& sites) {
  std::vector<geometry::Segment> chords;
  for (LocalIndex k = 0; k < std::ssize(sites.sites); ++k)
    chords.push_back(sites.chord(k));
  std::vector<Vec2> places;
  for (const polygon::BoundarySite& site : sites.sites)
    places.push_back(site.position);
  places.insert(places.end(), sites.inner.sites.begin(), sites.inner.sites.end());
  for (const InnerChord& chord : sites.inner.chords)
    chords.push_back(chord.ends);
  for (const geometry::Segment& chord : chords)
    for (const Vec2 p : places)
      EXPECT_TRUE(p == chord.a || p == chord.b || geometry::diametral_side(chord.a, chord.b, p) > 0);
}

TEST(InnerChords, HaveEmptyCircles) {
  for (const double degrees : {3.0, 10.0, 31.0, 58.0, 75.0, 90.0}) {
    const double slope = std::tan(degrees * pi / 180);
    const Vec2 far = slope < 1 ? Vec2{0.75, 0.25 + 0.5 * slope} : Vec2{0.25 + 0.5 / slope, 0.75};
    const BoundarySites sites = laid(square_with({{{0, 0.25}, {0.875, 0.25}}, {{0.25, 0.25}, far}}), 0.04);
    expect_empty_circles(sites);
    EXPECT_GT(sites.inner.chords.size(), 20U);
    EXPECT_LT(sites.inner.chords.size(), 300U);
  }
}

TEST(InnerChords, NeverCoincide) { // a lens: two curves with the same ends, and one along the boundary
  const BoundarySites sites = laid(square_with({{{0.25, 0.5}, {0.5, 0.503}, {0.75, 0.5}},
                                                {{0.25, 0.5}, {0.5, 0.497}, {0.75, 0.5}},
                                                {{0.25, 0}, {0.5, 0.003}, {0.75, 0}}}),
                                   0.6);
  expect_empty_circles(sites);
  std::vector<std::pair<Vec2, Vec2>> ends;
  for (const InnerChord& chord : sites.inner.chords)
    ends.push_back(std::minmax(chord.ends.a, chord.ends.b, geometry::lexicographically_less));
  for (std::size_t k = 0; k < ends.size(); ++k)
    for (std::size_t j = 0; j < k; ++j)
      EXPECT_FALSE(ends[k] == ends[j]);
}

TEST(InnerChords, OfARingCloseIt) {
  const BoundarySites sites = laid(square_with({{{0.25, 0.25}, {0.75, 0.25}, {0.75, 0.75}, {0.25, 0.75}}}, true), 0.1);
  EXPECT_EQ(sites.inner.chords.size(), sites.inner.sites.size());
  for (const Vec2 p : sites.inner.sites)
    EXPECT_EQ(sites.inner.at(p).size(), 2U);
  EXPECT_TRUE(sites.inner.is_corner({0.25, 0.25}));
}

TEST(BothSides, WalkAroundFaces) {
  const BoundarySites sites = laid(square_with({{{0, 0.5}, {1, 0.5}}, {{0.5, 0.5}, {0.5, 0.75}}}), 0.125);
  const BoundarySites sides = polygon::with_both_sides(sites);
  ASSERT_EQ(sides.sites.size(), sites.sites.size() + 2 * sites.inner.chords.size());
  std::vector<char> seen(sides.sites.size(), 0);
  std::vector<double> areas;
  for (std::size_t first = 0; first < seen.size(); ++first) {
    double twice_area = 0;
    for (auto k = static_cast<LocalIndex>(first); seen[static_cast<std::size_t>(k)] == 0;
         k = sides.sites[static_cast<std::size_t>(k)].next) {
      seen[static_cast<std::size_t>(k)] = 1;
      const LocalIndex next = sides.sites[static_cast<std::size_t>(k)].next;
      EXPECT_EQ(sides.sites[static_cast<std::size_t>(next)].previous, k);
      twice_area += geometry::cross(sides.chord(k).a, sides.chord(k).b);
    }
    if (twice_area != 0)
      areas.push_back(0.5 * twice_area);
  }
  ASSERT_EQ(areas.size(), 2U); // the halves of the square
  for (const double area : areas)
    EXPECT_NEAR(area, 0.5, 1e-12);
}

TEST(InnerChords, PushSitesToTheirOwnSide) {
  const BoundarySites sites = laid(square_with({{{0.25, 0.5}, {0.75, 0.5}}}), 0.05);
  const polygon::BoundaryGuard guard(sites, unit_lattice());
  const geometry::Segment chord = sites.inner.chords.at(3).ends;
  const Vec2 middle = 0.5 * (chord.a + chord.b), across{0, 0.2 * geometry::length(chord.b - chord.a)};
  for (const double side : {-1.0, 1.0}) {
    const Vec2 p = unit_lattice().snap(middle + side * across);
    ASSERT_TRUE(guard.pushes(p));
    const auto pushed = guard.correct(p, 0.05, unit_lattice());
    ASSERT_TRUE(pushed.has_value());
    EXPECT_GT(side * (pushed->y - 0.5), 0);
    EXPECT_FALSE(guard.pushes(*pushed));
    EXPECT_NEAR(guard.distance(p, 1), std::fabs(p.y - 0.5), 1e-12);
  }
  EXPECT_TRUE(guard.inside(middle));
}

TEST(ThinInnerCurves, KeepsNodesAndSides) {
  std::vector<Vec2> line, island;
  for (int k = 0; k <= 1000; ++k)
    line.push_back(unit_lattice().snap({0.125 + 0.00075 * k, 0.5 + 0.002 * (k % 2)}));
  const std::vector<Vec2> ends{unit_lattice().snap({0.5, 0.50075}), unit_lattice().snap({0.5005, 0.50075})};
  const geometry::Domain domain = square_with({line, ends});
  InnerCurves given = domain.curves();
  given.kinds.assign(2, {});
  given.kinds[1].split = true; // so it does not become one line with the other curve
  const InnerCurves thinned =
      generalise::thin_inner_curves(given, domain.boundary(), UniformSize(0.02), unit_lattice(), ends);
  ASSERT_EQ(thinned.arcs.size(), domain.curves().arcs.size());
  std::size_t before = 0, after = 0;
  for (std::size_t k = 0; k < thinned.arcs.size(); ++k) {
    before += domain.curves().arcs[k].pieces.size();
    after += thinned.arcs[k].pieces.size();
    EXPECT_EQ(thinned.arcs[k].pieces.front().start, domain.curves().arcs[k].pieces.front().start);
    EXPECT_EQ(thinned.arcs[k].pieces.back().end, domain.curves().arcs[k].pieces.back().end);
    for (std::size_t j = 1; j < thinned.arcs[k].pieces.size(); ++j)
      EXPECT_EQ(thinned.arcs[k].pieces[j].start, thinned.arcs[k].pieces[j - 1].end);
  }
  EXPECT_GT(before, 900U);
  EXPECT_LT(after, 100U);
}

} // namespace
} // namespace trime::boundary
