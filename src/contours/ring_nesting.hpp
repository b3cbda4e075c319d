// SPDX-License-Identifier: BSD-3-Clause
// Which rings bound what is meshed, where points say what is a hole.
#pragma once

#include "contours/segment_rings.hpp"
#include "trime/contours/contour.hpp"

#include <string>
#include <vector>

namespace trime::contours {

/// @brief Returns the rings with material on one side only, ascending: by even-odd nesting they enclose what all rings
/// enclose, except the areas right around a hole point. Others are left out; a warning lists those with material on
/// both sides, and hole points outside of all rings.
/// @pre rings do not cross. O(vertices) for each ring and hole within the boxes of others.
std::vector<std::size_t> rings_around_material(const std::vector<std::vector<RingVertex>>& rings,
                                               const std::vector<FilePoint>& holes, const std::string& source,
                                               std::vector<std::string>& warnings);

} // namespace trime::contours
