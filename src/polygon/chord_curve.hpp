// SPDX-License-Identifier: BSD-3-Clause
// Compares the curve of the shape between two consecutive boundary sites with the
// straight chord that replaces the curve in the mesh. The comparison uses only the boundary and its sites, but no
// results of the code that placed the sites.
#pragma once

#include "polygon/polygon.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/polygon/loop_summary.hpp"

#include <vector>

namespace trime::polygon {

/// The differences between a chord and the curve that it replaces.
struct ChordCurve {
  double offset = 0;    ///< distance of the site from its place on the curve
  double deviation = 0; ///< largest distance of a point of the curve from the chord
  double area = 0;      ///< area between chord and curve that the mesh loses; negative if the mesh gains area
  double curvature = 0; ///< radius of the circle if the curve is an arc, otherwise 0
};

/// @brief Returns one result for each of the sites first .. last-1, about the chord from the site to the next one.
/// Exact except for rounding. Each result has a fixed order of operations, so the bits do not depend on threads and
/// ranks. Cost: O(these sites and the pieces next to them, and log of the loops), by all threads.
/// @pre the loops of `sites` are those of `boundary`, in the same order
std::vector<ChordCurve> compare_chords(const geometry::Boundary& boundary, const BoundarySites& sites, LocalIndex first,
                                       LocalIndex last);

/// @brief Sets BoundarySite::part to the part of the shape in the middle of the curve from the site to the next one.
/// Cost: O(sites + pieces).
/// @pre as for compare_chords
void name_parts(const geometry::Boundary& boundary, BoundarySites& sites);

/// @brief Returns the area that the loops enclose, with exact arcs. In a container that is periodic in both directions,
/// the area follows from the loops only up to multiples of the container's area; the result lies between 0 and that
/// area. Cost: O(pieces).
double area_of_loops(const geometry::Boundary& boundary);

/// Returns a summary of each loop of the mesh, in the order of the boundary. Cost: O(sites + parts).
/// @pre as for compare_chords
std::vector<LoopSummary> summarize_loops(const geometry::Boundary& boundary, const BoundarySites& sites);

} // namespace trime::polygon
