// SPDX-License-Identifier: BSD-3-Clause
// Parts of a periodic container: which images of a part reach into the container.
#pragma once

#include "trime/geometry/lattice.hpp"
#include "trime/shape/part.hpp"

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

} // namespace trime::shape
