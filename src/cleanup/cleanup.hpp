// SPDX-License-Identifier: BSD-3-Clause
// The clean-up improves the bad triangles that the sweeps leave, patch by patch, after all sweeps.
#pragma once

#include "delaunay/star_builder.hpp"
#include "sites/stage.hpp"
#include "trime/cleanup/cleanup_counts.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"

namespace trime::cleanup {

struct CleanupOptions {
  GlobalId most_points = 0; ///< largest number of points; 0: half a percent above the number at the beginning
  double tolerance =
      0; ///< [asked sizes] largest distance of a chord from corners that it leaves out; 0: it may leave out none
};

/// @brief Improves bad triangles of a stage in rounds until nothing is left to try: it tries changes and keeps those
/// that help. Afterwards, stars that may have changed are uncertain and must be computed. Collective. Takes about 0.5
/// ms per patch.
///
/// A site is a candidate if it has a bad triangle; the worst one of each cell of a few h is a contender for the middle
/// of a patch (PatchOptimizer). A contender is chosen if it comes before all contenders around it, in the order of a
/// hash of place and round. So the patches do not overlap, and the choice is the same for any partition. The other
/// ranks send the owner of a contender the parts of its patch that it does not know. The owner tries the patch, or
/// another rank does so for it, and sends the changes to the owners of the sites; all ranks receive the changes on the
/// boundary at the end. A site of a triangle that nothing improved rests until it has moved by a share of h.
/// CleanupLimits bounds the number of sites.
///
/// The cost of a round grows only with what it touches: stars are computed once at the beginning; then the patches
/// report their triangles. At the end all edits are applied to the stage. Sites are put in place without sorting and
/// lose their leads, and stars without changes nearby stay certain. Polygon and guard are replaced if an edit was on
/// the boundary.
/// @param meshed the curves on which the sites of the polygon lie
CleanupCounts mend(sites::Stage& stage, const geometry::Boundary& meshed, const geometry::Lattice& lattice,
                   const delaunay::StarBuilder& builder, const CleanupOptions& options);

} // namespace trime::cleanup
