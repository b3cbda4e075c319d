// SPDX-License-Identifier: BSD-3-Clause
// Finds the edges of the finished mesh that are shorter than the user allows.
#pragma once

#include "geometry/short_edge.hpp"
#include "sites/stage.hpp"

#include <vector>

namespace trime::extraction {

/// @brief Returns the shorter edges in lexicographic order, the same on all ranks. Collective. Cost: O(points), by all
/// threads.
/// @pre the stars of all sites are certain
std::vector<geometry::ShortEdge> short_edges(const sites::StageView& view, double shortest);

} // namespace trime::extraction
