// SPDX-License-Identifier: BSD-3-Clause
// Input and output of a patch. Plain data, because ranks send some of them to each other.
#pragma once

#include "cleanup/rules.hpp"
#include "mesh/site.hpp"
#include "polygon/boundary_chain.hpp"
#include "trime/geometry/vec2.hpp"

#include <cmath>
#include <cstdint>
#include <vector>

namespace trime::cleanup {

/// @brief The name of a site on the boundary during the clean-up, which is the same on every rank: for sites that
/// existed at the beginning, their index; for new sites, a hash. A negative number means that the site lies inside: see
/// mesh::Site, and for sites on curves inside see name_on_curve.
using BoundaryName = std::int64_t;

/// Largest name of a site on a curve inside.
inline constexpr BoundaryName first_on_curve = mesh::fixed_site - 1;
/// Returns the name of a site on a curve inside, given its index into polygon::InnerChords::sites at the beginning.
constexpr BoundaryName name_on_curve(LocalIndex site) {
  return first_on_curve - site;
}
/// Returns the index of a site on a curve inside; negative if the name is not that of such a site.
constexpr LocalIndex index_on_curve(BoundaryName name) {
  return name <= first_on_curve ? static_cast<LocalIndex>(first_on_curve - name) : -1;
}

/// The place of a site on the boundary.
struct BoundaryPlace {
  LocalIndex loop = -1;
  bool corner = false;
  double arc = 0;         ///< arc length from the start of the loop
  double tolerance = 0;   ///< largest distance of a new boundary edge from a curve with corners between its ends
  BoundaryName next = -1; ///< the next site along the loop
};

/// A site near a bad triangle, at the periodic image near that triangle.
struct PatchSite {
  geometry::Vec2 position;
  double size;                             ///< target edge length h at the site
  BoundaryName boundary = mesh::free_site; ///< name on the boundary
  std::int32_t rests = 0;                  ///< 1 if no change improved its triangles the last time
  BoundaryPlace on_boundary{};             ///< place on the boundary, if the site lies there
};

/// A change of one site: a move, a removal, or an addition (then `from` is not used).
struct SiteEdit {
  geometry::Vec2 from, to;
  polygon::EditKind kind = polygon::EditKind::move;
  LocalIndex loop = -1; ///< loop of a site on the boundary
  BoundaryName boundary =
      mesh::free_site; ///< name of the site; for a new site on the boundary, the name of the site before it
  BoundaryName made = mesh::free_site; ///< name of a new site
  double arc = 0;                      ///< arc length of the new place on the boundary
  std::uint64_t patch = 0;             ///< number of the patch that makes the change
  double size = 0, tolerance = 0;      ///< h, and BoundaryPlace::tolerance, at the new place; CleanupRounds sets them
};

/// A site on the boundary whose next site has changed.
struct BoundaryLink {
  geometry::Vec2 position; ///< position after the changes of the patch
  BoundaryName site, next;
};

/// The state of a site after its patch has been tried.
struct SiteVerdict {
  geometry::Vec2 position; ///< position after the changes of the patch
  double size;             ///< h
  double alpha;            ///< alpha of its worst triangle if that is bad, otherwise 0
  std::int64_t rests;      ///< nothing helped for its bad triangles, and it has not moved much since
  std::int64_t obtuse = 0; ///< 1 if one of its triangles is obtuse
};

/// The result of trying a patch.
struct PatchResult {
  std::vector<SiteEdit> edits;     ///< changes that improve the patch; empty if no change does
  std::vector<BoundaryLink> links; ///< one for each site on the boundary that has moved, is new, or has a new next site
  std::vector<SiteVerdict> verdicts; ///< one for each site that has or had bad triangles, if anything changed around it
  bool put_off = false;              ///< true if CleanupLimits has dropped the edits because of the number of sites
};

/// The values of alpha above which changes are tried. Tests lower them to see how almost good triangles are treated.
struct PatchOptions {
  double bad_alpha = CleanupRules::bad_alpha;
  double operate_alpha = CleanupRules::operate_alpha;
  double first_alpha = CleanupRules::first_alpha;
  double ear_alpha =
      0; ///< what triangles with two boundary edges add to their alpha, so that they are divided; 0: nothing
};

/// Returns whether the angle at v between two other places is at least 60 degrees.
inline bool is_wide_corner(geometry::Vec2 v, geometry::Vec2 a, geometry::Vec2 b) {
  const geometry::Vec2 u = a - v, w = b - v;
  return geometry::dot(u, w) <=
         CleanupRules::ear_cosine * std::sqrt(geometry::squared_length(u) * geometry::squared_length(w));
}

/// Limits on how a patch may change the number of sites.
struct PatchBudget {
  GlobalId may_insert = 100; ///< largest number of sites that the patch may gain
  GlobalId may_refine =
      100; ///< largest number of sites that the patch may gain at places where only smaller triangles improve the mesh
  GlobalId may_delete = 2; ///< largest number of sites that the patch may lose
  bool is_again = false;   ///< whether this is a later stage, which tries the worst places of the mesh again
  double again_alpha =
      CleanupRules::again_alpha; ///< in that case, operations are tried for triangles with a larger alpha
  double obtuse_weight = 0; ///< above 0: only obtuse triangles are tried, and this is what each of them costs in a sum
  bool is_last = false;     ///< whether no other stage follows; then more trials run to their end
  double deletion_handicap = 1; ///< factor on the sum of a trial with fewer sites: above 1 if sites are scarce
};

} // namespace trime::cleanup
