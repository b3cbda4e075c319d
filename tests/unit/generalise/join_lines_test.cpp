// SPDX-License-Identifier: BSD-3-Clause
// Tests that curves which run along the boundary, interfaces or other curves belong to them, and that others stay.
#include "generalise/join_lines.hpp"

#include "arc_paths.hpp"
#include "geometry/piece_parts.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/sizing/size_field.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

namespace trime::generalise {
namespace {

using geometry::InnerArc;
using geometry::Piece;
using geometry::Vec2;

constexpr double h = 0.02;

class JoinLines : public ::testing::Test {
protected:
  JoinLines() { square_.loops.emplace_back().pieces = pieces_of({{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}}, 0); }

  Vec2 at(double x, double y) const { return lattice_.snap({x, y}); }
  std::optional<Partition> joined(const std::vector<InnerArc>& arcs, std::span<const Vec2> kept = {}) const {
    Partition given;
    given.boundary = square_;
    given.curves.arcs = arcs;
    given.curves.names = {"one", "two"};
    given.curves.kinds = kinds_;
    const sizing::UniformSize size(h);
    return join_lines(given, {size, lattice_, kept});
  }
  /// Adds a hole around the middle of the square: one circle.
  void add_hole() {
    Piece circle;
    circle.start = circle.end = at(0.7, 0.5);
    circle.center = {0.5, 0.5};
    circle.radius = 0.2;
    circle.sweep = -2 * std::numbers::pi;
    circle.circular = true;
    geometry::Loop& hole = square_.loops.emplace_back();
    hole.outer = false;
    hole.pieces = {circle};
  }
  /// A ring around the hole.
  InnerArc ring(double radius, double shift) const {
    std::vector<Vec2> path;
    for (int k = 0; k <= 100; ++k)
      path.push_back(at(0.5 + shift + radius * std::cos(2 * std::numbers::pi * (k % 100) / 100),
                        0.5 + radius * std::sin(2 * std::numbers::pi * (k % 100) / 100)));
    InnerArc made = arc_of(path, 0, 0, 0);
    made.closed = true;
    return made;
  }

  geometry::Boundary square_;
  std::vector<geometry::CurveKind> kinds_;

private:
  const geometry::Lattice lattice_ = geometry::Frame(geometry::Box{{0, 0}, {1, 1}}).lattice();
};

/// Is the place a corner of the boundary?
bool is_corner(const geometry::Boundary& boundary, Vec2 p) {
  return std::ranges::any_of(boundary.loops, [&](const geometry::Loop& loop) {
    return std::ranges::any_of(loop.pieces, [&](const Piece& piece) { return piece.start == p && piece.corner; });
  });
}

TEST_F(JoinLines, ACurveBesideTheBoundaryBelongsToIt) {
  const std::optional<Partition> made = joined({arc_of({at(0.2, 0.06 * h), at(0.8, 0.1 * h)}, 0, 0, 0)});
  ASSERT_TRUE(made);
  EXPECT_TRUE(made->curves.arcs.empty());
  EXPECT_NEAR(made->joined.rim.length, 0.6, 1e-6);
  EXPECT_NEAR(made->joined.rim.farthest, 0.1 * h, 1e-12);
  EXPECT_EQ(made->boundary.loops[0].pieces.size(), 4U);
}

TEST_F(JoinLines, WhatIsLeftEndsOnTheBoundary) {
  const std::vector<Vec2> path{at(0.1, 0.3), at(0.2, 0.1 * h), at(0.7, 0.1 * h), at(0.8, 0.3)};
  const std::optional<Partition> made = joined({arc_of(path, 0, 0, 0)});
  ASSERT_TRUE(made);
  ASSERT_EQ(made->curves.arcs.size(), 2U);
  const InnerArc &before = made->curves.arcs[0], &behind = made->curves.arcs[1];
  EXPECT_EQ(before.pieces.front().start, path.front());
  EXPECT_EQ(behind.pieces.back().end, path.back());
  for (const Vec2 foot : {before.pieces.back().end, behind.pieces.front().start}) {
    EXPECT_EQ(foot.y, 0);
    EXPECT_TRUE(is_corner(made->boundary, foot));
  }
  EXPECT_LT(std::fabs(before.pieces.back().end.x - 0.2), h);
  EXPECT_EQ(made->boundary.loops[0].pieces.size(), 6U);
  EXPECT_TRUE(made->is_relabelled);
}

TEST_F(JoinLines, AnEndJustBeforeTheBoundaryComesToLieOnIt) {
  const std::optional<Partition> made = joined({arc_of({at(0.5, 0.4), at(0.5, 0.15 * h)}, 0, 0, 0)});
  ASSERT_TRUE(made);
  ASSERT_EQ(made->curves.arcs.size(), 1U);
  EXPECT_EQ(made->curves.arcs[0].pieces.back().end, at(0.5, 0));
  EXPECT_FALSE(joined({arc_of({at(0.5, 0.4), at(0.5, 0.25 * h)}, 0, 0, 0)}));
}

TEST_F(JoinLines, OnlyCurvesThatLeaveTheBoundaryAtASmallAngleAreCut) {
  square_.loops[0].pieces = pieces_of({{0, 0}, {0.5, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}}, 0);
  for (const double degrees : {5.0, 15.0, 30.0, 90.0}) {
    const double angle = degrees * std::numbers::pi / 180;
    const Vec2 middle = at(0.5 + 0.005 * std::cos(angle), 0.0051 * std::sin(angle)),
               end = at(0.5 + 0.4 * std::cos(angle), 0.4 * std::sin(angle));
    EXPECT_FALSE(joined({arc_of({at(0.5, 0), end}, 0, 0, 0)})) << degrees; // the angle is that of straight lines
    const std::optional<Partition> made = joined({arc_of({at(0.5, 0), middle, end}, 0, 0, 0)});
    ASSERT_EQ(made.has_value(), degrees < 20) << degrees;
    if (!made)
      continue;
    ASSERT_EQ(made->curves.arcs.size(), 1U);
    const Piece& last = made->curves.arcs[0].pieces.front();
    EXPECT_EQ(last.start.y, 0);
    EXPECT_GT(last.tangent(0).y, std::sin(1.0)); // about upright
  }
}

class JoinCurves : public JoinLines {
protected:
  /// A line of many short pieces. @param bend its height in the middle
  InnerArc line(double from, double to, double y, double bend, int part) const {
    std::vector<Vec2> path;
    for (int k = 0; k <= 200; ++k)
      path.push_back(at(from + (to - from) * k / 200, y + bend * std::sin(std::numbers::pi * k / 200)));
    return arc_of(path, part, 0, 0);
  }
};

TEST_F(JoinCurves, LinesOfManyPiecesBecomeOne) {
  const std::optional<Partition> made = joined({line(0.1, 0.9, 0.5, 0, 0), line(0.1, 0.9, 0.5 + 0.15 * h, 0, 1)});
  ASSERT_TRUE(made);
  ASSERT_EQ(made->curves.arcs.size(), 1U); // the first one
  EXPECT_EQ(made->curves.arcs[0].pieces.size(), 200U);
  EXPECT_NEAR(made->joined.lines.length, 0.8, 1e-6);
  EXPECT_NEAR(made->joined.lines.farthest, 0.15 * h, 1e-9);
  EXPECT_EQ(made->joined.rim.length, 0);
  EXPECT_FALSE(made->is_relabelled);
}

TEST_F(JoinCurves, ALineThatComesNearForAWhileMeetsTheOtherOneUpright) {
  const std::optional<Partition> made = joined({line(0.1, 0.9, 0.5, 0, 0), line(0.1, 0.9, 0.6, -0.1 + 0.1 * h, 1)});
  ASSERT_TRUE(made);
  ASSERT_EQ(made->curves.arcs.size(), 5U); // three parts of the first one, two of the other one
  for (const std::size_t k : {3U, 4U}) {
    const InnerArc& arc = made->curves.arcs[k];
    const Piece& last = k == 3 ? arc.pieces.back() : arc.pieces.front();
    EXPECT_NEAR(k == 3 ? last.end.y : last.start.y, 0.5, 1e-12);
    EXPECT_NEAR(last.length(), 0.4 * h, 0.1 * h);
    EXPECT_GT(std::fabs(last.tangent(0).y), 0.7);
  }
  EXPECT_EQ(made->curves.arcs[0].pieces.back().end, made->curves.arcs[3].pieces.back().end);
  EXPECT_EQ(made->curves.arcs[2].pieces.front().start, made->curves.arcs[4].pieces.front().start);
}

TEST_F(JoinCurves, EndsNextToCurvesAndSplitCurvesStay) {
  EXPECT_FALSE(joined({line(0.1, 0.9, 0.5, 0, 0), arc_of({at(0.5, 0.8), at(0.5, 0.5 + 0.1 * h)}, 1, 0, 0)}));
  kinds_ = {{.split = true}, {}};
  EXPECT_FALSE(joined({line(0.1, 0.9, 0.5, 0, 0), line(0.1, 0.9, 0.5 + 0.1 * h, 0, 1)}));
}

TEST_F(JoinCurves, EachOfABundleFollowsOneThatStays) {
  std::vector<InnerArc> bundle;
  for (int k = 0; k < 4; ++k)
    bundle.push_back(line(0.1, 0.9, 0.5 + 0.15 * h * k, 0, k % 2));
  const std::optional<Partition> made = joined(bundle);
  ASSERT_TRUE(made);
  ASSERT_EQ(made->curves.arcs.size(), 2U); // 0.3 h apart
  EXPECT_NEAR(made->curves.arcs[1].pieces.front().start.y, 0.5 + 0.3 * h, 1e-12);
}

TEST_F(JoinLines, CurvesFartherAwayAndThoseThatMustStayStay) {
  const InnerArc line = arc_of({at(0.1, 0.1 * h), at(0.5, 0.1 * h), at(0.9, 0.1 * h)}, 0, 0, 0);
  EXPECT_FALSE(joined({arc_of({at(0.1, 0.3 * h), at(0.9, 0.3 * h)}, 0, 0, 0)}));
  EXPECT_FALSE(joined({arc_of({at(0.1, 0.1 * h), at(0.9, 0.1 * h)}, 0, 0, 1)})); // between two regions
  const std::vector<Vec2> kept{at(0.5, 0.1 * h)};
  EXPECT_FALSE(joined({line}, kept));
  EXPECT_TRUE(joined({line}));
  kinds_ = {{.split = true}};
  EXPECT_FALSE(joined({line}));
  kinds_ = {{.weir_height = 2}};
  EXPECT_FALSE(joined({line}));
}

TEST_F(JoinLines, ANodeOfSeveralCurvesStays) {
  const Vec2 node = at(0.5, 0.1 * h);
  EXPECT_FALSE(joined({arc_of({at(0.3, 0.3), node}, 0, 0, 0), arc_of({node, at(0.7, 0.3)}, 0, 0, 0),
                       arc_of({node, at(0.5, 0.4)}, 1, 0, 0)}));
}

TEST_F(JoinLines, NothingIsCutThatAnotherCurveLiesBefore) {
  const InnerArc line = arc_of({at(0.1, 0.3), at(0.2, 0.18 * h), at(0.8, 0.18 * h), at(0.9, 0.3)}, 0, 0, 0);
  const InnerArc wall = arc_of({at(0.01, 0.05 * h), at(0.99, 0.05 * h)}, 1, 0, 0);
  kinds_ = {{}, {.split = true}}; // which stays
  EXPECT_FALSE(joined({line, wall}));
  kinds_ = {};
  const std::optional<Partition> made = joined({line, wall}); // first the wall, then the line
  ASSERT_TRUE(made);
  EXPECT_EQ(made->curves.arcs.size(), 2U);
}

TEST_F(JoinLines, RingsAroundACircle) {
  add_hole();
  const std::optional<Partition> all = joined({ring(0.2 + 0.1 * h, 0)});
  ASSERT_TRUE(all);
  EXPECT_TRUE(all->curves.arcs.empty());
  const std::optional<Partition> made = joined({ring(0.24, 0.039)}); // 0.001 from the circle on the left
  ASSERT_TRUE(made);
  ASSERT_EQ(made->curves.arcs.size(), 1U);
  const InnerArc& rest = made->curves.arcs[0];
  EXPECT_FALSE(rest.closed);
  for (const Vec2 foot : {rest.pieces.front().start, rest.pieces.back().end}) {
    EXPECT_NEAR(length(foot - Vec2{0.5, 0.5}), 0.2, 1e-9);
    EXPECT_TRUE(is_corner(made->boundary, foot));
  }
  for (std::size_t k = 1; k < rest.pieces.size(); ++k)
    EXPECT_EQ(rest.pieces[k - 1].end, rest.pieces[k].start);
}

class JoinInterfaces : public JoinCurves {
protected:
  /// A circle between region 1 inside and region 0 around it, without a name.
  InnerArc circle() const {
    InnerArc made;
    made.pieces = {{.start = at(0.7, 0.5), .end = at(0.7, 0.5), .center = {0.5, 0.5}, .radius = 0.2}};
    made.pieces[0].sweep = 2 * std::numbers::pi;
    made.pieces[0].circular = true;
    made.pieces[0].part = -1;
    made.left = 1;
    made.right = 0;
    made.closed = true;
    return made;
  }
  /// A curve in region 1, 0.1 h below the interface.
  InnerArc below(double from, double to) const {
    InnerArc made = line(from, to, 0.5 - 0.1 * h, 0, 0);
    made.left = made.right = 1;
    return made;
  }
  /// Region 1 lies below.
  InnerArc interface() const { return arc_of({at(0.05, 0.5), at(0.95, 0.5)}, -1, 0, 1); }
};

TEST_F(JoinInterfaces, AnInterfaceHasTheNameOfACurveWhereItFollows) {
  for (const bool is_backward : {false, true}) {
    std::vector<Vec2> path{at(0.2, 0.9), at(0.3, 0.5 + 0.1 * h), at(0.6, 0.5 + 0.1 * h), at(0.7, 0.9)};
    if (is_backward)
      std::ranges::reverse(path);
    const std::optional<Partition> made = joined({arc_of(path, 1, 0, 0), interface()});
    ASSERT_TRUE(made);
    ASSERT_EQ(made->curves.arcs.size(), 5U); // two rests of the curve, three parts of the interface
    const std::vector<InnerArc>& arcs = made->curves.arcs;
    for (const std::size_t k : {2U, 4U}) {
      EXPECT_EQ(arcs[k].pieces.front().part, -1);
      EXPECT_EQ(arcs[k].right, 1);
    }
    const InnerArc& named = arcs[3];
    EXPECT_EQ(named.pieces.front().part, 1);
    EXPECT_EQ(named.left, is_backward ? 1 : 0); // it leads where the curve led
    EXPECT_EQ(named.right, is_backward ? 0 : 1);
    EXPECT_EQ(named.pieces.front().start, arcs[0].pieces.back().end);
    EXPECT_EQ(named.pieces.back().end, arcs[1].pieces.front().start);
    EXPECT_NEAR(std::fabs(named.pieces.back().end.x - named.pieces.front().start.x), 0.3, h);
    EXPECT_GT(made->joined.interfaces.length, 0.29);
    EXPECT_EQ(made->joined.lines.length + made->joined.rim.length, 0);
  }
}

TEST_F(JoinInterfaces, ACurveThatEndsBesideAnInterfaceNamesItUpToThere) {
  InnerArc curve = below(0.3, 0.6);
  const std::optional<Partition> made = joined({interface(), curve});
  ASSERT_TRUE(made);
  ASSERT_EQ(made->curves.arcs.size(), 3U);
  const Piece& named = made->curves.arcs[1].pieces.front();
  EXPECT_EQ(named.part, 0);
  EXPECT_NEAR(named.start.x, 0.3, 1e-12);
  EXPECT_NEAR(named.end.x, 0.6, 1e-12);
  curve.left = curve.right = 2; // not next to the interface
  EXPECT_FALSE(joined({interface(), curve}));
}

TEST_F(JoinInterfaces, ARingAroundACircleNamesIt) {
  const std::optional<Partition> made = joined({ring(0.2 + 0.1 * h, 0), circle()});
  ASSERT_TRUE(made);
  ASSERT_EQ(made->curves.arcs.size(), 1U);
  const InnerArc& named = made->curves.arcs[0];
  EXPECT_TRUE(named.closed && named.pieces.size() == 1 && named.pieces[0].circular);
  EXPECT_EQ(named.pieces[0].part, 0);
  EXPECT_EQ(named.left, 1);
  EXPECT_EQ(named.lost_area, 0);
}

TEST_F(JoinInterfaces, ACurveOverTheStartOfACircleNamesOnePartOfIt) {
  InnerArc arc = ring(0.2 - 0.1 * h, 0); // from an angle of -90 to one of 90 degrees
  arc.closed = false;
  arc.left = arc.right = 1;
  std::rotate(arc.pieces.begin(), arc.pieces.begin() + 75, arc.pieces.end());
  arc.pieces.resize(50);
  const std::optional<Partition> made = joined({arc, circle()});
  ASSERT_TRUE(made);
  ASSERT_EQ(made->curves.arcs.size(), 2U);
  double sweep = 0;
  for (const InnerArc& part : made->curves.arcs) {
    const bool is_named = part.pieces.front().part == 0;
    double its = 0;
    for (const Piece& piece : part.pieces) {
      EXPECT_TRUE(piece.circular);
      EXPECT_EQ(piece.part, part.pieces.front().part);
      its += piece.sweep;
    }
    EXPECT_NEAR(its, std::numbers::pi, 1e-9);
    EXPECT_EQ(part.pieces.front().start.y < 0.5, is_named);
    sweep += its;
  }
  EXPECT_NEAR(sweep, 2 * std::numbers::pi, 1e-12);
}

TEST_F(JoinInterfaces, AShortChordOfACircleBelongsToIt) {
  std::vector<InnerArc> arcs{arc_of({at(0.7, 0.5), {}}, 0, 1, 1), circle()};
  for (const double degrees : {5.0, 15.0}) {
    const double angle = degrees * std::numbers::pi / 180;
    const Vec2 end = at(0.5 + 0.2 * std::cos(angle), 0.5 + 0.2 * std::sin(angle));
    arcs[0].pieces[0].end = end;
    arcs.resize(2);
    arcs[1] = circle();
    arcs.push_back(arcs[1]);
    for (InnerArc* part : {&arcs[1], &arcs[2]})
      part->closed = false;
    const std::array<Piece, 2> parts = geometry::divided(circle().pieces[0], end);
    arcs[1].pieces = {parts[0]};
    arcs[2].pieces = {parts[1]};
    const std::optional<Partition> made = joined(arcs);
    ASSERT_TRUE(made) << degrees;
    ASSERT_EQ(made->curves.arcs.size(), 2U) << degrees;
    EXPECT_EQ(made->curves.arcs[0].pieces.front().part, 0);
    EXPECT_EQ(made->curves.arcs[1].pieces.front().part, -1);
  }
}

TEST_F(JoinInterfaces, ACurveThatLeavesACircleNamesOnlyThePartThatItFollows) {
  for (int turn = 0; turn < 36; ++turn) { // the start of the circle may lie on either side of its nearest place
    const double begin = turn * std::numbers::pi / 18 + 0.01;
    const auto on = [&](double radius, double angle) {
      return at(0.5 + radius * std::cos(begin + angle), 0.5 + radius * std::sin(begin + angle));
    };
    InnerArc whole = circle();
    whole.closed = false;
    whole.pieces[0].start = whole.pieces[0].end = on(0.2, 0);
    whole.pieces[0].start_angle = begin;
    std::vector<Vec2> path;
    for (int k = 0; k <= 20; ++k)
      path.push_back(on(0.2 + 0.005 * h * k, 0.0125 * k));
    path.push_back(on(0.4, 0.6));
    const std::optional<Partition> made = joined({arc_of(path, 0, 0, 0), whole});
    ASSERT_TRUE(made);
    double named = 0;
    for (const InnerArc& arc : made->curves.arcs)
      for (const Piece& piece : arc.pieces)
        named += piece.circular && piece.part == 0 ? piece.length() : 0;
    EXPECT_NEAR(named, 0.2 * 0.25, h) << turn;
  }
}

TEST_F(JoinInterfaces, OfCurvesOnBothSidesTheFirstOneCounts) {
  const std::optional<Partition> made = joined({below(0.2, 0.8), line(0.1, 0.9, 0.5 + 0.1 * h, 0, 1), interface()});
  ASSERT_TRUE(made);
  std::vector<int> names;
  for (const InnerArc& arc : made->curves.arcs) {
    EXPECT_NE(arc.left, arc.right);
    names.push_back(arc.pieces.front().part);
  }
  EXPECT_EQ(names, (std::vector{-1, 1, 0, 1, -1}));
}

TEST_F(JoinInterfaces, FreeEndsStayAndTheInterfaceLeadsThroughThem) {
  const InnerArc curve = below(0.3, 0.6);
  const std::optional<Partition> made = joined({interface(), curve});
  ASSERT_TRUE(made);
  ASSERT_EQ(made->curves.arcs.size(), 3U);
  double lost = 0;
  for (const InnerArc& arc : made->curves.arcs)
    lost += arc.lost_area;
  EXPECT_EQ(made->curves.arcs[1].pieces.front().start, curve.pieces.front().start);
  EXPECT_EQ(made->curves.arcs[1].pieces.back().end, curve.pieces.back().end);
  EXPECT_NEAR(lost, -0.1 * h * 0.5 * (0.9 + 0.3), 1e-12); // region 0, on the left, has gained a trapezium
  const InnerArc wall = arc_of({at(0.4, 0.5 - 0.05 * h), at(0.42, 0.5 - 0.05 * h)}, 1, 1, 1);
  kinds_ = {{}, {.split = true}}; // which stays where the interface would move
  const std::optional<Partition> blocked = joined({interface(), wall, curve});
  EXPECT_FALSE(blocked);
}

} // namespace
} // namespace trime::generalise
