// SPDX-License-Identifier: BSD-3-Clause
// Computes the area of a shape from its loops, and refuses shapes without area.
#pragma once

#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"

#include <string>
#include <vector>

namespace trime::shape {

/// Returns twice the signed area between a chain of pieces and a point. For closed loops the result does not depend on
/// the point.
double twice_area_under(const std::vector<geometry::Piece>& pieces, geometry::Vec2 origin);

/// @brief Returns whether a loop is only a few lattice steps wide. Such slivers appear where sides of two parts were
/// meant to be equal, but differ by rounding; they are not features of the shape.
bool is_sliver(const geometry::Loop& loop, double twice_area, const geometry::Frame& frame);

/// @brief Computes the area of a shape with unrolled loops on a torus. The sum of the areas under the loops is the area
/// of the shape plus a multiple of the area of the torus. Also finds out whether the shape reaches around the torus in
/// both directions.
/// @pre there are loops
void settle_area_on_torus(geometry::Boundary& boundary, double torus);

/// Returns an area that is not larger than rounding errors along the boundary.
double least_area(const geometry::Boundary& boundary, const geometry::Frame& frame);

/// @brief Checks that a shape has an area. Two loops that wind around a container and coincide enclose only rounding
/// errors.
/// @throws GeometryError for a shape whose area is not larger than rounding errors, with its expression and a place
void check_area(const geometry::Boundary& boundary, const std::string& region, const geometry::Frame& frame);

} // namespace trime::shape
