// SPDX-License-Identifier: BSD-3-Clause
// Compares the curve of the shape between two successive boundary sites with the chord that replaces it in the mesh. It
// uses only the boundary and the places of the sites on it, not the way in which they were laid out.
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
  double area = 0;      ///< between chord and curve: what the chord takes from the shape, negative if it adds some
  double curvature = 0; ///< radius of the circle, if the curve is an arc; else 0
};

/// @brief Returns one result for each of the sites first .. last-1, for the chord to its next. Exact except for
/// rounding; each result has a fixed order of operations, so the bits are the same on any threads and ranks. O(these
/// sites and the pieces next to them, log of the loops), by all threads. @pre the loops of `sites` are those of
/// `boundary`, in the same order
std::vector<ChordCurve> compare_chords(const geometry::Boundary& boundary, const BoundarySites& sites, LocalIndex first,
                                       LocalIndex last);

/// @brief Sets BoundarySite::part: that of the piece in the middle of the curve between the site and its next.
/// O(sites + pieces). @pre as for compare_chords
void name_parts(const geometry::Boundary& boundary, BoundarySites& sites);

/// @brief Area that the loops enclose, arcs included, from the pieces as they are. On a torus it is only known up to
/// whole areas of it: from 0, below one. O(pieces)
double area_of_loops(const geometry::Boundary& boundary);

/// The loops as the mesh has them, in the order of the boundary. O(sites + parts). @pre as for compare_chords
std::vector<LoopSummary> summarize_loops(const geometry::Boundary& boundary, const BoundarySites& sites);

} // namespace trime::polygon
