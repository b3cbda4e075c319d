// SPDX-License-Identifier: BSD-3-Clause
// From a function to the polygons on which it is zero: marching squares in a band, refinement of the chords, corners.
#pragma once

#include "trime/geometry/frame.hpp"
#include "trime/geometry/shape.hpp"

#include <string>
#include <vector>

namespace trime::geometry {

/// @brief Closed rings, interior on the left; accuracy, cost and errors: see Part::implicit. The same bits for any
/// number of threads.
std::vector<std::vector<Vec2>> trace_zero_set(const std::string& name, const Shape& shape, const Frame& frame,
                                              double resolution);

} // namespace trime::geometry
