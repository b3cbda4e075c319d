// SPDX-License-Identifier: BSD-3-Clause
// The clean-up improves bad triangles after all sweeps, one patch of triangles after the other.
#pragma once

#include "cleanup/rules.hpp"
#include "delaunay/star_builder.hpp"
#include "sites/stage.hpp"
#include "trime/cleanup/cleanup_counts.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"

namespace trime::cleanup {

struct CleanupOptions {
  GlobalId most_points = 0; ///< largest number of points; 0: half a per cent more than at the beginning
  double tolerance = 0;     ///< [asked sizes] largest distance of a boundary edge from corners between its ends; 0: no
                            ///< boundary edge may leave out a corner
  double bad_alpha = CleanupRules::bad_alpha; ///< triangles with a larger alpha are improved
  bool split_ears = false; ///< divide triangles with two boundary edges that meet at 60 degrees or more
};

/// @brief Improves bad triangles of a stage in rounds. It tries changes and keeps those that improve the triangles,
/// until there is nothing left to try. Afterwards, Delaunay stars that may have changed are marked as uncertain and
/// must be computed again. Collective. Takes about 0.5 ms per patch.
///
/// A site is a candidate if it has a bad triangle. The worst candidate of each cell of a few h is a contender for the
/// middle of a patch (PatchOptimizer). A contender is chosen if it comes before all contenders around it in an order
/// that a hash of place and round defines. So the patches do not overlap, and the choice is the same for any partition.
/// The other ranks send the owner of a contender those parts of its patch that lie on their tiles. The owner, or
/// another rank on its behalf, tries the patch and sends the changes to the owners of the sites; all ranks receive the
/// changes on the boundary at the end. If nothing improved a triangle, its sites rest until they have moved by a share
/// of h. CleanupLimits bounds the number of sites.
///
/// The cost of a round depends only on the number of its patches: stars are computed once at the beginning, and later
/// the patches report their triangles. At the end all edits are applied to the stage. Sites are put in place without
/// sorting and lose their saved search starts (leads); stars without changes nearby stay certain. Polygon and guard are
/// replaced if an edit was on the boundary.
/// @param meshed the curves on which the sites of the polygon lie
CleanupCounts mend(sites::Stage& stage, const geometry::Boundary& meshed, const geometry::Lattice& lattice,
                   const delaunay::StarBuilder& builder, const CleanupOptions& options);

} // namespace trime::cleanup
