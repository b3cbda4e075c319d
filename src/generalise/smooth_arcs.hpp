// SPDX-License-Identifier: BSD-3-Clause
// Smooths the interfaces between regions where they are rougher than the resolution of the mesh.
#pragma once

#include "generalise/curve_flow.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"

#include <vector>

namespace trime::generalise {

/// @brief Returns the arcs, with ragged interfaces smoothed as in smoothed_arc(). An arc is smoothed by half the
/// reach, and after a few halvings not at all, if the smooth one would cross or touch another curve outside of its
/// nodes, or change the order of the curves around a node. So regions keep their neighbours, their components and their
/// holes. Curves with the same region on both sides, and arcs of circles, do not change. Cost: O(n log n) for n pieces,
/// in each of a few rounds.
/// @param boundary the boundary that is meshed
/// @throws GeometryError if a size is not positive and finite
std::vector<geometry::InnerArc> smooth_arcs(const std::vector<geometry::InnerArc>& arcs,
                                            const geometry::Boundary& boundary, const FlowRequest& request,
                                            const geometry::Lattice& lattice);

} // namespace trime::generalise
