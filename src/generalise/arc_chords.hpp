// SPDX-License-Identifier: BSD-3-Clause
// Chords in place of arcs of circles.
#pragma once

#include "generalise/absorb_parts.hpp"

#include <optional>

namespace trime::generalise {

/// @brief Returns the number of equal chords for a piece: 1 if it is straight. The chords of an arc turn by at most
/// GeneraliseRules::arc_step, and are at most GeneraliseRules::arc_depth h from it.
/// @throws GeometryError if a size is not positive and finite
int chords_along(const geometry::Piece& piece, const sizing::SizeField& size);

/// Returns the area between a chord and the arc of a circle on it that turns by `sweep` radians; negative if the arc
/// lies on the left of the chord.
double area_on_chord(double length, double sweep);

/// @brief Makes chords of the circular interfaces that a curve follows nearer than GeneraliseRules::snap_distance h:
/// only straight lines are joined. A curve that crosses an interface, or ends on it, at more than about 20 degrees
/// follows nothing there. InnerArc::lost_area says what the chords take from the region on the left. Cost: O(m log n)
/// for n circular pieces and m places along curves, which are 0.1 h apart next to these pieces.
/// @return nothing if no curve follows a circular interface
/// @pre the container is not periodic
/// @throws GeometryError if a size is not positive and finite
std::optional<Partition> with_chords_along_curves(const Partition& given, const ArcRequest& request);

} // namespace trime::generalise
