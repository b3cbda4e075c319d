// SPDX-License-Identifier: BSD-3-Clause
// Gives the parts of curves that run along the boundary or another curve, nearer than the triangles can show, to that
// line.
#pragma once

#include "generalise/absorb_parts.hpp"

#include <optional>

namespace trime::generalise {

/// @brief Where a curve comes nearer to the boundary, or to a curve before it, than GeneraliseRules::snap_distance h,
/// its part that lies within GeneraliseRules::rim_distance h of that line belongs to that line. What is left of the
/// curve ends on the line, at the foot of the perpendicular there or at a near vertex. A free end of a curve that lies
/// so near to the line belongs to that part. A curve that leaves the line at more than about 20 degrees stays. So do
/// interfaces, curves that are split, weirs, and parts with a place that the user asked for or with a node in which
/// other curves meet. A curve may lose all of its edges.
///
/// Each new edge was found not to meet any other one, so no crossings arise. Nothing else moves by more than rounding.
/// Adds to Partition::joined. Cost: O(m log n) for n pieces and m places along the curves, which are 0.1 h apart where
/// other lines are near, in each of a few rounds. Deterministic; uses one thread.
/// @return nothing if no curve is so near to another line
/// @pre the container is not periodic
/// @throws GeometryError if a size is not positive and finite
std::optional<Partition> join_lines(const Partition& given, const ArcRequest& request);

} // namespace trime::generalise
