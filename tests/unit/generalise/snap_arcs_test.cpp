// SPDX-License-Identifier: BSD-3-Clause
// Tests that curves become one line with the interfaces and curves that they follow.
#include "generalise/snap_arcs.hpp"

#include "arc_paths.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/sizing/size_field.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace trime::generalise {
namespace {

using geometry::InnerArc;
using geometry::Vec2;

class SnapArcs : public ::testing::Test {
protected:
  Vec2 at(double x, double y) const { return lattice_.snap({x, y}); }
  InnerArc interface() const {
    return arc_of({at(0, 0.5), at(0.21, 0.5005), at(0.42, 0.4995), at(0.6, 0.5), at(0.83, 0.5003), at(1, 0.5)}, -1, 0,
                  1);
  }
  SnappedArcs snapped(const std::vector<InnerArc>& arcs, std::span<const geometry::CurveKind> kinds = {}) const {
    geometry::Boundary square;
    square.loops.emplace_back().pieces = pieces_of({{0, 0}, {1, 0}, {1, 0.5}, {1, 1}, {0, 1}, at(0, 0.5), {0, 0}}, 0);
    const sizing::UniformSize size(0.024);
    return snapped_arcs(arcs, square, {size, lattice_, {}, kinds});
  }

private:
  const geometry::Lattice lattice_ = geometry::Frame(geometry::Box{{0, 0}, {1, 1}}).lattice();
};

TEST_F(SnapArcs, LinesThatFollowEachOtherBecomeOne) {
  const std::vector<Vec2> fault{at(0.15, 0.502), at(0.3, 0.5018), at(0.5, 0.5022), at(0.7, 0.5016), at(0.9, 0.502)};
  const SnappedArcs result = snapped({arc_of(fault, 0, 0, 0), interface()});
  EXPECT_EQ(result.joined.vertices, 9); // 5 of the fault, 4 of the interface
  EXPECT_LT(result.joined.farthest, 0.2 * 0.024);
  ASSERT_EQ(result.arcs.size(), 3U);
  const InnerArc& along = result.arcs[0];
  EXPECT_EQ(along.pieces.size(), 8U);
  EXPECT_EQ(along.pieces.front().start, fault.front());
  EXPECT_EQ(along.pieces.back().end, fault.back());
  EXPECT_EQ(std::pair(along.left, along.right), std::pair(0, 1));
  EXPECT_GT(along.lost_area, 0); // the upper region lies on the left, and the interface has gone up
}

TEST_F(SnapArcs, LinesFartherApartStay) {
  const std::vector<Vec2> fault{at(0.15, 0.508), at(0.5, 0.508), at(0.9, 0.508)};
  const SnappedArcs result = snapped({arc_of(fault, 0, 0, 0), interface()});
  EXPECT_EQ(result.joined.vertices, 0);
  EXPECT_EQ(result.arcs.size(), 2U);
}

TEST_F(SnapArcs, ACurveLeavesItsInterfaceAtAVertex) {
  const Vec2 crossing = at(0.3, 0.5002), last = at(0.7, 0.499);
  const SnappedArcs result = snapped(
      {arc_of({at(0.15, 0.502), crossing}, 0, 0, 0), arc_of({crossing, at(0.5, 0.498), last, at(0.8, 0.47)}, 0, 1, 1),
       arc_of({at(0, 0.5), at(0.21, 0.5005), crossing}, -1, 0, 1),
       arc_of({crossing, at(0.42, 0.4995), at(0.6, 0.5), at(0.83, 0.5003), at(1, 0.5)}, -1, 0, 1)});
  ASSERT_EQ(result.arcs.size(), 4U);
  EXPECT_EQ(result.arcs[0].pieces.back().end, last); // through the crossing, which is no node any more
  EXPECT_EQ(std::pair(result.arcs[0].left, result.arcs[0].right), std::pair(0, 1));
  EXPECT_EQ(std::pair(result.arcs[1].left, result.arcs[1].right), std::pair(1, 1));
}

TEST_F(SnapArcs, ArcsEndOnTheBoundary) {
  const Vec2 rim{1, 0.5};
  const SnappedArcs result = snapped({arc_of({at(0.8, 0.45), rim}, 0, 0, 0), arc_of({rim, at(0.8, 0.55)}, 0, 0, 0),
                                      arc_of({at(0.9, 0.3), at(0.9, 0.474)}, 1, 0, 0)});
  EXPECT_EQ(result.joined.vertices, 1); // the first arc leads through the end of the last one
  for (const InnerArc& arc : result.arcs)
    for (std::size_t k = 1; k < arc.pieces.size(); ++k)
      EXPECT_NE(arc.pieces[k].start, rim);
}

class SnapCurves : public SnapArcs {
protected:
  /// A river along the middle; the tributary comes from above.
  std::vector<InnerArc> confluence(Vec2 end) const {
    return {arc_of({at(0.1, 0.3), at(0.9, 0.3)}, 0, 0, 0), arc_of({at(0.5, 0.7), at(0.5, 0.35), end}, 1, 0, 0)};
  }
};

TEST_F(SnapCurves, AnEndJustBeforeAnotherCurveComesToLieOnIt) {
  const Vec2 end = at(0.5, 0.304);
  const SnappedArcs result = snapped(confluence(end));
  EXPECT_EQ(result.joined.vertices, 1);
  ASSERT_EQ(result.arcs.size(), 3U);
  EXPECT_EQ(result.arcs[0].pieces.back().end, end); // the river leads through the end of the tributary
  EXPECT_EQ(result.arcs[1].pieces.front().start, end);
  EXPECT_EQ(result.arcs[2].pieces.back().end, end);
  EXPECT_EQ(snapped(confluence(at(0.5, 0.306))).joined.vertices, 0); // 0.25 h
}

TEST_F(SnapCurves, AShortEndBeyondAnotherCurveIsLeftOut) {
  const Vec2 crossing = at(0.5, 0.3), end = at(0.5, 0.298);
  const std::vector<InnerArc> arcs{arc_of({at(0.1, 0.3), crossing}, 0, 0, 0), arc_of({crossing, at(0.9, 0.3)}, 0, 0, 0),
                                   arc_of({at(0.5, 0.7), crossing}, 1, 0, 0), arc_of({crossing, end}, 1, 0, 0),
                                   arc_of({crossing, at(0.499, 0.302)}, 2, 0, 0)};
  const SnappedArcs result = snapped(arcs);
  EXPECT_EQ(result.joined.loose_ends, 1);
  EXPECT_NEAR(result.joined.longest_end, 0.002, 1e-9);
  ASSERT_EQ(result.arcs.size(), 4U); // all of curve 2 is short: it stays
  EXPECT_EQ(result.arcs.back().pieces.front().part, 2);
}

TEST_F(SnapCurves, ManyVerticesNearACrossingStay) {
  std::vector<Vec2> path{at(0.5, 0.3)};
  for (int k = 1; k < 50; ++k)
    path.push_back(at(0.5 + 1e-5 * k * k, 0.3 + 0.001 * k));
  const SnappedArcs result = snapped(
      {arc_of({at(0.1, 0.3), path[0]}, 0, 0, 0), arc_of({path[0], at(0.9, 0.3)}, 0, 0, 0), arc_of(path, 0, 0, 0)});
  EXPECT_EQ(result.joined.vertices, 0);
}

TEST_F(SnapCurves, TwoLinesBetweenTwoCrossingsBecomeOneUnlessOneIsSplit) {
  const Vec2 a = at(0.4, 0.3), b = at(0.45, 0.3);
  const std::vector<InnerArc> arcs{arc_of({at(0.1, 0.3), a}, 0, 0, 0), arc_of({a, b}, 0, 0, 0),
                                   arc_of({b, at(0.9, 0.3)}, 0, 0, 0), arc_of({a, at(0.447, 0.302), b}, 1, 0, 0),
                                   arc_of({b, at(0.6, 0.1)}, 1, 0, 0)};
  EXPECT_EQ(snapped(arcs).joined.vertices, 1);
  std::vector<geometry::CurveKind> kinds(2);
  kinds[1].split = true;
  EXPECT_EQ(snapped(arcs, kinds).joined.vertices, 0);
}

} // namespace
} // namespace trime::generalise
