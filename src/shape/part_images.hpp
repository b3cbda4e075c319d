// SPDX-License-Identifier: BSD-3-Clause
// Finds which periodic images of a part reach into the container.
#pragma once

#include "trime/geometry/frame.hpp"
#include "trime/shape/part.hpp"

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

} // namespace trime::shape
