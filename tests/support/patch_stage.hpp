// SPDX-License-Identifier: BSD-3-Clause
// Makes a patch of the clean-up from given sites, and checks the edits that the optimizer makes in it.
#pragma once

#include "cleanup/patch_optimizer.hpp"
#include "polygon/boundary_guard.hpp"
#include "support/boundary_edits.hpp"
#include "support/boundary_shapes.hpp"
#include "support/laid_sites.hpp"
#include "trime/mesh/quality.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace trime::cleanup::testing_patch {

using geometry::Boundary;
using geometry::Vec2;
using polygon::BoundaryCurve;
using polygon::BoundaryEdit;
using polygon::BoundaryGuard;
using polygon::BoundarySite;
using polygon::BoundarySites;
using polygon::EditKind;
using sizing::UniformSize;
using testing::make_boundary_sites;
using trime::testing::edited;
using trime::testing::loop_of;
using trime::testing::unit_lattice;
using Kind = EditKind;

constexpr double h = 0.03125;

/// Sorts the sites in the order that PatchOptimizer::improve requires.
inline void sort_for_a_patch(std::vector<PatchSite>& sites) {
  std::sort(sites.begin(), sites.end(), [](const PatchSite& a, const PatchSite& b) {
    return geometry::lexicographically_less(a.position, b.position);
  });
}

/// The sites of a patch, and all objects that the optimizer needs.
struct Stage {
  explicit Stage(Boundary of, double size = h)
      : boundary(std::move(of)), sites_on(make_boundary_sites(boundary, UniformSize(size), unit_lattice(), 30)),
        curve(boundary), guard(sites_on, unit_lattice()) {}
  Stage(const Stage&) = delete;

  void add(Vec2 p, std::int32_t kind = mesh::free_site) { sites.push_back({unit_lattice().snap(p), h, kind}); }
  void add_boundary() {
    for (std::size_t k = 0; k < sites_on.sites.size(); ++k)
      sites.push_back(
          {sites_on.sites[k].position, h, static_cast<BoundaryName>(k), 0, place(static_cast<LocalIndex>(k))});
  }
  BoundaryPlace place(LocalIndex k) const {
    const BoundarySite& site = sites_on.sites[static_cast<std::size_t>(k)];
    const LocalIndex loop = loop_of(sites_on, k);
    return {loop, site.corner, curve.arc(loop, site), 0, site.next};
  }
  /// Returns the boundary after these edits.
  BoundarySites edited_boundary(const std::vector<BoundaryEdit>& edits) const {
    return edited(sites_on, curve, edits).sites;
  }
  /// Edits the boundary, and adds its sites to the sites of patches.
  void add_boundary_with(const std::vector<BoundaryEdit>& edits) {
    sites_on = edited_boundary(edits);
    guard = BoundaryGuard(sites_on, unit_lattice());
    add_boundary();
  }
  /// Removes the site nearest to p.
  /// @return the position of the removed site
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
      if (geometry::length(site.position - center) < CleanupRules::reach * h)
        near.push_back(site);
    sort_for_a_patch(near);
    PatchOptimizer optimizer(sites_on, curve, unit_lattice(), options);
    const std::vector<SiteEdit> edits = optimizer.improve(center, h, near, budget).edits;
    optimizer.improve(near.front().position, h, near, budget); // the optimizer improves another patch in between
    EXPECT_TRUE(equal(edits, optimizer.improve(center, h, near, budget).edits)) << "not a function of the sites";
    expect_allowed(edits, center);
    return edits;
  }

  static bool equal(const std::vector<SiteEdit>& a, const std::vector<SiteEdit>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const SiteEdit& x, const SiteEdit& y) {
      return x.from == y.from && x.to == y.to && x.kind == y.kind && x.boundary == y.boundary && x.arc == y.arc;
    });
  }

  /// Checks edits: corners and fixed sites stay, each edit of a site comes from exactly one site, boundary sites lie on
  /// their curve, and nothing changes near the rim of the patch. A new site may move by h from its first place, because
  /// the triangles of the next patch are farther away.
  void expect_allowed(const std::vector<SiteEdit>& edits, Vec2 center) const {
    for (const SiteEdit& edit : edits) {
      EXPECT_EQ(edit.to, unit_lattice().snap(edit.to));
      EXPECT_LT(geometry::length(edit.from - center), (CleanupRules::reach - CleanupRules::free_depth) * h + h);
      const auto site = std::find_if(sites.begin(), sites.end(),
                                     [&](const PatchSite& candidate) { return candidate.position == edit.from; });
      if (edit.kind != Kind::insert) {
        ASSERT_NE(site, sites.end());
        EXPECT_NE(site->boundary, mesh::fixed_site);
        EXPECT_EQ(std::max<BoundaryName>(site->boundary, -1), std::max<BoundaryName>(edit.boundary, -1));
        if (site->boundary >= 0) {
          EXPECT_FALSE(sites_on.sites[static_cast<std::size_t>(site->boundary)].corner);
        }
      }
      if (edit.boundary >= 0 && edit.kind != Kind::remove) {
        EXPECT_GE(edit.arc, 0);
        EXPECT_LT(geometry::length(curve.place(edit.loop, edit.arc).point - edit.to), 1e-12);
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
  PatchBudget budget;
};

/// Returns the largest alpha of all triangles with a corner within `radius` of `center`, by brute force.
inline double worst_alpha(const Stage& stage, const std::vector<SiteEdit>& edits, Vec2 center, double radius) {
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

/// Returns the number of edits of one kind, on the boundary or inside.
inline std::ptrdiff_t count(const std::vector<SiteEdit>& edits, Kind kind, bool on_boundary = false) {
  return std::count_if(edits.begin(), edits.end(),
                       [&](const SiteEdit& edit) { return edit.kind == kind && (edit.boundary >= 0) == on_boundary; });
}

} // namespace trime::cleanup::testing_patch
