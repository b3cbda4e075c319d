// SPDX-License-Identifier: BSD-3-Clause
// Finds which periodic images of a part reach into the container.
#pragma once

#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/shape/part.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace trime::shape {

/// Returns the container as a part. Along periodic axes it has no border inside the container or its neighbours.
Part domain_part(const geometry::Frame& frame);

/// Returns the smallest box around a part. O(its segments)
geometry::Box box_of(const Part& part);

/// @brief Checks that a part can be used in a frame, because it may have been made in another one.
/// @throws GeometryError if it is not on the lattice of the frame, or beyond Frame::reach. O(its segments)
void check_frame(const Part& part, const geometry::Frame& frame);

/// @brief Returns the shifts by periods with which the part meets the container, in ascending order by x, then y.
/// Without periods this is {0, 0} alone.
/// @throws GeometryError if the part sticks out of a periodic side by more than one period
std::vector<geometry::Vec2> image_shifts(const Part& part, const geometry::Frame& frame);

/// Returns whether any segment of these parts has a marker.
bool have_markers(std::span<const Part> parts);

/// @brief Gives pieces whose segment has a marker a separate part, see geometry::Domain.
/// @param parts the parts to which Piece::part refers; the boundary may have the domain behind them
/// @return the marker of each name of a part, 0 if it has no marker
std::vector<std::int32_t> name_markers(geometry::Boundary& boundary, std::span<const Part> parts,
                                       const geometry::Frame& frame);

} // namespace trime::shape
