// SPDX-License-Identifier: BSD-3-Clause
// Finds the smallest angles between curves at the nodes inside a shape.
#pragma once

#include "trime/geometry/boundary.hpp"

#include <vector>

namespace trime::geometry {

/// @brief Sets InnerArc::start_wedge and end_wedge of all open arcs: the smallest angle between two arcs, or between
/// one and the boundary, at their ends, if it is below 60 degrees. Cost: O(n log n).
void set_wedges(std::vector<InnerArc>& arcs, const Boundary& boundary);

} // namespace trime::geometry
