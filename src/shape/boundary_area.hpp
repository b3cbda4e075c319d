// SPDX-License-Identifier: BSD-3-Clause
// The area of a region by its loops, and regions that have none.
#pragma once

#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"

#include <string>
#include <vector>

namespace trime::shape {

/// Twice the signed area between a chain of pieces and a point. Loops that are closed may have any origin.
double twice_area_under(const std::vector<geometry::Piece>& pieces, geometry::Vec2 origin);

/// @brief Does a loop enclose nothing but a few steps of the lattice? Where sides of parts were meant to be equal there
/// are such slivers: they are no features.
bool is_sliver(const geometry::Loop& loop, double twice_area, const geometry::Frame& frame);

/// @brief Computes the area for unrolled loops on a torus: the areas under them add up to that of the region, except
/// for multiples of the area of the torus. Finds whether the region reaches around it both ways. @pre there are loops
void settle_area_on_torus(geometry::Boundary& boundary, double torus);

/// @brief Loops that wind may be slivers only together: two that lie on each other enclose nothing but rounding errors.
/// @throws GeometryError for a region without more area than that, by its text and a place
void check_area(const geometry::Boundary& boundary, const std::string& region, const geometry::Frame& frame);

} // namespace trime::shape
