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
  GlobalId most_points = 0; ///< never exceeded; 0: half a percent above the number of the beginning
  double tolerance = 0; ///< in asked sizes: how far chords may pass from corners that they leave out; 0: none may be
};

/// @brief Improves bad triangles of a stage in rounds of try and keep, until nothing is left to try. Afterwards the
/// stars that it may have changed are uncertain and must be computed. Collective. Takes about 0.5 ms per patch.
///
/// A site is a candidate if it has a bad triangle; the worst one of each cell of a few h is a contender for the middle
/// of a patch (PatchOptimizer). Those contenders act that are the first of their surroundings in the order of a hash of
/// place and round: their patches do not overlap, and the choice is the same for any partition. The other ranks send
/// the owner of a contender the parts of its patch that it does not know. The owner has the patch tried and sends the
/// changes to the owners of the sites; all ranks learn the changes on the boundary at the end. A site of a triangle
/// that nothing improved rests until it has moved by a share of h. The number of sites keeps to CleanupLimits.
///
/// The cost of a round grows only with what it touches: stars are computed once at the beginning; then the patches
/// report their triangles. At the end the stage gets all edits, if any patch became better: sites are put in place
/// without sorting and lose their leads, and stars without changes near them stay certain. Polygon and guard are
/// replaced if any of the edits was on the boundary.
/// @param meshed the curves on which the sites of the polygon lie
CleanupCounts mend(sites::Stage& stage, const geometry::Boundary& meshed, const geometry::Lattice& lattice,
                   const delaunay::StarBuilder& builder, const CleanupOptions& options);

} // namespace trime::cleanup
