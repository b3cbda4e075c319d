// SPDX-License-Identifier: BSD-3-Clause
// What became of each loop of a boundary, told from the curves before and after.
#include "boundary/loop_fates.hpp"

#include "boundary/feature_report.hpp"
#include "boundary/feature_rule.hpp"
#include "support/boundary_shapes.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace trime::boundary {
namespace {

using geometry::Boundary;
using geometry::Loop;
using geometry::Vec2;
using sizing::UniformSize;
using testing::boundary_of;
using testing::circle_loop;
using testing::polygon_loop;
using testing::unit_lattice;
using State = LoopFate::State;

constexpr double h = 0.05;

std::vector<LoopFate> fates_of(const Boundary& given, const Boundary& meshed) {
  return find_loop_fates(given, meshed, UniformSize(h), unit_lattice());
}

Loop box(double x_min, double y_min, double x_max, double y_max, int tag, bool hole = false) {
  std::vector<Vec2> points{{x_min, y_min}, {x_max, y_min}, {x_max, y_max}, {x_min, y_max}};
  if (hole)
    std::reverse(points.begin(), points.end());
  return polygon_loop(points, tag);
}

TEST(LoopFates, LoopsThatStayAreKeptBitForBit) {
  const Boundary given = boundary_of({box(0.1, 0.1, 0.9, 0.9, 1), circle_loop({0.5, 0.5}, 0.1, true, 4, 2)});
  Boundary meshed = given;
  std::vector<geometry::Piece>& pieces = meshed.loops[1].pieces;
  std::rotate(pieces.begin(), pieces.begin() + 1, pieces.end());
  for (const LoopFate& fate : fates_of(given, meshed)) {
    EXPECT_EQ(fate.state, State::kept);
    EXPECT_EQ(fate.tags.size(), 1u);
    EXPECT_EQ(fate.remaining_length, fate.length);
    EXPECT_EQ(fate.largest_deviation, 0);
  }
  EXPECT_NEAR(fates_of(given, meshed)[0].area, 0.64, 1e-12);
  EXPECT_NEAR(fates_of(given, meshed)[1].area, pi * 0.01, 1e-9);
}

TEST(LoopFates, ACutSpitIsASimplifiedLoopThatIsShorter) {
  // A spit of 0.2 on top of a box, 0.01 wide; its foot becomes a side.
  const Boundary given = boundary_of({polygon_loop(
      {{0.2, 0.2}, {0.6, 0.2}, {0.6, 0.6}, {0.405, 0.6}, {0.405, 0.8}, {0.395, 0.8}, {0.395, 0.6}, {0.2, 0.6}})});
  const Boundary meshed =
      boundary_of({polygon_loop({{0.2, 0.2}, {0.6, 0.2}, {0.6, 0.6}, {0.405, 0.6}, {0.395, 0.6}, {0.2, 0.6}})});
  const LoopFate fate = fates_of(given, meshed).at(0);
  EXPECT_EQ(fate.state, State::simplified);
  EXPECT_NEAR(fate.length, 2, 1e-9);
  EXPECT_NEAR(fate.remaining_length, 1.6, 1e-9);
  EXPECT_NEAR(fate.largest_deviation, 0.005 / h, 1e-9); // the middle of the foot
}

TEST(LoopFates, DeviationIsThatOfMovedVerticesToo) {
  const Boundary given = boundary_of({box(0.2, 0.2, 0.6, 0.6, 1)});
  const Boundary meshed = boundary_of({polygon_loop({{0.2, 0.2}, {0.6, 0.2}, {0.61, 0.61}, {0.2, 0.6}})});
  const LoopFate fate = fates_of(given, meshed).at(0);
  EXPECT_EQ(fate.state, State::simplified);
  EXPECT_NEAR(fate.largest_deviation, std::sqrt(2.0) * 0.01 / h, 1e-9);
}

TEST(LoopFates, TwoLoopsInOneAreMerged) {
  const Boundary given = boundary_of({box(0.1, 0.1, 0.4, 0.4, 1), box(0.41, 0.1, 0.7, 0.4, 2)});
  const Boundary meshed = boundary_of({polygon_loop(
      {{0.1, 0.1}, {0.4, 0.1}, {0.41, 0.1}, {0.7, 0.1}, {0.7, 0.4}, {0.41, 0.4}, {0.4, 0.4}, {0.1, 0.4}}, 2)});
  for (const LoopFate& fate : fates_of(given, meshed)) {
    EXPECT_EQ(fate.state, State::merged);
    EXPECT_EQ(fate.tags, std::vector<std::int32_t>{2});
    EXPECT_TRUE(fate.is_lost());
  }
}

TEST(LoopFates, OneLoopInTwoIsSplit) {
  const Boundary given = boundary_of({polygon_loop({{0.1, 0.1},
                                                    {0.4, 0.1},
                                                    {0.5, 0.2},
                                                    {0.6, 0.1},
                                                    {0.9, 0.1},
                                                    {0.9, 0.4},
                                                    {0.6, 0.4},
                                                    {0.5, 0.21},
                                                    {0.4, 0.4},
                                                    {0.1, 0.4}})});
  const Boundary meshed = boundary_of({polygon_loop({{0.1, 0.1}, {0.4, 0.1}, {0.4, 0.4}, {0.1, 0.4}}, 1),
                                       polygon_loop({{0.6, 0.1}, {0.9, 0.1}, {0.9, 0.4}, {0.6, 0.4}}, 2)});
  const LoopFate fate = fates_of(given, meshed).at(0);
  EXPECT_EQ(fate.state, State::split);
  EXPECT_EQ(fate.tags.size(), 2u);
  EXPECT_FALSE(fate.is_lost());
}

TEST(LoopFates, LoopsThatAreGoneAreToldByWhatIsInTheirPlace) {
  const Boundary given = boundary_of({box(0.1, 0.1, 0.6, 0.6, 1), box(0.3, 0.3, 0.31, 0.31, 2, true),
                                      box(0.8, 0.8, 0.81, 0.81, 3), box(0.601, 0.3, 0.602, 0.301, 4)});
  // The small island beside the large one is swallowed.
  Boundary meshed = boundary_of({polygon_loop({{0.1, 0.1}, {0.6, 0.1}, {0.61, 0.3}, {0.6, 0.6}, {0.1, 0.6}})});
  const std::vector<LoopFate> fates = fates_of(given, meshed);
  EXPECT_EQ(fates[0].state, State::simplified);
  EXPECT_EQ(fates[1].state, State::filled);
  EXPECT_EQ(fates[2].state, State::dropped);
  EXPECT_EQ(fates[3].state, State::merged);
  for (std::size_t k = 1; k < 4; ++k) {
    EXPECT_TRUE(fates[k].tags.empty());
    EXPECT_EQ(fates[k].remaining_length, 0);
  }
}

TEST(LossWarning, CountsLoopsAndArea) {
  const Boundary given =
      boundary_of({box(0.1, 0.1, 0.6, 0.6, 1), box(0.3, 0.3, 0.31, 0.31, 2, true), box(0.8, 0.8, 0.82, 0.82, 3)});
  const auto report_of = [&](const polygon::Simplification& simplified, double least) {
    FeatureReport report;
    const polygon::DroppedLoops dropped = drop_small_loops(given, UniformSize(h), least);
    report_losses(given, dropped.any() ? boundary_without(given, dropped) : given, simplified, dropped, UniformSize(h),
                  unit_lattice(), report);
    return report;
  };
  const FeatureReport nothing = report_of({}, 0), two = report_of({}, 3);
  EXPECT_EQ(loss_warning(nothing).text(), "");
  EXPECT_EQ(nothing.lost_share + nothing.added_share, 0);
  EXPECT_NEAR(two.lost_share, 0.0004 / given.area, 1e-12);
  EXPECT_NEAR(two.added_share, 0.0001 / given.area, 1e-12);
  const std::string warning = loss_warning(two).text();
  for (const char* words :
       {"2 components became 1 and 1 hole became 0: 1 loop was dropped, 1 hole was filled, the longest 1.6 h around at "
        "(0.8, 0.8). The shape is simplified at this size: 0.16 % of its area is lost, 0.04 % is added",
        "2 of 3 loops are lost (1 dropped, 1 hole filled)", "keep_features", "edge_length"})
    EXPECT_NE(warning.find(words), std::string::npos) << warning;
}

TEST(LossWarning, WhatIsLeftOutOnPurposeIsNotLost) {
  const Boundary given = boundary_of({box(0.1, 0.1, 0.6, 0.6, 1), box(0.7, 0.7, 0.9, 0.9, 2)});
  polygon::DroppedLoops dropped = drop_small_loops(given, UniformSize(h), 3);
  drop_other_components(given, {0, 3, Components::largest}, dropped);
  FeatureReport report;
  report_losses(given, boundary_without(given, dropped), {}, dropped, UniformSize(h), unit_lattice(), report);
  EXPECT_EQ(report.loops.at(0).state, LoopFate::State::kept);
  EXPECT_EQ(report.loops.at(1).state, LoopFate::State::left_out);
  EXPECT_TRUE(report.loops.at(1).tags.empty());
  const std::string warning = loss_warning(report).text();
  EXPECT_TRUE(warning.starts_with("2 components became 1: 1 component was left out as meshing.components asks for"))
      << warning;
  for (const char* words : {"dropped", "More points", "keep_features"})
    EXPECT_EQ(warning.find(words), std::string::npos) << warning;
}

TEST(LossWarning, CountsPiecesEvenIfNoLoopIsLost) {
  const Boundary given = boundary_of({box(0.1, 0.1, 0.6, 0.6, 1)});
  const Boundary meshed = boundary_of({box(0.1, 0.1, 0.34999, 0.6, 1), box(0.35001, 0.1, 0.6, 0.6, 2)});
  FeatureReport report;
  report_losses(given, meshed, {}, {}, UniformSize(h), unit_lattice(), report);
  const std::string warning = loss_warning(report).text();
  EXPECT_TRUE(warning.starts_with("1 component became 2: 1 loop was split. The shape is simplified")) << warning;
  EXPECT_NE(warning.find("0.004 % of its area is lost"), std::string::npos) << warning;
  EXPECT_NE(warning.find("simplify_within"), std::string::npos) << warning;
}

TEST(LossWarning, BeginsWithTheNecksThatWereCut) {
  const Boundary given = boundary_of({box(0.1, 0.1, 0.6, 0.6, 1)});
  const Boundary meshed = boundary_of({box(0.1, 0.1, 0.34999, 0.6, 1), box(0.35001, 0.1, 0.6, 0.6, 2)});
  polygon::Simplification simplified;
  simplified.severed = 1;
  simplified.widest_severed = 0.31;
  simplified.severed_place = {0.35, 0.25};
  FeatureReport report;
  report_losses(given, meshed, simplified, {}, UniformSize(h), unit_lattice(), report);
  const std::string warning = loss_warning(report).text();
  EXPECT_TRUE(warning.starts_with("1 component became 2: 1 neck was cut, the widest 0.31 h at (0.35, 0.25); "
                                  "meshing.connect = keep keeps it"))
      << warning;
}

} // namespace
} // namespace trime::boundary
