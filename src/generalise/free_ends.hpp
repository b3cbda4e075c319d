// SPDX-License-Identifier: BSD-3-Clause
// Keeps the free ends of curves at a distance from other curves that triangles can show.
#pragma once

#include "generalise/cut_wedges.hpp"
#include "trime/geometry/boundary.hpp"

namespace trime::generalise {

/// @brief Shortens curves that end nearer than GeneraliseRules::end_gap to another curve or to the boundary, without
/// touching it, until their distance is GeneraliseRules::end_clearance. What is separate stays separate, and the gap
/// takes one row of triangles. An end stays if it is one of ArcRequest::kept, if its last piece is an arc or too short,
/// or if it would have to move by more than GeneraliseRules::most_drawn_back. Adds to InnerCurves::joined_nodes. Cost:
/// O(n log n) for n pieces, if there are free ends.
/// @throws GeometryError if a size is not positive and finite
void draw_back_ends(geometry::InnerCurves& curves, const geometry::Boundary& boundary, const ArcRequest& request);

} // namespace trime::generalise
