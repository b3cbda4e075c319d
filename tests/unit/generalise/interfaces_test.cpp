// SPDX-License-Identifier: BSD-3-Clause
// Interfaces between regions: smoothed, with the areas that they lose, and wedges between two of them.
#include "boundary/laid_curves.hpp"
#include "generalise/cut_wedges.hpp"
#include "generalise/meeting_pieces.hpp"
#include "generalise/rules.hpp"
#include "generalise/smooth_arcs.hpp"
#include "generalise/thin_inner_curves.hpp"
#include "meshing/region_losses.hpp"
#include "support/boundary_shapes.hpp"
#include "support/laid_sites.hpp"
#include "trime/shape/region_shape.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace trime::generalise {
namespace {

using geometry::InnerArc;
using geometry::InnerCurves;
using geometry::LossReason;
using geometry::RegionLoss;
using geometry::Vec2;
using sizing::UniformSize;
using testing::unit_lattice;

constexpr double h = 0.03125;

geometry::Boundary unit_square() {
  return shape::domain_of({}, "domain", geometry::Frame(geometry::unit_square)).boundary();
}

InnerArc arc_through(const std::vector<Vec2>& path, int left, int right) {
  InnerArc arc;
  arc.left = left;
  arc.right = right;
  for (std::size_t k = 1; k < path.size(); ++k) {
    if (path[k] == path[k - 1])
      continue;
    geometry::Piece& piece = arc.pieces.emplace_back();
    piece.start = unit_lattice().snap(path[k - 1]);
    piece.end = unit_lattice().snap(path[k]);
    piece.part = -1;
  }
  return arc;
}

/// Teeth of a height of 0.008 around y.
InnerArc teeth(double y, int left, int right) {
  std::vector<Vec2> path;
  for (int k = 20; k <= 180; ++k)
    path.push_back({0.005 * k, y + (k % 2 == 0 ? 0.004 : -0.004)});
  return arc_through(path, left, right);
}

double length_of(const InnerArc& arc) {
  double sum = 0;
  for (const geometry::Piece& piece : arc.pieces)
    sum += piece.length();
  return sum;
}

double area_beside(const InnerArc& arc) {
  double twice = 0;
  for (const geometry::Piece& piece : arc.pieces)
    twice += cross(piece.start, piece.end);
  return 0.5 * twice;
}

std::vector<InnerArc> smoothed(const std::vector<InnerArc>& arcs) {
  const UniformSize size(h);
  return smooth_arcs(arcs, unit_square(), {size, geometry::unit_square, GeneraliseRules::flow_reach, {}},
                     unit_lattice());
}

bool is_same(const InnerArc& a, const InnerArc& b) {
  return a.pieces.size() == b.pieces.size() && length_of(a) == length_of(b);
}

TEST(SmoothArcs, TeethBecomeStraightAndEndsStay) {
  const InnerArc given = teeth(0.5, 1, 0);
  const InnerArc smooth = smoothed({given}).at(0);
  EXPECT_GT(length_of(given), 1.5);
  EXPECT_LT(length_of(smooth), 0.81);
  EXPECT_EQ(smooth.pieces.front().start, given.pieces.front().start);
  EXPECT_EQ(smooth.pieces.back().end, given.pieces.back().end);
  EXPECT_NEAR(area_beside(smooth), area_beside(given), 1e-4);
}

TEST(SmoothArcs, CurvesWithOneRegionAndStraightInterfacesStay) {
  const InnerArc curve = teeth(0.5, 1, 1), straight = arc_through({{0.1, 0.25}, {0.5, 0.25}, {0.9, 0.25}}, 1, 0);
  const std::vector<InnerArc> smooth = smoothed({curve, straight});
  EXPECT_TRUE(is_same(smooth.at(0), curve));
  EXPECT_TRUE(is_same(smooth.at(1), straight));
}

TEST(SmoothArcs, AnArcDoesNotCrossAnotherOne) {
  const InnerArc ragged = teeth(0.5, 1, 0); // a needle of another curve reaches into a tooth, beyond the middle
  const InnerArc needle = arc_through({{0.4875, 0.25}, {0.4899, 0.5027}, {0.4901, 0.5027}, {0.4925, 0.25}}, 2, 1);
  const std::vector<InnerArc> smooth = smoothed({ragged, needle});
  for (const InnerArc& arc : smooth)
    for (const geometry::Piece& piece : arc.pieces)
      for (const InnerArc& other : smooth)
        for (const geometry::Piece& beside : other.pieces)
          EXPECT_FALSE(&piece != &beside && meet(piece, beside));
  EXPECT_TRUE(is_same(smooth.at(0), ragged));
}

TEST(MeetingPieces, CommonEndsAreNoCrossing) {
  const auto meets = [](Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
    return meet(arc_through({a, b}, 0, 1).pieces[0], arc_through({c, d}, 0, 1).pieces[0]);
  };
  EXPECT_FALSE(meets({0, 0}, {0.5, 0}, {0.5, 0}, {0.5, 0.5}));
  EXPECT_FALSE(meets({0, 0}, {0.5, 0}, {1, 0}, {0.5, 0}));
  EXPECT_TRUE(meets({0, 0}, {0.5, 0}, {0.25, 0}, {0.5, 0}));    // along it
  EXPECT_TRUE(meets({0, 0}, {0.5, 0}, {0.25, 0}, {0.25, 0.5})); // an end on it
  EXPECT_TRUE(meets({0, 0}, {0.5, 0.5}, {0, 0.5}, {0.5, 0}));
  EXPECT_FALSE(meets({0, 0}, {0.25, 0}, {0.5, 0}, {0.75, 0}));
}

/// The area next to the chords of the layout, as for the arcs.
double laid_area(const InnerCurves& curves) {
  const polygon::BoundarySites sites = testing::make_boundary_sites(
      unit_square(), UniformSize(h), unit_lattice(), 30, {}, {}, std::numeric_limits<std::size_t>::max(), curves);
  double twice = 0;
  for (const polygon::InnerChord& chord : sites.inner.chords)
    twice += cross(chord.ends.a, chord.ends.b);
  return 0.5 * twice;
}

TEST(KeptAreas, SitesOfSimplifiedInterfacesRestoreTheArea) {
  for (int seed = 1; seed <= 5; ++seed) {
    std::vector<Vec2> path;
    for (int k = 0; k <= 400; ++k) {
      const double noise = 0.5 * std::sin(1.7 * k * k + seed * k);
      path.push_back({0.125 + 0.001875 * k, 0.5 + 0.05 * std::sin(0.02 * k) + 0.01 * noise});
    }
    const InnerCurves given{{arc_through(path, 1, 0)}, {}};
    const InnerCurves thinned = thin_inner_curves(given, unit_square(), UniformSize(h), unit_lattice(), {});
    ASSERT_TRUE(thinned.arcs.at(0).is_simplified);
    EXPECT_NEAR(area_beside(thinned.arcs[0]) + thinned.arcs[0].lost_area, area_beside(given.arcs[0]), 1e-14);
    EXPECT_NEAR(laid_area(thinned), area_beside(given.arcs[0]), 1e-12);
  }
}

/// Region 2 between two lines from a node on the left side: 0 above, 1 below.
InnerCurves wedge(double height, double length = 1) {
  InnerCurves curves;
  curves.arcs.push_back(arc_through({{0, 0.5}, {length, 0.5}, {1, 0.5}}, 2, 1));
  curves.arcs.push_back(arc_through({{1, 0.5 + height}, {length, 0.5 + height * length}, {0, 0.5}}, 2, 0));
  return curves;
}

InnerCurves cut(InnerCurves curves, const std::vector<Vec2>& kept = {}) {
  const geometry::Boundary square = unit_square();
  const UniformSize size(h);
  const std::vector<geometry::NarrowWedge> wedges = geometry::narrow_wedges(curves.arcs, square);
  cut_wedges(curves, wedges, square, {size, unit_lattice(), kept});
  return curves;
}

TEST(CutWedges, ThinTipsGoToTheRegionWithTheLowerNumber) {
  const InnerCurves made = cut(wedge(0.1));
  ASSERT_EQ(made.arcs.size(), 3U);
  EXPECT_EQ(made.arcs[2].left, 0);
  EXPECT_EQ(made.arcs[2].right, 1);
  const Vec2 node = made.arcs[0].pieces.front().start;
  EXPECT_NEAR(node.x, 0.5 * h / 0.1, 0.01 * node.x);
  EXPECT_EQ(made.arcs[1].pieces.back().end, node);
  ASSERT_EQ(made.losses.size(), 1U);
  EXPECT_EQ(made.losses[0].loser, 2);
  EXPECT_EQ(made.losses[0].winner, 0);
  EXPECT_EQ(made.losses[0].reason, LossReason::pinch_out);
  const InnerCurves given = wedge(0.1);
  const auto area_of_wedge = [](const InnerCurves& curves) { // with the side of the square
    return area_beside(curves.arcs[0]) + area_beside(curves.arcs[1]) + 0.5 * cross(Vec2{1, 0.5}, Vec2{1, 0.6});
  };
  EXPECT_NEAR(area_of_wedge(given) - area_of_wedge(made), made.losses[0].area, 1e-12);
}

TEST(CutWedges, OthersStay) {
  EXPECT_TRUE(cut(wedge(0.4)).losses.empty()) << "wider than 20 degrees";
  EXPECT_TRUE(cut(wedge(0.1, 0.1)).losses.empty()) << "sides with a vertex before the cut";
  EXPECT_TRUE(cut(wedge(0.1), {{0, 0.5}}).losses.empty()) << "a fixed node";
  InnerCurves with_curve = wedge(0.1);
  with_curve.arcs.push_back(arc_through({{0.1, 0.502}, {0.12, 0.503}}, 2, 2));
  EXPECT_TRUE(cut(with_curve).losses.empty()) << "a curve in the tip";
}

TEST(RegionLosses, AreAddedUpByPairAndReason) {
  const geometry::Regions regions{{"a", "b"}, {}, {1, 1}, {0, 0}};
  const Vec2 there{0.5, 0.5};
  const std::vector<RegionLoss> sums = meshing::summed_losses({{1, 0, LossReason::thinning, 1e-3, 1, 1e-3, {}},
                                                               {0, 1, LossReason::sliver, 2e-3, 1, 2e-3, {}},
                                                               {1, 0, LossReason::thinning, 3e-3, 1, 3e-3, there},
                                                               {1, 0, LossReason::crumb, 1e-12, 1, 1e-12, {}}},
                                                              regions);
  ASSERT_EQ(sums.size(), 2U);
  EXPECT_EQ(sums[0].loser, 0);
  EXPECT_EQ(sums[1].loser, 1);
  EXPECT_DOUBLE_EQ(sums[1].area, 4e-3);
  EXPECT_EQ(sums[1].count, 2);
  EXPECT_EQ(sums[1].place, there);
}

} // namespace
} // namespace trime::generalise
