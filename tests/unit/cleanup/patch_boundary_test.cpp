// SPDX-License-Identifier: BSD-3-Clause
// What the optimizer makes of patches on the boundary.
#include "geometry/predicates.hpp"
#include "support/patch_stage.hpp"
#include "trime/mesh/quality.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace trime::cleanup {
namespace {

using geometry::Boundary;
using geometry::Vec2;
using polygon::BoundaryEdit;
using polygon::BoundaryGuard;
using polygon::BoundarySite;
using polygon::BoundarySites;
using testing::boundary_of;
using testing::circle_loop;
using testing::polygon_loop;
using testing::unit_lattice;
using namespace testing_patch;

const Vec2 middle{0.5, 0.5};

/// The lower half of the container is outside: rows of the lattice from y = 0.5 on.
Boundary half_plane() {
  return boundary_of({polygon_loop({{0.03125, 0.5}, {0.96875, 0.5}, {0.96875, 0.96875}, {0.03125, 0.96875}})});
}
void add_upper_lattice(Stage& stage) {
  for (int j = 1; j <= 8; ++j)
    for (int i = -9; i <= 9; ++i)
      stage.add(middle + h * Vec2{i + 0.5 * (j & 1), std::sqrt(0.75) * j});
}

TEST(PatchOptimizer, KnowsAPerfectStraightBoundary) {
  Stage stage(half_plane());
  stage.add_boundary();
  add_upper_lattice(stage);
  EXPECT_LT(worst_alpha(stage, {}, middle, 3 * h), 1.001);
  EXPECT_TRUE(stage.improve(middle).empty());
}

TEST(PatchOptimizer, ASiteOfAStraightBoundarySlidesBack) {
  for (const double away : {0.25, -0.35}) {
    Stage stage(half_plane());
    stage.options.bad_alpha = 1.02; // or it would be content with less
    const Vec2 displaced = unit_lattice().snap(middle + Vec2{away * h, 0});
    std::vector<BoundaryEdit> slide;
    for (LocalIndex k = 0; k < static_cast<LocalIndex>(stage.sites_on.sites.size()); ++k)
      if (const BoundarySite& site = stage.sites_on.sites[static_cast<std::size_t>(k)];
          geometry::length(site.position - middle) < 1e-12)
        slide.push_back({k, Kind::move, stage.curve.arc(0, site) + (displaced.x - middle.x), displaced});
    ASSERT_EQ(slide.size(), 1u);
    stage.add_boundary_with(slide);
    add_upper_lattice(stage);
    const std::vector<SiteEdit> edits = stage.improve(displaced);
    EXPECT_GE(count(edits, Kind::move, true), 1);
    EXPECT_LT(worst_alpha(stage, edits, middle, 2 * h), 1.02);
    for (const SiteEdit& edit : edits)
      if (edit.boundary >= 0) {
        EXPECT_EQ(edit.to.y, 0.5);
      }
  }
}

/// One boundary site more, or less, than the lattice wants.
TEST(PatchOptimizer, SitesOfAStraightBoundaryComeAndGo) {
  for (const bool one_more : {true, false}) {
    Stage stage(half_plane());
    stage.options.bad_alpha = stage.options.operate_alpha = 1.02;
    std::vector<BoundaryEdit> change;
    Vec2 center = middle;
    for (LocalIndex k = 0; k < static_cast<LocalIndex>(stage.sites_on.sites.size()); ++k)
      if (geometry::length(stage.sites_on.sites[static_cast<std::size_t>(k)].position - middle) < 1e-12) {
        const double arc = stage.curve.arc(0, stage.sites_on.sites[static_cast<std::size_t>(k)]);
        const Vec2 extra = unit_lattice().snap(middle + Vec2{0.5 * h, 0});
        change.push_back(one_more ? BoundaryEdit{k, Kind::insert, arc + 0.5 * h, extra}
                                  : BoundaryEdit{k, Kind::remove, 0, {}});
        center = one_more ? extra : unit_lattice().snap(middle + Vec2{h, 0});
        break;
      }
    ASSERT_EQ(change.size(), 1u);
    stage.add_boundary_with(change);
    add_upper_lattice(stage);
    const double before = worst_alpha(stage, {}, middle, 3 * h);
    EXPECT_GT(before, 1.1);
    const std::vector<SiteEdit> edits = stage.improve(center);
    EXPECT_GE(count(edits, one_more ? Kind::remove : Kind::insert, true), 1);
    EXPECT_LT(worst_alpha(stage, edits, middle, 3 * h), 1.03);
  }
}

/// As near to each other as Cleanup chooses them: then no two of them change one site, or divide one chord.
TEST(PatchOptimizer, PatchesThatKeepApartShareNoChord) {
  Stage stage(half_plane());
  std::vector<BoundaryEdit> holes;
  for (std::size_t k = 0; k < stage.sites_on.sites.size(); k += 3)
    if (const Vec2 p = stage.sites_on.sites[k].position; p.y == 0.5 && std::fabs(p.x - 0.5) < 12.5 * h)
      holes.push_back({static_cast<LocalIndex>(k), Kind::remove, 0, {}});
  stage.add_boundary_with(holes);
  for (int j = 1; j <= 9; ++j)
    for (int i = -15; i <= 15; ++i)
      if (std::abs(i) <= 14 - (j & 1))
        stage.add(middle + h * Vec2{i + 0.5 * (j & 1), std::sqrt(0.75) * j});
  const double half = 0.5 * (2 * CleanupRules::reach - CleanupRules::free_depth) * h;
  std::vector<BoundaryName> left, right;
  for (const auto& [list, side] : {std::pair{&left, -half}, {&right, half}})
    for (const SiteEdit& edit : stage.improve(unit_lattice().snap(middle + Vec2{side, 0})))
      if (edit.boundary >= 0)
        list->push_back(edit.boundary);
  EXPECT_FALSE(left.empty());
  EXPECT_FALSE(right.empty());
  for (const BoundaryName site : left)
    EXPECT_EQ(std::count(right.begin(), right.end(), site), 0);
}

/// Where sites slide on circles and across the start of the loop.
TEST(PatchOptimizer, WorksAlongACircleAndAcrossTheStartOfItsLoop) {
  Stage stage(boundary_of({circle_loop({0.5, 0.5}, 0.3)}));
  stage.add_boundary();
  const auto rim = static_cast<double>(stage.sites_on.sites.size());
  for (int ring = 1; ring < 9; ++ring) { // rings of fewer and fewer sites: dislocations everywhere
    const double r = 0.3 - std::sqrt(0.75) * h * ring;
    const int n = static_cast<int>(rim * r / 0.3);
    for (int k = 0; k < n; ++k) {
      const SinCos turn = sin_cos(2 * pi * (k + 0.5 * (ring & 1)) / n);
      stage.add(Vec2{0.5, 0.5} + r * Vec2{turn.cos, turn.sin});
    }
  }
  int improved = 0, slid = 0;
  for (std::size_t k = 0; k < stage.sites_on.sites.size(); k += 2) {
    const Vec2 center = stage.sites_on.sites[k].position;
    const std::vector<SiteEdit> edits = stage.improve(center);
    improved += !edits.empty();
    for (const SiteEdit& edit : edits)
      slid += edit.boundary >= 0;
    EXPECT_LE(worst_alpha(stage, edits, center, h), worst_alpha(stage, {}, center, 6 * h) + 1e-12);
  }
  EXPECT_GT(improved, 10);
  EXPECT_GT(slid, 10);
}

/// What the edits make of the boundary.
BoundarySites edited_boundary(const Stage& stage, const std::vector<SiteEdit>& edits) {
  std::vector<BoundaryEdit> on_boundary;
  for (const SiteEdit& edit : edits)
    if (edit.boundary >= 0)
      on_boundary.push_back({static_cast<LocalIndex>(edit.boundary), edit.kind, edit.arc, edit.to});
  return stage.edited_boundary(on_boundary);
}

/// Two walls a little more than one disc apart: whatever is edited, the open disc of every chord stays empty.
TEST(PatchOptimizer, ChordsOfAThinGapKeepTheirDiscs) {
  for (const double gap : {0.55, 0.62, 0.8}) {
    Stage stage(boundary_of({polygon_loop({{0.0625, 0.25}, {0.9375, 0.25}, {0.9375, 0.5}, {0.0625, 0.5}}),
                             polygon_loop({{0.1, 0.5 + gap * h}, {0.9, 0.5 + gap * h}, {0.8, 0.75}, {0.2, 0.75}})}));
    stage.add_boundary();
    for (int j = 1; j < 8; ++j)
      for (int i = -10; i <= 10; ++i)
        stage.add(Vec2{0.5, 0.5} + h * Vec2{i + 0.3 * (j & 1), -0.85 * j});
    for (std::size_t k = 0; k < stage.sites_on.sites.size(); k += 2) {
      const Vec2 center = stage.sites_on.sites[k].position;
      const std::vector<SiteEdit> edits = stage.improve(center);
      const BoundarySites after = edited_boundary(stage, edits);
      const bool is_edited =
          count(edits, Kind::move, true) + count(edits, Kind::insert, true) + count(edits, Kind::remove, true) > 0;
      for (LocalIndex i = 0; i < static_cast<LocalIndex>(after.sites.size()) && is_edited; ++i)
        for (const BoundarySite& site : after.sites)
          ASSERT_GE(geometry::diametral_side(after.chord(i).a, after.chord(i).b, site.position), 0) << gap;
    }
  }
}

/// A notch with an angle of 105 degrees, where only smaller triangles are allowed. One of its chords stands for a
/// zigzag that strays from half of it by more than the tolerance.
TEST(PatchOptimizer, SmallerTrianglesFollowARaggedBoundary) {
  constexpr double edge = 0.8 * h, stray = 0.15;
  const SinCos half = sin_cos(0.5 * 105 * (pi / 180));
  const Vec2 apex = middle - Vec2{0, edge * half.cos}, left = middle - Vec2{edge * half.sin, 0},
             right = middle + Vec2{edge * half.sin, 0}, along = right - apex;
  const auto beside = [&](double share, double offset) {
    return apex + share * along + offset * geometry::left_normal(along);
  };
  Stage stage(boundary_of({polygon_loop({{0.03125, 0.5},
                                         left,
                                         apex,
                                         beside(0.5, stray),
                                         beside(0.75, -stray),
                                         right,
                                         {0.96875, 0.5},
                                         {0.96875, 0.96875},
                                         {0.03125, 0.96875}})}));
  std::vector<BoundaryEdit> zigzag;
  for (std::size_t k = 0; k < stage.sites_on.sites.size(); ++k)
    if (const Vec2 p = stage.sites_on.sites[k].position; p.x > middle.x + 1e-9 && p.y < 0.5 - 1e-9)
      zigzag.push_back({static_cast<LocalIndex>(k), Kind::remove, 0, {}});
  ASSERT_EQ(zigzag.size(), 2u);
  stage.add_boundary_with(zigzag);
  for (PatchSite& site : stage.sites)
    site.on_boundary.tolerance = 1.1 * stray * edge;
  add_upper_lattice(stage);
  EXPECT_GT(worst_alpha(stage, {}, middle, 3 * h), 1.5);
  stage.budget.may_insert = stage.budget.may_delete = 0;
  const std::vector<SiteEdit> edits = stage.improve(unit_lattice().snap(apex));
  stage.guard = BoundaryGuard(edited_boundary(stage, edits), unit_lattice());
  EXPECT_LT(worst_alpha(stage, edits, middle, 3 * h), 1.4); // the bar of contours_test.py
}

} // namespace
} // namespace trime::cleanup
