// SPDX-License-Identifier: BSD-3-Clause
// Input and output of a patch. Plain data; ranks send some of it to each other.
#pragma once

#include "cleanup/rules.hpp"
#include "mesh/site.hpp"
#include "polygon/boundary_chain.hpp"
#include "trime/geometry/vec2.hpp"

#include <cstdint>
#include <vector>

namespace trime::cleanup {

/// @brief The name of a site on the boundary during the clean-up, the same on every rank: the index for sites of the
/// beginning, a hash for new ones. A negative number means that the site is inside, see mesh::Site.
using BoundaryName = std::int64_t;

/// The place of a site on the boundary.
struct BoundaryPlace {
  LocalIndex loop = -1;
  bool corner = false;
  double arc = 0;         ///< from the start of the loop
  double tolerance = 0;   ///< how far a new chord may pass from a curve with corners between
  BoundaryName next = -1; ///< the next site along the loop
};

/// A site near a bad triangle, at that image of it which lies there.
struct PatchSite {
  geometry::Vec2 position;
  double size;                             ///< h there
  BoundaryName boundary = mesh::free_site; ///< its name
  std::int32_t rests = 0;                  ///< nothing helped here the last time
  BoundaryPlace on_boundary{};             ///< if it is on the boundary
};

/// A change of one site: it moves, it goes, or it is new (`from` says nothing then).
struct SiteEdit {
  geometry::Vec2 from, to;
  polygon::EditKind kind = polygon::EditKind::move;
  LocalIndex loop = -1;                    ///< of a site on the boundary
  BoundaryName boundary = mesh::free_site; ///< name of the site; for a new one on the boundary, of the site before it
  BoundaryName made = mesh::free_site;     ///< of a new site: its name
  double arc = 0;                          ///< of the new place on the boundary
  std::uint64_t patch = 0;                 ///< which patch wants it
  double size = 0, tolerance = 0; ///< h, and BoundaryPlace::tolerance, at the new place; CleanupRounds sets them
};

/// A site on the boundary has got another next one.
struct BoundaryLink {
  geometry::Vec2 position; ///< after the patch
  BoundaryName site, next;
};

/// A site after a patch has been tried.
struct SiteVerdict {
  geometry::Vec2 position; ///< after the patch
  double size;             ///< h
  double alpha;            ///< of its worst triangle if that is bad, else 0
  std::int64_t rests;      ///< nothing helped for its bad triangles, and it has not moved much since
};

/// The result of a patch.
struct PatchResult {
  std::vector<SiteEdit> edits;       ///< empty if nothing was better
  std::vector<BoundaryLink> links;   ///< of the sites on the boundary that move, are new, or have new next ones
  std::vector<SiteVerdict> verdicts; ///< of the sites that have or had bad triangles, where something has changed
  bool put_off = false;              ///< the edits were dropped to keep the number of sites; CleanupLimits sets it
};

/// When something is tried. Tests lower these limits to see what becomes of nearly good triangles.
struct PatchOptions {
  double bad_alpha = CleanupRules::bad_alpha;
  double operate_alpha = CleanupRules::operate_alpha;
  double first_alpha = CleanupRules::first_alpha;
};

/// Limits on how a patch may change the number of sites.
struct PatchBudget {
  GlobalId may_insert = 100;                      ///< largest number of sites that the patch may gain
  GlobalId may_refine = 100;                      ///< the same where smaller triangles are the last resort
  GlobalId may_delete = 2;                        ///< largest number of sites that the patch may lose
  bool is_again = false;                          ///< whether the patch has been tried before
  double again_alpha = CleanupRules::again_alpha; ///< then operations are tried for triangles above it
  double deletion_handicap = 1; ///< factor on the sum of a trial with fewer sites: above 1 if sites are scarce
};

} // namespace trime::cleanup
