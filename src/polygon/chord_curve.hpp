// SPDX-License-Identifier: BSD-3-Clause
// Compares the curve of the shape between two consecutive boundary sites with the chord that replaces it in the mesh.
// It uses only the boundary and the sites on it, but not how they were laid out.
#pragma once

#include "polygon/polygon.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/polygon/loop_summary.hpp"

#include <vector>

namespace trime::polygon {

/// The differences between a chord and its curve.
struct ChordCurve {
  double offset = 0;    ///< distance of the site from its place on the curve
  double deviation = 0; ///< largest distance of a point of the curve from the chord
  double area = 0;      ///< area between chord and curve that the mesh loses; negative if it gains area
  double curvature = 0; ///< radius of the circle if the curve is an arc, otherwise 0
};

/// @brief Returns one result for each of the sites first .. last-1, for the chord to its next. Exact except for
/// rounding; each result has a fixed order of operations, so the bits are the same on any threads and ranks. O(these
/// sites and the pieces next to them, log of the loops), by all threads. @pre the loops of `sites` are those of
/// `boundary`, in the same order
std::vector<ChordCurve> compare_chords(const geometry::Boundary& boundary, const BoundarySites& sites, LocalIndex first,
                                       LocalIndex last);

/// @brief Sets BoundarySite::part to the part of the piece in the middle of the curve between the site and its next.
/// O(sites + pieces). @pre as for compare_chords
void name_parts(const geometry::Boundary& boundary, BoundarySites& sites);

/// @brief Returns the area that the loops enclose, with exact arcs. On a torus it is known only up to multiples of the
/// area of the torus, so it lies between 0 and that area. O(pieces)
double area_of_loops(const geometry::Boundary& boundary);

/// Returns the loops of the mesh, in the order of the boundary. O(sites + parts). @pre as for compare_chords
std::vector<LoopSummary> summarize_loops(const geometry::Boundary& boundary, const BoundarySites& sites);

} // namespace trime::polygon
