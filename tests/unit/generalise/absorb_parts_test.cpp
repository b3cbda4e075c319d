// SPDX-License-Identifier: BSD-3-Clause
// Parts of regions that are smaller or narrower than the triangles go to the regions next to them.
#include "generalise/absorb_parts.hpp"
#include "generalise/thin_inner_curves.hpp"
#include "support/boundary_shapes.hpp"
#include "trime/shape/region_shape.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <vector>

namespace trime::generalise {
namespace {

using geometry::InnerArc;
using geometry::InnerCurves;
using geometry::Vec2;
using sizing::UniformSize;
using testing::unit_lattice;

constexpr std::array<std::array<int, 2>, 3> all_pairs{{{0, 1}, {0, 2}, {1, 2}}};

/// The unit square without regions.
geometry::Boundary unit_square() {
  return shape::domain_of({}, "domain", geometry::Frame(geometry::unit_square)).boundary();
}

InnerArc arc_through(const std::vector<Vec2>& path, int left, int right, bool closed = false) {
  InnerArc arc;
  arc.left = left;
  arc.right = right;
  arc.closed = closed;
  for (std::size_t k = 1; k < path.size(); ++k) {
    geometry::Piece& piece = arc.pieces.emplace_back();
    piece.start = unit_lattice().snap(path[k - 1]);
    piece.end = unit_lattice().snap(path[k]);
    piece.part = -1;
  }
  return arc;
}

/// The area of each region, with what it has lost and without what it has gained.
std::map<int, double> balance(const InnerCurves& curves, const geometry::Boundary& boundary) {
  std::map<int, double> areas;
  for (const geometry::Loop& loop : boundary.loops)
    for (const geometry::Piece& piece : loop.pieces)
      areas[piece.region] += 0.5 * cross(piece.start, piece.end);
  for (const InnerArc& arc : curves.arcs) {
    areas[arc.left] += arc.lost_area;
    areas[arc.right] -= arc.lost_area;
    for (const geometry::Piece& piece : arc.pieces) {
      areas[arc.left] += 0.5 * cross(piece.start, piece.end);
      areas[arc.right] -= 0.5 * cross(piece.start, piece.end);
    }
  }
  for (const geometry::RegionLoss& loss : curves.losses) {
    areas[loss.loser] += loss.area;
    areas[loss.winner] -= loss.area;
  }
  return areas;
}

/// Checks that the simplification writes down all that regions lose.
Partition simplified(const InnerCurves& curves, double h) {
  const geometry::Boundary square = unit_square();
  const UniformSize size(h);
  Partition made = simplify_partition(curves, square, {size, unit_lattice(), {}}, all_pairs);
  std::map<int, double> before = balance(curves, square), after = balance(made.curves, made.boundary);
  for (const auto& [region, area] : before)
    EXPECT_NEAR(area, after[region], 1e-12) << region;
  return made;
}

/// Two squares of region 1, side by side, that share a strip of the given width and length 0.2.
InnerCurves dumb_bell(double width) {
  const double low = 0.5 - 0.5 * width, high = 0.5 + 0.5 * width;
  return {{arc_through({{0.1, 0.3},
                        {0.4, 0.3},
                        {0.4, low},
                        {0.6, low},
                        {0.6, 0.3},
                        {0.9, 0.3},
                        {0.9, 0.7},
                        {0.6, 0.7},
                        {0.6, high},
                        {0.4, high},
                        {0.4, 0.7},
                        {0.1, 0.7},
                        {0.1, 0.3}},
                       1, 0, true)},
          {}};
}

TEST(AbsorbParts, SmallFacesGoToTheRegionAroundThem) {
  InnerCurves curves = dumb_bell(0.2);
  curves.arcs.push_back(
      arc_through({{0.2, 0.8}, {0.22, 0.8}, {0.22, 0.82}, {0.2, 0.82}, {0.2, 0.8}}, 2, 0, true)); // 0.08 around
  const UniformSize fine(0.02), coarse(0.03);
  EXPECT_FALSE(absorb_parts(curves, unit_square(), {fine, unit_lattice(), {}}, all_pairs, SmallParts::faces));
  const auto made = absorb_parts(curves, unit_square(), {coarse, unit_lattice(), {}}, all_pairs, SmallParts::faces);
  ASSERT_TRUE(made);
  EXPECT_EQ(made->curves.arcs.size(), 1U);
  ASSERT_EQ(made->curves.losses.size(), 1U);
  EXPECT_EQ(made->curves.losses[0].loser, 2);
  EXPECT_EQ(made->curves.losses[0].winner, 0);
  EXPECT_NEAR(made->curves.losses[0].area, 4e-4, 1e-12);
}

TEST(AbsorbParts, KeptVerticesAndUnknownPairsStay) {
  InnerCurves curves{{arc_through({{0.2, 0.8}, {0.22, 0.8}, {0.22, 0.82}, {0.2, 0.82}, {0.2, 0.8}}, 2, 0, true)}, {}};
  const UniformSize coarse(0.03);
  const std::vector<Vec2> kept{curves.arcs[0].pieces[0].start};
  EXPECT_FALSE(absorb_parts(curves, unit_square(), {coarse, unit_lattice(), kept}, all_pairs, SmallParts::faces));
  for (geometry::Piece& piece : curves.arcs[0].pieces)
    piece.part = 0; // a curve of the user all around it
  EXPECT_FALSE(absorb_parts(curves, unit_square(), {coarse, unit_lattice(), {}}, all_pairs, SmallParts::faces));
}

TEST(AbsorbParts, NarrowPassagesAreCut) {
  EXPECT_EQ(simplified(dumb_bell(0.1), 0.1).curves.arcs.size(), 1U);
  const Partition made = simplified(dumb_bell(0.02), 0.1);
  ASSERT_EQ(made.curves.arcs.size(), 2U);
  for (const InnerArc& arc : made.curves.arcs)
    EXPECT_TRUE(arc.closed);
}

TEST(AbsorbParts, ANarrowEndAtTheBoundaryGoesWithItsCorners) {
  // Region 1 fills the upper half except a gap of 0.02, through which region 0 reaches the upper side.
  const InnerCurves curves{
      {arc_through({{1, 0.5}, {0.51, 0.5}, {0.51, 1}}, 0, 1), arc_through({{0.49, 1}, {0.49, 0.5}, {0, 0.5}}, 0, 1)},
      {}};
  geometry::Boundary square = unit_square();
  std::vector<geometry::Piece> pieces;
  const std::array<Vec2, 8> corners{{{0, 0}, {1, 0}, {1, 0.5}, {1, 1}, {0.51, 1}, {0.49, 1}, {0, 1}, {0, 0.5}}};
  const std::array<int, 8> regions{0, 0, 1, 1, 0, 1, 1, 0};
  for (std::size_t k = 0; k < corners.size(); ++k) {
    geometry::Piece piece;
    piece.start = unit_lattice().snap(corners[k]);
    piece.end = unit_lattice().snap(corners[(k + 1) % corners.size()]);
    piece.region = regions[k];
    piece.corner = k == 2 || k == 4 || k == 5 || k == 7;
    pieces.push_back(piece);
  }
  square.loops[0].pieces = pieces;
  const UniformSize size(0.1);
  const Partition made = simplify_partition(curves, square, {size, unit_lattice(), {}}, all_pairs);
  ASSERT_TRUE(made.is_relabelled);
  const std::vector<geometry::Piece>& rim = made.boundary.loops[0].pieces;
  EXPECT_EQ(rim[4].region, 1);
  EXPECT_FALSE(rim[4].corner);
  EXPECT_FALSE(rim[5].corner);
  EXPECT_TRUE(rim[2].corner);
  EXPECT_EQ(made.curves.arcs.size(), 1U);
  const std::map<int, double> before = balance(curves, square), after = balance(made.curves, made.boundary);
  EXPECT_NEAR(before.at(0), after.at(0), 1e-12);
}

TEST(AbsorbParts, AnArcFromANodeToItselfEnclosesSomething) {
  const InnerCurves curves{{arc_through({{0.3, 0}, {0.3, 0.5}}, 0, 0),
                            arc_through({{0.3, 0.5}, {0.5, 0.52}, {0.7, 0.5}, {0.5, 0.48}, {0.3, 0.5}}, 0, 1)},
                           {}};
  const UniformSize size(0.2);
  const InnerCurves thinned = thin_inner_curves(curves, unit_square(), size, unit_lattice(), {});
  EXPECT_GE(thinned.arcs[1].pieces.size(), 3U);
}

} // namespace
} // namespace trime::generalise
