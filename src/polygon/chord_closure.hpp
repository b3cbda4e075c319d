// SPDX-License-Identifier: BSD-3-Clause
// Makes closed polygons of the segments that meet a window, without touching the window.
#pragma once

#include "trime/geometry/vec2.hpp"

#include <vector>

namespace trime::polygon {

/// @brief The segments and some more outside of `window`, so that every end is shared by an even number of them. Which
/// points of the window lie inside by the even-odd rule is then decided up to exchanging inside and outside.
/// @param segments such that an end that only an odd number of them share lies outside of `window`
/// @param margin how far outside of everything the added ones lead around; it and all ends are lattice multiples
std::vector<geometry::Segment> close_outside(std::vector<geometry::Segment> segments, const geometry::Box& window,
                                             double margin);

} // namespace trime::polygon
