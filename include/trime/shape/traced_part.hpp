// SPDX-License-Identifier: BSD-3-Clause
// Turns a function into the part of a shape where it is negative: marching squares near its zero set, then refinement
// of the polygon and search for corners.
#pragma once

#include "trime/geometry/lattice.hpp"
#include "trime/shape/part.hpp"
#include "trime/tracing/shape.hpp"

#include <string>

namespace trime::shape {

/// @brief Returns the places where the function `shape` is negative, as polygons that are traced within the container.
///
/// A straight side becomes one segment. A smooth curve becomes a polygon that deviates from the curve by at most 1e-6
/// of the container's longer side. Corners that turn by more than 4 degrees are vertices, to within a few steps of the
/// coordinate lattice. A part that reaches beyond the container continues a little outside of it, so that an
/// intersection with `domain` cuts it cleanly. Across a periodic side it continues in its periodic image, so the
/// function must have the period of the container. Features narrower than `resolution` may be missed. Default of
/// `resolution`: 1/512 of the longer side; values below 1/8192 of it give a warning, see Part::warnings. The function
/// is evaluated about (side/resolution)^2 / 4 times, plus a few thousand times per unit of length, by all threads. The
/// part does not keep the function.
/// @throws GeometryError with the place if a value is not finite, if pieces of the curve touch, or if the function has
/// the same sign everywhere. Also if the function oscillates below the resolution: if there are more than 16384 closed
/// curves, 4096 vertices between neighbouring grid lines, 2^23 vertices before thinning, or 2^25 cells of half the
/// resolution near zeros
Part traced_part(const std::string& name, const tracing::Shape& shape, const geometry::Frame& frame,
                 double resolution = 0);

} // namespace trime::shape
