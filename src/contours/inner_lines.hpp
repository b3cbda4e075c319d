// SPDX-License-Identifier: BSD-3-Clause
// Finds the segments of a plane graph that have material on both sides.
#pragma once

#include "contours/segment_rings.hpp"
#include "trime/contours/contour.hpp"

#include <vector>

namespace trime::contours {

/// @brief Removes the segments with material on both sides or on no side, if somewhere an odd number of segments meets:
/// otherwise they form rings, and all of them stay. Material is everything that segments enclose, except the areas
/// with a hole point, as in Triangle. A warning names the number of these segments and the first one.
/// @param segments between the first vertices at each place, as remove_open_chains leaves them; they do not cross
/// @param contour its member `source` must be set; receives the warning
/// Cost: O(n log n), if few of the areas lie in others.
void remove_inner_lines(const std::vector<FileVertex>& vertices, std::vector<FileSegment>& segments,
                        const std::vector<FilePoint>& holes, Contour& contour);

} // namespace trime::contours
