// SPDX-License-Identifier: BSD-3-Clause
// From a function to the part where it is negative: marching squares in a band, refinement of the chords, corners.
#pragma once

#include "trime/geometry/lattice.hpp"
#include "trime/shape/part.hpp"
#include "trime/tracing/shape.hpp"

#include <string>

namespace trime::shape {

/// @brief The inside of a function, `shape` < 0, as polygons that are traced within the container.
///
/// Straight sides become one segment each. Smooth curves become chords that deviate by at most 1e-6 of the container's
/// longer side. Corners that turn by more than 4 degrees are vertices, to within a few lattice steps. A part that
/// reaches beyond the container continues a little way outside, so that `domain` may cut it. Across a periodic side it
/// continues in its image, so the function must have the period of the container. Features narrower than `resolution`
/// may be missed (default: 1/512 of the longer side; at least 1/8192 of it, else a warning, see Part::warnings).
/// Evaluates the function about (side/resolution)^2 / 4 times, plus a few thousand times per unit of length, by all
/// threads. Does not keep the function.
/// @throws GeometryError with the place if a value is not finite, if pieces of the curve touch, or if the function has
/// the same sign everywhere. Also if it oscillates below the resolution: more than 16384 closed curves, 4096 vertices
/// between neighbouring grid lines, 2^23 in all before thinning, or 2^25 cells of half the resolution near zeros.
Part traced_part(const std::string& name, const tracing::Shape& shape, const geometry::Frame& frame,
                 double resolution = 0);

} // namespace trime::shape
