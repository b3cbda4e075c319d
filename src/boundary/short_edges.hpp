// SPDX-License-Identifier: BSD-3-Clause
// Finds sites on the boundary that are too near to each other for the shortest edge that the user allows.
#pragma once

#include "geometry/short_edge.hpp"
#include "polygon/polygon.hpp"
#include "trime/comm/communicator.hpp"

#include <vector>

namespace trime::boundary {

/// @brief Returns all boundary edges that are shorter than this, and all other pairs of sites, across the inside or the
/// outside, that are nearer to each other. All ranks return the same. Collective. Cost: O(B log B) for B sites.
std::vector<geometry::ShortEdge> short_edges(const comm::Communicator& comm, const polygon::BoundarySites& boundary,
                                             double shortest);

} // namespace trime::boundary
