// SPDX-License-Identifier: BSD-3-Clause
// Computes the area of a region from its loops, and refuses regions without area.
#pragma once

#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"

#include <string>
#include <vector>

namespace trime::shape {

/// Returns twice the signed area between a chain of pieces and a point. For closed loops the point does not matter.
double twice_area_under(const std::vector<geometry::Piece>& pieces, geometry::Vec2 origin);

/// @brief Returns whether a loop is only a few lattice steps wide. Such slivers appear where sides of parts were meant
/// to be equal; they are not features.
bool is_sliver(const geometry::Loop& loop, double twice_area, const geometry::Frame& frame);

/// @brief Computes the area of a region with unrolled loops on a torus. The areas under the loops add up to that of the
/// region, except for multiples of the area of the torus. Also finds whether the region reaches around the torus both
/// ways. @pre there are loops
void settle_area_on_torus(geometry::Boundary& boundary, double torus);

/// @brief Checks that a region has an area. Loops that wind around a container can be slivers together: two that lie on
/// each other enclose only rounding errors.
/// @throws GeometryError for a region without a larger area, with its text and a place
void check_area(const geometry::Boundary& boundary, const std::string& region, const geometry::Frame& frame);

} // namespace trime::shape
