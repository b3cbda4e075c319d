// SPDX-License-Identifier: BSD-3-Clause
// Makes a checked polygon with vertices on the coordinate lattice from the rings of a contour.
#pragma once

#include "trime/contours/contour.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/shape/part.hpp"

#include <string>
#include <vector>

namespace trime::shape {

/// @brief Moves the rings of a contour, rounds them to the lattice, checks them, and finds which side of each ring is
/// inside.
/// @param warnings receives a sentence for each ring with vertices that became equal by rounding
/// @throws GeometryError under the conditions of Part::contour
Polygon make_contour_polygon(const contours::Contour& contour, const contours::Normalization& normalization,
                             const geometry::Frame& frame, std::vector<std::string>& warnings,
                             const TouchOptions& touches = {});

/// @brief Makes a polygon from one ring that is known not to cross itself.
/// @pre the ring has at least three vertices, which are not collinear
Polygon make_simple_polygon(const std::vector<geometry::Vec2>& ring);

/// Sets Polygon::Ring::reversed of all rings: a ring inside an odd number of other rings is a hole.
void orient_rings(Polygon& polygon);

} // namespace trime::shape
