// SPDX-License-Identifier: BSD-3-Clause
// What the optimizer makes of patches whose remedy is known.
#include "meshing/patch.hpp"

#include "support/boundary_shapes.hpp"
#include "support/periodic_shapes.hpp"
#include "support/point_sets.hpp"
#include "trime/geometry/diametral.hpp"
#include "trime/mesh/quality.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace trime::meshing {
namespace {

using geometry::Boundary;
using geometry::Vec2;
using sizing::UniformSize;
using testing::boundary_of;
using testing::circle_loop;
using testing::polygon_loop;
using testing::unit_lattice;
using Kind = SiteEdit::Kind;

constexpr double h = 0.03125;
const Vec2 middle{0.5, 0.5};

/// Sites of a patch, and all that the optimizer needs.
struct Stage {
  explicit Stage(Boundary of, double size = h)
      : boundary(std::move(of)), sites_on(make_boundary_sites(boundary, UniformSize(size), unit_lattice(), 30)),
        curve(boundary), guard(sites_on, unit_lattice()) {}
  Stage(const Stage&) = delete;

  void add(Vec2 p, std::int32_t kind = mesh::free_site) { sites.push_back({unit_lattice().snap(p), h, kind}); }
  void add_boundary() {
    for (std::size_t k = 0; k < sites_on.sites.size(); ++k)
      sites.push_back({sites_on.sites[k].position, h, static_cast<std::int32_t>(k)});
  }
  /// Takes the site nearest to p out. @return where it was
  Vec2 take_nearest(Vec2 p) {
    const auto nearest = std::min_element(sites.begin(), sites.end(), [&](const PatchSite& a, const PatchSite& b) {
      return geometry::squared_length(a.position - p) < geometry::squared_length(b.position - p);
    });
    const Vec2 at = nearest->position;
    sites.erase(nearest);
    return at;
  }

  std::vector<SiteEdit> improve(Vec2 center) {
    std::vector<PatchSite> near;
    for (const PatchSite& site : sites)
      if (geometry::length(site.position - center) < PatchOptions{}.reach * h)
        near.push_back(site);
    std::sort(near.begin(), near.end(), [](const PatchSite& a, const PatchSite& b) {
      return geometry::lexicographically_less(a.position, b.position);
    });
    PatchOptimizer optimizer(sites_on, curve, guard, unit_lattice(), options);
    std::vector<SiteEdit> edits, again;
    const bool better = optimizer.improve(center, h, near, PatchBudget{}, edits);
    for (const SiteEdit& edit : edits)
      EXPECT_EQ(edit.kind == Kind::none, !better);
    optimizer.improve(near.front().position, h, near, PatchBudget{}, again); // something else in between
    again.clear();
    optimizer.improve(center, h, near, PatchBudget{}, again);
    EXPECT_TRUE(equal(edits, again)) << "not a function of the sites";
    if (!better)
      edits.clear();
    expect_allowed(edits);
    return edits;
  }

  static bool equal(const std::vector<SiteEdit>& a, const std::vector<SiteEdit>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const SiteEdit& x, const SiteEdit& y) {
      return x.from == y.from && x.to == y.to && x.kind == y.kind && x.boundary == y.boundary && x.arc == y.arc;
    });
  }

  /// Corners and fixed sites stay, what comes from a site comes from one, and boundary sites lie on their curve.
  void expect_allowed(const std::vector<SiteEdit>& edits) const {
    for (const SiteEdit& edit : edits) {
      EXPECT_EQ(edit.to, unit_lattice().snap(edit.to));
      const auto site = std::find_if(sites.begin(), sites.end(),
                                     [&](const PatchSite& candidate) { return candidate.position == edit.from; });
      if (edit.kind != Kind::insert) {
        ASSERT_NE(site, sites.end());
        EXPECT_NE(site->boundary, mesh::fixed_site);
        EXPECT_EQ(std::max(site->boundary, -1), std::max(edit.boundary, -1));
        if (site->boundary >= 0) {
          EXPECT_FALSE(sites_on.sites[static_cast<std::size_t>(site->boundary)].corner);
        }
      }
      if (edit.boundary >= 0 && edit.kind != Kind::remove) {
        EXPECT_GE(edit.arc, 0);
        EXPECT_LT(geometry::length(curve.place(loop_of(sites_on, edit.boundary), edit.arc).point - edit.to), 1e-12);
      }
      if (edit.boundary < 0 && edit.kind != Kind::remove) {
        EXPECT_TRUE(guard.inside(edit.to));
      }
    }
  }

  Boundary boundary;
  BoundarySites sites_on;
  BoundaryCurve curve;
  BoundaryGuard guard;
  std::vector<PatchSite> sites;
  PatchOptions options;
};

Boundary far_square() {
  return boundary_of({polygon_loop({{0.05, 0.05}, {0.95, 0.05}, {0.95, 0.95}, {0.05, 0.95}})});
}

/// A hexagonal lattice about the middle, rows along x.
void add_lattice(Stage& stage, int rings = 9, Vec2 about = middle) {
  for (int j = -rings; j <= rings; ++j)
    for (int i = -rings; i <= rings; ++i)
      stage.add(about + h * Vec2{i + 0.5 * (j & 1), std::sqrt(0.75) * j});
}

/// Largest alpha of the triangles with a corner within `radius` of `center`, by brute force.
double worst_alpha(const Stage& stage, const std::vector<SiteEdit>& edits, Vec2 center, double radius) {
  PatchMesh mesh(unit_lattice(), {});
  mesh.start(center, 4);
  const auto is_gone = [&](Vec2 p) {
    return std::any_of(edits.begin(), edits.end(),
                       [&](const SiteEdit& edit) { return edit.kind != Kind::insert && edit.from == p; });
  };
  for (const PatchSite& site : stage.sites)
    if (!is_gone(site.position)) {
      EXPECT_GE(mesh.insert(site.position), 0);
    }
  for (const SiteEdit& edit : edits)
    if (edit.kind != Kind::remove) {
      EXPECT_GE(mesh.insert(edit.to), 0);
    }
  double worst = 1;
  for (const PatchMesh::Triangle& triangle : mesh.triangles()) {
    bool counts = false;
    Vec2 centroid;
    for (const LocalIndex v : triangle.vertex)
      if (v >= 0) {
        counts |= geometry::length(mesh.position(v) - center) < radius;
        centroid = centroid + (1.0 / 3) * mesh.position(v);
      }
    if (triangle.vertex[0] >= PatchMesh::frame && triangle.vertex[1] >= PatchMesh::frame &&
        triangle.vertex[2] >= PatchMesh::frame && counts && stage.guard.inside(unit_lattice().snap(centroid)))
      worst = std::max(worst, mesh::aspect_ratio(mesh.position(triangle.vertex[0]), mesh.position(triangle.vertex[1]),
                                                 mesh.position(triangle.vertex[2])));
  }
  return worst;
}

/// How many edits of a kind there are, on the boundary or inside.
std::ptrdiff_t count(const std::vector<SiteEdit>& edits, Kind kind, bool on_boundary = false) {
  return std::count_if(edits.begin(), edits.end(),
                       [&](const SiteEdit& edit) { return edit.kind == kind && (edit.boundary >= 0) == on_boundary; });
}

TEST(PatchOptimizer, LeavesAPerfectLatticeAlone) {
  Stage stage(far_square());
  add_lattice(stage);
  EXPECT_TRUE(stage.improve(middle).empty());
}

TEST(PatchOptimizer, BringsADisplacedSiteBack) {
  for (const Vec2 away : {Vec2{0.3, 0.1}, {-0.2, 0.25}, {0, -0.4}}) {
    Stage stage(far_square());
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

/// Another patch may begin 2 reach - clearance away: it may read what this one changes otherwise.
TEST(PatchOptimizer, ChangesNothingNearTheRimHoweverSmallTheTrianglesThere) {
  Stage stage(far_square());
  add_lattice(stage);
  stage.take_nearest(middle);
  const Vec2 displaced = unit_lattice().snap(middle + h * Vec2{0.3, 0.1});
  stage.add(displaced);
  for (PatchSite& site : stage.sites)
    if (geometry::length(site.position - middle) > 2 * h)
      site.size = 0.05 * h;
  const std::vector<SiteEdit> edits = stage.improve(displaced);
  EXPECT_FALSE(edits.empty());
  for (const SiteEdit& edit : edits)
    EXPECT_LT(geometry::length(edit.from - displaced), (PatchOptions{}.reach - PatchOptions::clearance) * h);
}

TEST(PatchOptimizer, DeletesOneTooMany) {
  Stage stage(far_square());
  stage.options.bad_alpha = stage.options.operate_alpha = 1.02; // so that moves alone are not enough
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
  stage.options.bad_alpha = stage.options.operate_alpha = 1.02; // so that moves alone are not enough
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
    const Vec2 displaced = unit_lattice().snap(middle + Vec2{away * h, 0});
    std::vector<LocalIndex> inserted;
    for (LocalIndex k = 0; k < static_cast<LocalIndex>(stage.sites_on.sites.size()); ++k)
      if (geometry::length(stage.sites_on.sites[static_cast<std::size_t>(k)].position - middle) < 1e-12) {
        std::vector<BoundaryEdit> edits{
            {k, BoundaryEdit::Kind::slide,
             stage.curve.arc(0, stage.sites_on.sites[static_cast<std::size_t>(k)]) + (displaced.x - middle.x),
             displaced}};
        edit_boundary(stage.sites_on, stage.curve, edits, inserted);
      }
    ASSERT_EQ(inserted.size(), 1u);
    stage.guard = BoundaryGuard(stage.sites_on, unit_lattice());
    stage.add_boundary();
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
    stage.options.bad_alpha = 1.02;
    std::vector<LocalIndex> inserted;
    Vec2 center = middle;
    for (LocalIndex k = 0; k < static_cast<LocalIndex>(stage.sites_on.sites.size()); ++k)
      if (geometry::length(stage.sites_on.sites[static_cast<std::size_t>(k)].position - middle) < 1e-12) {
        const double arc = stage.curve.arc(0, stage.sites_on.sites[static_cast<std::size_t>(k)]);
        const Vec2 extra = unit_lattice().snap(middle + Vec2{0.5 * h, 0});
        std::vector<BoundaryEdit> edits;
        if (one_more)
          edits = {{k, BoundaryEdit::Kind::insert, arc + 0.5 * h, extra}};
        else
          edits = {{k, BoundaryEdit::Kind::remove, 0, {}}};
        edit_boundary(stage.sites_on, stage.curve, edits, inserted);
        center = one_more ? extra : unit_lattice().snap(middle + Vec2{h, 0});
        break;
      }
    ASSERT_EQ(inserted.size(), 1u);
    stage.guard = BoundaryGuard(stage.sites_on, unit_lattice());
    stage.add_boundary();
    add_upper_lattice(stage);
    const double before = worst_alpha(stage, {}, middle, 3 * h);
    EXPECT_GT(before, 1.1);
    const std::vector<SiteEdit> edits = stage.improve(center);
    EXPECT_GE(count(edits, one_more ? Kind::remove : Kind::insert, true), 1);
    EXPECT_LT(worst_alpha(stage, edits, middle, 3 * h), 1.03);
  }
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
      BoundarySites after = stage.sites_on;
      std::vector<BoundaryEdit> on_boundary;
      for (const SiteEdit& edit : edits)
        if (edit.boundary >= 0)
          on_boundary.push_back({edit.boundary,
                                 edit.kind == Kind::move     ? BoundaryEdit::Kind::slide
                                 : edit.kind == Kind::remove ? BoundaryEdit::Kind::remove
                                                             : BoundaryEdit::Kind::insert,
                                 edit.arc, edit.to});
      std::vector<LocalIndex> inserted;
      edit_boundary(after, stage.curve, on_boundary, inserted);
      for (LocalIndex i = 0; i < static_cast<LocalIndex>(after.sites.size()) && !on_boundary.empty(); ++i)
        for (const BoundarySite& site : after.sites)
          ASSERT_GE(geometry::diametral_side(after.chord(i).a, after.chord(i).b, site.position), 0) << gap;
    }
  }
}

/// A patch across the border of a torus is the patch elsewhere.
TEST(PatchOptimizer, NearestImagesMakeAPatchOnATorus) {
  const geometry::RegionShape torus = testing::whole_torus();
  const BoundarySites none = make_boundary_sites(torus.boundary(), UniformSize(h), unit_lattice(), 30);
  const BoundaryCurve curve(torus.boundary());
  const BoundaryGuard guard(none, unit_lattice());
  const auto edits_at = [&](Vec2 center) {
    std::vector<PatchSite> sites;
    for (int j = -9; j <= 9; ++j)
      for (int i = -9; i <= 9; ++i) {
        const Vec2 offset = i == 0 && j == 0 ? Vec2{} : h * Vec2{i + 0.5 * (j & 1) + 0.3, std::sqrt(0.75) * j};
        if (geometry::length(offset) < 6 * h)
          sites.push_back({center + unit_lattice().snap(offset), h, mesh::free_site});
      }
    std::sort(sites.begin(), sites.end(), [](const PatchSite& a, const PatchSite& b) {
      return geometry::lexicographically_less(a.position, b.position);
    });
    std::vector<SiteEdit> edits;
    PatchOptimizer(none, curve, guard, unit_lattice(), {}).improve(center, h, sites, PatchBudget{}, edits);
    return edits;
  };
  const std::vector<SiteEdit> inside = edits_at(middle), across = edits_at({0, 0});
  ASSERT_FALSE(inside.empty());
  ASSERT_EQ(inside.size(), across.size());
  for (std::size_t k = 0; k < inside.size(); ++k) {
    EXPECT_EQ(inside[k].from - middle, across[k].from);
    EXPECT_EQ(inside[k].to - middle, across[k].to);
  }
}

} // namespace
} // namespace trime::meshing
