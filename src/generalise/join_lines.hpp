// SPDX-License-Identifier: BSD-3-Clause
// Gives the parts of curves that run along the boundary, an interface or another curve, nearer than the triangles can
// show, to that line.
#pragma once

#include "generalise/absorb_parts.hpp"

#include <optional>

namespace trime::generalise {

/// @brief Where a curve comes nearer to the boundary, to an interface, or to a curve before it, than
/// GeneraliseRules::snap_distance h, its part that lies within GeneraliseRules::rim_distance h of that line belongs to
/// that line. What is left of the curve ends on the line, at the foot of the perpendicular there or at a near vertex. A
/// free end next to the boundary or an arc of a circle belongs to that part, and so does one that follows another line
/// for more than about h. A curve may lose all of its edges.
///
/// An interface has the name and the direction of the first curve that belongs to it between two vertices in which
/// arcs end, if more than half of its way between them is followed. Its straight pieces lead through the free ends of
/// such curves, which stay bit for bit; InnerArc::lost_area counts this. Otherwise it stays where it is, also if it is
/// an arc of a circle.
///
/// A curve that leaves the line at more than about 20 degrees stays. So do straight lines that meet the line at any
/// angle, interfaces, curves that are split, weirs, and parts with a place that the user asked for. A node in which
/// other curves meet stays, too: if it is farther from the line than snap_distance h, an edge leads from it to the
/// line, and otherwise the part stays.
///
/// Each new edge was found not to meet any other one, so no crossings arise. Nothing else moves by more than rounding.
/// Adds to Partition::joined. Cost: O(m log n) for n pieces and m places along the curves, which are 0.1 h apart where
/// other lines are near, and O(e^2) for e new edges, in each of a few rounds. Deterministic; uses one thread.
/// @return nothing if no curve is so near to another line
/// @pre the container is not periodic
/// @throws GeometryError if a size is not positive and finite
std::optional<Partition> join_lines(const Partition& given, const ArcRequest& request);

} // namespace trime::generalise
