// SPDX-License-Identifier: BSD-3-Clause
// Closes the segments that meet a window to polygons, by segments that lie outside the window.
#pragma once

#include "trime/geometry/vec2.hpp"

#include <vector>

namespace trime::polygon {

/// @brief Returns the segments and additional ones outside `window`, so that every end belongs to an even number of
/// segments. Then the even-odd rule separates inside and outside in the window, but does not say which is which.
/// @param segments an end that belongs to an odd number of them lies outside `window`
/// @param margin distance of the added segments from all others; a multiple of the lattice step, as all ends are
std::vector<geometry::Segment> close_outside(std::vector<geometry::Segment> segments, const geometry::Box& window,
                                             double margin);

} // namespace trime::polygon
