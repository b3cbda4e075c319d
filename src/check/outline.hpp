// SPDX-License-Identifier: BSD-3-Clause
// Finds the outline of polygons that overlap, share borders or run along their own edges, with exact arithmetic.
#pragma once

#include "config_text.hpp"

#include <vector>

namespace trime_check {

/// @brief Returns the rings around the union of polygons, with what is inside on their left. In each polygon the
/// even-odd rule decides what is inside. What has no area, such as a spike, is not part of the outline. Rings may touch
/// themselves and each other in vertices. All vertices of the input on the outline stay; places where edges cross
/// are rounded to double. Cost: O((n + k) log n) for n edges with k crossings.
/// @param polygon the number of the polygon of each ring; as long as `rings`
std::vector<Ring> outline(const std::vector<Ring>& rings, const std::vector<int>& polygon);

/// Returns the vertices of an outline that no ring of the input has: places where edges cross.
std::vector<Point> new_vertices(const std::vector<Ring>& outline, const std::vector<Ring>& input);

/// @brief Removes holes whose mean width, twice the area divided by the perimeter, is below `width`.
/// @param rings with what is inside on their left
void drop_narrow_holes(std::vector<Ring>& rings, double width);

} // namespace trime_check
