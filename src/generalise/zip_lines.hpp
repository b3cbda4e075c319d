// SPDX-License-Identifier: BSD-3-Clause
// Joins curves with whatever lines they pass nearer than the triangles can show, also where only a part of them does.
#pragma once

#include "generalise/absorb_parts.hpp"
#include "generalise/cut_wedges.hpp"

#include <array>
#include <optional>
#include <span>

namespace trime::generalise {

/// @brief Joins curves with other curves and with interfaces where they come nearer to each other than
/// GeneraliseRules::snap_distance h, so that they become one line there. Unlike snapped_arcs(), it does so between the
/// vertices of long edges, too.
///
/// All lines are constraints of a triangulation, with further vertices where they are near to each other. An edge
/// between vertices of two lines is contracted if that inverts no triangle, so no line ever crosses another one.
/// Vertices on the boundary, those that the user asked for, and free ends stay; nodes stay if an inner vertex of a line
/// can move instead. Two lines with different names stay two. No region vanishes, and two regions between which `pairs`
/// knows no interface do not become neighbours. Adds to InnerCurves::losses.
/// Cost: O(n log n) for n pieces, if no vertex has many neighbours. Deterministic; uses one thread.
/// @param pairs pairs of regions, the lower one first, in ascending order
/// @return nothing if no lines are joined, or if curves cross
/// @pre the container is not periodic
std::optional<Partition> zip_lines(const Partition& given, const ArcRequest& request,
                                   std::span<const std::array<int, 2>> pairs);

} // namespace trime::generalise
