// SPDX-License-Identifier: BSD-3-Clause
// Markers of a contour's segments on the pieces of the boundary that follow them.
#pragma once

#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/shape/part.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace trime::shape {

/// Has any segment of these parts a marker?
bool have_markers(std::span<const Part> parts);

/// @brief Gives pieces whose segment has a marker a part of their own, see geometry::Domain.
/// @param parts those that Piece::part names; the boundary may have the domain behind them
/// @return the marker of each name of a part, 0 for none
std::vector<std::int32_t> name_markers(geometry::Boundary& boundary, std::span<const Part> parts,
                                       const geometry::Frame& frame);

} // namespace trime::shape
