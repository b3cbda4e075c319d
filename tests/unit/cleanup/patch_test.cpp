// SPDX-License-Identifier: BSD-3-Clause
// What the optimizer makes of patches whose remedy is known.
#include "support/laid_sites.hpp"
#include "support/patch_stage.hpp"
#include "support/periodic_shapes.hpp"
#include "support/point_sets.hpp"
#include "trime/mesh/quality.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace trime::cleanup {
namespace {

using geometry::Boundary;
using geometry::Vec2;
using polygon::BoundaryCurve;
using polygon::BoundarySites;
using sizing::UniformSize;
using testing::boundary_of;
using testing::make_boundary_sites;
using testing::polygon_loop;
using testing::unit_lattice;
using namespace testing_patch;

const Vec2 middle{0.5, 0.5};

Boundary far_square() {
  return boundary_of({polygon_loop({{0.05, 0.05}, {0.95, 0.05}, {0.95, 0.95}, {0.05, 0.95}})});
}

/// A hexagonal lattice about the middle, rows along x.
void add_lattice(Stage& stage, int rings = 9, Vec2 about = middle) {
  for (int j = -rings; j <= rings; ++j)
    for (int i = -rings; i <= rings; ++i)
      stage.add(about + h * Vec2{i + 0.5 * (j & 1), std::sqrt(0.75) * j});
}

/// The same with the site in the middle elsewhere. @return where
Vec2 add_displaced_lattice(Stage& stage) {
  add_lattice(stage);
  stage.take_nearest(middle);
  const Vec2 displaced = unit_lattice().snap(middle + h * Vec2{0.3, 0.1});
  stage.add(displaced);
  return displaced;
}

TEST(PatchOptimizer, LeavesAPerfectLatticeAlone) {
  Stage stage(far_square());
  add_lattice(stage);
  EXPECT_TRUE(stage.improve(middle).empty());
}

TEST(PatchOptimizer, BringsADisplacedSiteBack) {
  for (const Vec2 away : {Vec2{0.3, 0.1}, {-0.2, 0.25}, {0, -0.4}}) {
    Stage stage(far_square());
    stage.options.bad_alpha = 1.02; // or it would be content with less
    add_lattice(stage);
    stage.take_nearest(middle);
    const Vec2 displaced = unit_lattice().snap(middle + h * away);
    stage.add(displaced);
    EXPECT_GT(worst_alpha(stage, {}, middle, 3 * h), 1.07);
    const std::vector<SiteEdit> edits = stage.improve(displaced);
    EXPECT_LT(worst_alpha(stage, edits, middle, 3 * h), 1.02);
    EXPECT_EQ(count(edits, Kind::insert) + count(edits, Kind::remove), 0);
    const auto back =
        std::find_if(edits.begin(), edits.end(), [&](const SiteEdit& edit) { return edit.from == displaced; });
    ASSERT_NE(back, edits.end());
    EXPECT_LT(geometry::length(back->to - middle), 0.8 * h * geometry::length(away)); // it does not move alone
  }
}

/// Another patch may begin 2 reach - free_depth away: it may read what this one changes otherwise.
TEST(PatchOptimizer, ChangesNothingNearTheRimHoweverSmallTheTrianglesThere) {
  Stage stage(far_square());
  const Vec2 displaced = add_displaced_lattice(stage);
  for (PatchSite& site : stage.sites)
    if (geometry::length(site.position - middle) > 2 * h)
      site.size = 0.05 * h;
  const std::vector<SiteEdit> edits = stage.improve(displaced);
  EXPECT_FALSE(edits.empty());
  for (const SiteEdit& edit : edits)
    EXPECT_LT(geometry::length(edit.from - displaced), (CleanupRules::reach - CleanupRules::free_depth) * h);
}

/// Obtuse triangles among the sites, after edits.
int obtuse_triangles(const Stage& stage, const std::vector<SiteEdit>& edits) {
  PatchMesh mesh(unit_lattice(), {});
  mesh.start(middle, 4);
  for (const PatchSite& site : stage.sites)
    if (std::none_of(edits.begin(), edits.end(),
                     [&](const SiteEdit& edit) { return edit.kind != Kind::insert && edit.from == site.position; }))
      mesh.insert(site.position);
  for (const SiteEdit& edit : edits)
    if (edit.kind != Kind::remove)
      mesh.insert(edit.to);
  int count = 0;
  for (const PatchMesh::Triangle& triangle : mesh.triangles()) {
    const auto& [a, b, c] = triangle.vertex;
    if (std::min(a, std::min(b, c)) < PatchMesh::frame)
      continue;
    const Vec2 p = mesh.position(a), q = mesh.position(b), r = mesh.position(c);
    count += geometry::length((1.0 / 3) * (p + q + r) - middle) < 5 * h && mesh::is_obtuse(p, q, r);
  }
  return count;
}

TEST(PatchOptimizer, RemovesObtuseTriangles) {
  for (const double weight : CleanupRules::obtuse_weight)
    for (const Vec2 away : {Vec2{0.45, 0.1}, {-0.3, 0.4}, {0, -0.5}}) {
      Stage stage(far_square());
      stage.budget.is_again = true;
      stage.budget.obtuse_weight = weight;
      stage.budget.is_last = weight == CleanupRules::obtuse_weight.back();
      add_lattice(stage);
      stage.take_nearest(middle);
      const Vec2 displaced = unit_lattice().snap(middle + h * away);
      stage.add(displaced);
      EXPECT_GT(obtuse_triangles(stage, {}), 0);
      EXPECT_EQ(obtuse_triangles(stage, stage.improve(displaced)), 0);
    }
}

TEST(PatchOptimizer, LeavesBadTrianglesAloneInTheStagesAgainstObtuseOnes) {
  Stage stage(far_square());
  const Vec2 displaced = add_displaced_lattice(stage);
  EXPECT_GT(worst_alpha(stage, {}, middle, 3 * h), CleanupRules::bad_alpha);
  EXPECT_EQ(obtuse_triangles(stage, {}), 0);
  EXPECT_FALSE(stage.improve(displaced).empty());
  stage.budget.is_again = true;
  stage.budget.obtuse_weight = CleanupRules::obtuse_weight.back();
  EXPECT_TRUE(stage.improve(displaced).empty());
}

TEST(PatchOptimizer, DeletesOneTooMany) {
  Stage stage(far_square());
  stage.options.bad_alpha = stage.options.operate_alpha = 1.02;
  add_lattice(stage);
  const Vec2 extra = unit_lattice().snap(middle + h * Vec2{0.5, 0.3});
  stage.add(extra);
  const std::vector<SiteEdit> edits = stage.improve(extra);
  EXPECT_EQ(count(edits, Kind::remove), 1);
  EXPECT_EQ(count(edits, Kind::insert), 0);
  EXPECT_LT(worst_alpha(stage, edits, middle, 3 * h), 1.01);
}

TEST(PatchOptimizer, InsertsOneThatIsMissing) {
  Stage stage(far_square());
  stage.options.bad_alpha = stage.options.operate_alpha = 1.02;
  add_lattice(stage);
  const Vec2 hole = stage.take_nearest(middle);
  Vec2 center{9, 9}; // the first of the hexagon around the hole
  for (const PatchSite& site : stage.sites)
    if (geometry::length(site.position - hole) < 1.1 * h && geometry::lexicographically_less(site.position, center))
      center = site.position;
  const std::vector<SiteEdit> edits = stage.improve(center);
  EXPECT_EQ(count(edits, Kind::insert), 1);
  EXPECT_EQ(count(edits, Kind::remove), 0);
  EXPECT_LT(worst_alpha(stage, edits, middle, 2 * h), 1.02);
}

/// Where nothing helped all three sites rest: nothing is tried until one of them moves.
TEST(PatchOptimizer, TrianglesWhoseSitesAllRestAreLeftAlone) {
  Stage stage(far_square());
  const Vec2 displaced = add_displaced_lattice(stage);
  EXPECT_FALSE(stage.improve(displaced).empty());
  for (PatchSite& site : stage.sites)
    site.rests = 1;
  EXPECT_TRUE(stage.improve(displaced).empty());
  stage.sites.back().rests = 0; // the one in the middle of what is bad
  EXPECT_FALSE(stage.improve(displaced).empty());
}

/// In a patch that is tried again operations are for what is worse than elsewhere; sites move as before.
TEST(PatchOptimizer, APatchThatIsTriedAgainOperatesOnWhatIsWorseAlone) {
  Stage stage(far_square());
  stage.options.bad_alpha = stage.options.operate_alpha = 1.02;
  stage.options.first_alpha = 10; // no operations before the moves
  add_lattice(stage);
  const Vec2 extra = unit_lattice().snap(middle + h * Vec2{0.5, 0.3});
  stage.add(extra);
  const auto removed = [&](bool is_again, double again_alpha) {
    stage.budget.is_again = is_again;
    stage.budget.again_alpha = again_alpha;
    const std::vector<SiteEdit> edits = stage.improve(extra);
    EXPECT_FALSE(edits.empty());
    return count(edits, Kind::remove);
  };
  EXPECT_EQ(removed(false, 10), 1);
  EXPECT_EQ(removed(true, 1.02), 1);
  EXPECT_EQ(removed(true, 10), 0);
}

TEST(PatchOptimizer, FixedSitesStayWhereTheyAre) {
  for (const bool crowd : {false, true}) {
    Stage stage(far_square());
    add_lattice(stage);
    if (!crowd)
      stage.take_nearest(middle);
    const Vec2 fixed = unit_lattice().snap(middle + h * Vec2{0.35, 0.2});
    stage.add(fixed, mesh::fixed_site);
    const double before = worst_alpha(stage, {}, middle, 3 * h);
    const std::vector<SiteEdit> edits = stage.improve(fixed); // see expect_allowed
    EXPECT_FALSE(edits.empty());
    EXPECT_LT(worst_alpha(stage, edits, middle, 3 * h), before);
  }
}

/// A bad triangle at the rim, where nothing moves, is known already: no word of it.
TEST(PatchOptimizer, WhatStaysAsItIsMakesNoNews) {
  const shape::RegionShape torus = testing::whole_torus();
  const BoundaryCurve curve(torus.boundary());
  const BoundarySites none = make_boundary_sites(torus.boundary(), UniformSize(h), unit_lattice(), 30);
  const auto improve = [&](double displaced_at) {
    std::vector<PatchSite> sites;
    for (int j = -12; j <= 12; ++j)
      for (int i = -16; i <= 16; ++i) {
        Vec2 offset = h * Vec2{i + 0.5 * (j & 1) + 0.4, std::sqrt(0.75) * j};
        if (j == 0 && std::fabs(i - displaced_at) < 0.5)
          offset.x -= 0.35 * h;
        if (geometry::length(offset) < CleanupRules::reach * h)
          sites.push_back({unit_lattice().snap(middle + offset), h, mesh::free_site});
      }
    sort_for_a_patch(sites);
    return PatchOptimizer(none, curve, unit_lattice(), {}).improve(middle, h, sites, PatchBudget{});
  };
  const PatchResult at_the_rim = improve(6), inside = improve(1);
  EXPECT_TRUE(at_the_rim.edits.empty());
  EXPECT_TRUE(at_the_rim.verdicts.empty());
  EXPECT_FALSE(inside.edits.empty());
  EXPECT_FALSE(inside.verdicts.empty());
}

/// A patch across the border of a torus is the patch elsewhere.
TEST(PatchOptimizer, NearestImagesMakeAPatchOnATorus) {
  const shape::RegionShape torus = testing::whole_torus();
  const BoundaryCurve curve(torus.boundary());
  const BoundarySites none = make_boundary_sites(torus.boundary(), UniformSize(h), unit_lattice(), 30);
  const auto edits_at = [&](Vec2 center) {
    std::vector<PatchSite> sites;
    for (int j = -12; j <= 12; ++j)
      for (int i = -12; i <= 12; ++i) {
        const Vec2 offset = i == 0 && j == 0 ? Vec2{} : h * Vec2{i + 0.5 * (j & 1) + 0.3, std::sqrt(0.75) * j};
        if (geometry::length(offset) < CleanupRules::reach * h)
          sites.push_back({center + unit_lattice().snap(offset), h, mesh::free_site});
      }
    sort_for_a_patch(sites);
    return PatchOptimizer(none, curve, unit_lattice(), {}).improve(center, h, sites, PatchBudget{}).edits;
  };
  const std::vector<SiteEdit> inside = edits_at(middle), across = edits_at({0, 0});
  ASSERT_FALSE(inside.empty());
  ASSERT_EQ(inside.size(), across.size());
  for (std::size_t k = 0; k < inside.size(); ++k) {
    EXPECT_EQ(inside[k].from - middle, across[k].from);
    EXPECT_EQ(inside[k].to - middle, across[k].to);
  }
}

/// A strip of 0.4 h whose end is a triangle with an angle of 104 degrees.
Boundary blunt_strip() {
  const double length = 12 * h, tip = length + 0.156 * h;
  return boundary_of({polygon_loop({{0.25, 0.5},
                                    {0.25 + length, 0.5},
                                    {0.25 + tip, 0.5 + 0.2 * h},
                                    {0.25 + length, 0.5 + 0.4 * h},
                                    {0.25, 0.5 + 0.4 * h}})});
}

TEST(PatchOptimizer, InsertsNoMoreThanItMay) {
  const auto inserted = [](GlobalId may_insert, GlobalId may_refine) {
    Stage stage(blunt_strip());
    stage.add_boundary();
    stage.budget.may_insert = may_insert;
    stage.budget.may_refine = may_refine;
    const std::vector<SiteEdit> edits = stage.improve(unit_lattice().snap({0.25 + 12.156 * h, 0.5 + 0.2 * h}));
    return count(edits, Kind::insert, true) + count(edits, Kind::insert);
  };
  EXPECT_GT(inserted(100, 100), 2);
  EXPECT_LE(inserted(2, 2), 2);
  EXPECT_LE(inserted(2, 0), 2);
  EXPECT_LE(inserted(0, 2), 2);
  EXPECT_EQ(inserted(0, 0), 0);
}

} // namespace
} // namespace trime::cleanup
