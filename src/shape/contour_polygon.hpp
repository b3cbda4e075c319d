// SPDX-License-Identifier: BSD-3-Clause
// From the rings of a contour to a checked polygon on the lattice.
#pragma once

#include "trime/contours/contour.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/shape/part.hpp"

#include <string>
#include <vector>

namespace trime::shape {

/// @brief Moves, snaps and checks the rings of a contour, and finds which side of each ring is inside.
/// @param warnings gets a sentence for each ring with vertices that the lattice made equal
/// @throws GeometryError see Part::contour
Polygon make_contour_polygon(const contours::Contour& contour, const contours::Normalization& normalization,
                             const geometry::Frame& frame, std::vector<std::string>& warnings);

/// @brief Polygon of one ring that is known to be simple. @pre at least three vertices, not all collinear
Polygon make_simple_polygon(const std::vector<geometry::Vec2>& ring);

} // namespace trime::shape
