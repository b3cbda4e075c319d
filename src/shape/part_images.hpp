// SPDX-License-Identifier: BSD-3-Clause
// Finds the periodic images of a part that reach into the container.
#pragma once

#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/shape/part.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace trime::shape {

/// Returns the container as a part. Along a periodic axis the part is so long that it has no border inside the
/// container or its neighbours.
Part domain_part(const geometry::Frame& frame);

/// Returns the smallest box around a part. Cost: O(segments of the part).
geometry::Box box_of(const Part& part);

/// @brief Checks that a part can be used in a frame. The part may have been made in another frame.
/// @throws GeometryError if it is not on the coordinate lattice of the frame, or leaves Frame::reach. Cost: O(segments
/// of the part)
void check_frame(const Part& part, const geometry::Frame& frame);

/// @brief Returns the shifts, multiples of the periods, for which the part meets the container, in ascending order by
/// x, then y. Without periods the only shift is {0, 0}.
/// @throws GeometryError if the part extends beyond a periodic side by more than one period
std::vector<geometry::Vec2> image_shifts(const Part& part, const geometry::Frame& frame);

/// Returns whether any segment of these parts has a marker.
bool have_markers(std::span<const Part> parts);

/// @brief Assigns the pieces of segments with markers to separate parts, see geometry::Domain.
/// @param parts the parts to which Piece::part refers; in the boundary, the domain may follow them
/// @return the marker of each name in Boundary::part_names; 0 if it has no marker
std::vector<std::int32_t> name_markers(geometry::Boundary& boundary, std::span<const Part> parts,
                                       const geometry::Frame& frame);

} // namespace trime::shape
