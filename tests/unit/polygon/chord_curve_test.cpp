// SPDX-License-Identifier: BSD-3-Clause
// Chords against the curve that they stand for: closed forms, and dense samples where there are none.
#include "polygon/chord_curve.hpp"
#include "support/laid_sites.hpp"

#include "support/boundary_shapes.hpp"
#include "support/periodic_shapes.hpp"
#include "trime/geometry/vec2.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace trime::polygon {
namespace {

using geometry::Boundary;
using geometry::Loop;
using geometry::Piece;
using geometry::Vec2;
using sizing::UniformSize;
using testing::boundary_of;
using testing::circle_loop;
using testing::make_boundary_sites;
using testing::polygon_loop;
using testing::unit_lattice;

BoundarySites sites_of(const Boundary& boundary, double h) {
  return make_boundary_sites(boundary, UniformSize(h), unit_lattice(), 30);
}

double polygon_area(const BoundarySites& sites, std::size_t loop = 0) {
  std::vector<Vec2> positions;
  for (LocalIndex k = sites.loop_start[loop]; k < sites.loop_start[loop + 1]; ++k)
    positions.push_back(sites.sites[k].position);
  return testing::signed_area(positions);
}

double area_of(const std::vector<ChordCurve>& chords) {
  double sum = 0;
  for (const ChordCurve& chord : chords)
    sum += chord.area;
  return sum;
}

std::vector<ChordCurve> all_chords(const Boundary& boundary, const BoundarySites& sites) {
  return compare_chords(boundary, sites, 0, static_cast<LocalIndex>(sites.sites.size()));
}

TEST(ChordCurve, SidesThatAreResolvedDoNotDiffer) {
  const Boundary square = boundary_of({polygon_loop({{0.1, 0.1}, {0.9, 0.1}, {0.9, 0.9}, {0.1, 0.9}})});
  const BoundarySites sites = sites_of(square, 0.05);
  for (const ChordCurve& chord : all_chords(square, sites)) {
    EXPECT_LT(chord.offset, 1e-13);
    EXPECT_LT(chord.deviation, 1e-13);
    EXPECT_LT(std::fabs(chord.area), 1e-15);
    EXPECT_EQ(chord.curvature, 0);
  }
}

TEST(ChordCurve, CirclesAndHolesHaveTheirSegments) {
  for (const bool hole : {false, true})
    for (const double h : {0.01, 0.13, 2.0}) {
      const double r = 0.3;
      const Boundary disc = boundary_of({circle_loop({0.5, 0.5}, r, hole)});
      const BoundarySites sites = sites_of(disc, h);
      const std::vector<ChordCurve> chords = all_chords(disc, sites);
      EXPECT_EQ(compare_chords(disc, sites, 1, 2).front().area, chords[1].area) << "of some sites alone";
      for (std::size_t k = 0; k < chords.size(); ++k) {
        const geometry::Segment chord = sites.chord(static_cast<LocalIndex>(k));
        const double length = geometry::length(chord.b - chord.a), turn = 2 * std::asin(0.5 * length / r);
        EXPECT_NEAR(chords[k].deviation, r * (1 - std::cos(0.5 * turn)), 1e-12);
        EXPECT_NEAR(chords[k].area, (hole ? -0.5 : 0.5) * r * r * (turn - std::sin(turn)), 1e-13);
        EXPECT_DOUBLE_EQ(chords[k].curvature, 1 / r);
      }
      EXPECT_NEAR(polygon_area(sites) + area_of(chords), (hole ? -pi : pi) * r * r, 1e-12);
      EXPECT_NEAR(area_of_loops(disc), (hole ? -pi : pi) * r * r, 1e-12);
    }
}

/// The bottom bends by 0.02 in its middle, at less than the corner angle: with long edges one chord cuts it off.
TEST(ChordCurve, WhatAChordCutsOffIsCounted) {
  for (const double y : {0.08, 0.12}) {
    const Boundary bent = boundary_of({polygon_loop({{0.1, 0.1}, {0.5, y}, {0.9, 0.1}, {0.9, 0.9}, {0.1, 0.9}})});
    const BoundarySites sites = sites_of(bent, 100);
    ASSERT_EQ(sites.sites.size(), 4u);
    const std::vector<ChordCurve> chords = all_chords(bent, sites);
    const auto cut = std::max_element(chords.begin(), chords.end(), [](const ChordCurve& a, const ChordCurve& b) {
      return a.deviation < b.deviation;
    });
    EXPECT_NEAR(cut->deviation, 0.02, 1e-12);
    EXPECT_NEAR(cut->area, 0.4 * (0.1 - y), 1e-12);
    EXPECT_EQ(cut->curvature, 0);
    EXPECT_NEAR(polygon_area(sites) + area_of(chords), area_of_loops(bent), 1e-14);
  }
}

/// A lens of two arcs, a rounded rectangle: chords across arcs and sides, and where a place is wrong.
TEST(ChordCurve, LargestDistanceIsThatOfADenseSample) {
  Loop loop = circle_loop({0.5, 0.5}, 0.3);
  loop.pieces.resize(2); // the upper half, closed by two sides that meet in a flat angle
  Piece side = loop.pieces[1];
  side.circular = false;
  const Vec2 left = side.end, right = loop.pieces[0].start, middle = unit_lattice().snap({0.55, 0.47});
  side.start = left;
  side.end = middle;
  loop.pieces.push_back(side);
  side.start = middle;
  side.end = right;
  loop.pieces.push_back(side);
  const Boundary half = boundary_of({loop});
  BoundarySites sites = sites_of(half, 0.17);
  const LocalIndex n = static_cast<LocalIndex>(sites.sites.size());
  for (const LocalIndex far : {1, 2, 5}) { // chords over several sites too
    for (LocalIndex k = 0; k < n; ++k)
      sites.sites[k].next = (k + far) % n;
    const std::vector<ChordCurve> chords = all_chords(half, sites);
    for (LocalIndex k = 0; k < n; ++k) {
      const geometry::Segment chord = sites.chord(k);
      double largest = 0;
      const BoundarySite &a = sites.sites[k], &b = sites.sites[sites.sites[k].next];
      const auto length_before = [&](LocalIndex piece) {
        double sum = 0;
        for (LocalIndex j = 0; j < piece; ++j)
          sum += loop.pieces[static_cast<std::size_t>(j)].length();
        return sum;
      };
      const double from = length_before(a.piece) + a.along;
      double to = length_before(b.piece) + b.along;
      to += to <= from ? loop.length() : 0;
      for (int j = 0; j <= 2000; ++j) {
        double s = std::fmod(from + (to - from) * j / 2000, loop.length());
        std::size_t piece = 0;
        for (; s > loop.pieces[piece].length() && piece < 3; ++piece)
          s -= loop.pieces[piece].length();
        largest = std::max(largest, std::sqrt(squared_distance(loop.pieces[piece].point(s), chord)));
      }
      EXPECT_NEAR(chords[static_cast<std::size_t>(k)].deviation, largest, 1e-4) << far << " " << k;
      EXPECT_GE(chords[static_cast<std::size_t>(k)].deviation, largest - 1e-12);
    }
  }
}

TEST(ChordCurve, AChordHasThePartInTheMiddleOfItsCurve) {
  Loop loop = polygon_loop({{0.1, 0.1}, {0.2, 0.09}, {0.8, 0.09}, {0.9, 0.1}, {0.9, 0.9}, {0.1, 0.9}});
  BoundarySites coarse = sites_of(boundary_of({loop}), 100); // as if corners between parts were left out
  for (std::size_t k = 0; k < loop.pieces.size(); ++k)
    loop.pieces[k].part = static_cast<int>(k);
  const Boundary boundary = boundary_of({loop});
  polygon::name_parts(boundary, coarse);
  ASSERT_EQ(coarse.sites.size(), 4u);
  for (const BoundarySite& site : coarse.sites) // pieces 0, 1, 2 make one chord, of which 1 is the middle
    EXPECT_EQ(site.part, site.position == loop.pieces[0].start ? 1 : site.piece);
  const std::vector<LoopSummary> loops = summarize_loops(boundary, coarse);
  ASSERT_EQ(loops.size(), 1u);
  EXPECT_EQ(loops[0].edges, 4);
  EXPECT_NEAR(loops[0].length, 3.2, 1e-12);
  EXPECT_EQ(loops[0].parts, (std::vector<std::int32_t>{1, 3, 4, 5}));
  std::vector<int> seen(6, 0);
  for (const BoundarySite& site : sites_of(boundary, 0.01).sites)
    ++seen[static_cast<std::size_t>(site.part)];
  EXPECT_NEAR(seen[0], 10, 1);
  EXPECT_NEAR(seen[1], 60, 1);
  EXPECT_NEAR(seen[4], 80, 1);
}

TEST(ChordCurve, LoopsAreOuterOnesHolesAndBands) {
  const auto kinds = [](const shape::RegionShape& shape) {
    const Boundary& boundary = shape.boundary();
    std::vector<LoopSummary::Kind> list;
    for (const LoopSummary& loop :
         summarize_loops(boundary, make_boundary_sites(boundary, UniformSize(0.05), shape.frame().lattice(), 30)))
      list.push_back(loop.kind);
    return list;
  };
  using Kind = LoopSummary::Kind;
  EXPECT_EQ(kinds(testing::torus_with_hole()), std::vector{Kind::hole});
  EXPECT_EQ(kinds(testing::disc_at_corner()), std::vector{Kind::outer});
  EXPECT_EQ(kinds(testing::band()), (std::vector{Kind::band, Kind::band}));
  EXPECT_TRUE(kinds(testing::whole_torus()).empty());
}

TEST(ChordCurve, PlacesAndAreasInPeriodicContainers) {
  for (const shape::RegionShape& shape :
       {testing::torus_with_hole(), testing::disc_at_corner(), testing::band(), testing::wavy_band()}) {
    SCOPED_TRACE(shape.region().text());
    const Boundary& boundary = shape.boundary();
    const BoundarySites sites = make_boundary_sites(boundary, UniformSize(0.04), shape.frame().lattice(), 30);
    for (const ChordCurve& chord : all_chords(boundary, sites)) {
      EXPECT_LT(chord.offset, 1e-12);
      EXPECT_LT(chord.deviation, 0.01);
      EXPECT_LT(std::fabs(chord.area), 0.0004);
    }
    EXPECT_NEAR(area_of_loops(boundary), boundary.area, 1e-12);
  }
}

} // namespace
} // namespace trime::polygon
