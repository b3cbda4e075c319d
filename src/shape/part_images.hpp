// SPDX-License-Identifier: BSD-3-Clause
// What parts bring into the boundary: the images of a part that reach into a periodic container, and the markers of a
// contour's segments on the pieces that follow them.
#pragma once

#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/shape/part.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace trime::shape {

/// The container as a part; along periodic axes it has no border inside of the container or its neighbours.
Part domain_part(const geometry::Frame& frame);

/// The least box around a part. O(its segments)
geometry::Box box_of(const Part& part);

/// @brief Checks that a part can be used in a frame: it may have been made in another one.
/// @throws GeometryError if it is not on the lattice of the frame, or beyond Frame::reach. O(its segments)
void check_frame(const Part& part, const geometry::Frame& frame);

/// @brief Shifts by periods that carry the part to where it meets the container; {0, 0} alone without periods.
/// Ascending by x, then y.
/// @throws GeometryError if the part sticks out of a periodic side by more than one period
std::vector<geometry::Vec2> image_shifts(const Part& part, const geometry::Frame& frame);

/// Has any segment of these parts a marker?
bool have_markers(std::span<const Part> parts);

/// @brief Gives pieces whose segment has a marker a part of their own, see geometry::Domain.
/// @param parts those that Piece::part names; the boundary may have the domain behind them
/// @return the marker of each name of a part, 0 for none
std::vector<std::int32_t> name_markers(geometry::Boundary& boundary, std::span<const Part> parts,
                                       const geometry::Frame& frame);

} // namespace trime::shape
