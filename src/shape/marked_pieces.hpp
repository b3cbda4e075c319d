// SPDX-License-Identifier: BSD-3-Clause
// Transfers markers of the segments of contours to the pieces of the boundary.
#pragma once

#include "trime/geometry/boundary.hpp"
#include "trime/geometry/frame.hpp"
#include "trime/shape/part.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace trime::shape {

/// Returns whether any segment of these parts has a marker.
bool have_markers(std::span<const Part> parts);

/// @brief Gives pieces whose segment has a marker a separate part, see geometry::Domain.
/// @param parts the parts to which Piece::part refers; the boundary may have the domain behind them
/// @return the marker of each name of a part, 0 if it has no marker
std::vector<std::int32_t> name_markers(geometry::Boundary& boundary, std::span<const Part> parts,
                                       const geometry::Frame& frame);

} // namespace trime::shape
