// SPDX-License-Identifier: BSD-3-Clause
// Coarser copies of curves, for distances from places that are far away.
#pragma once

#include "trime/geometry/boundary.hpp"

#include <vector>

namespace trime::sizing {

/// @brief Replaces runs of straight pieces by single pieces. Every point of the result lies within `deviation` of the
/// given curves, and every point of the given curves lies within `deviation` of the result. Arcs stay as they are.
/// @param pieces curves in the order in which they follow each other; a piece that does not start where the one before
/// it ends begins a new curve
/// @return O(M) pieces for M given ones, in their order. Cost: O(M log M)
std::vector<geometry::Piece> coarse_curves(const std::vector<geometry::Piece>& pieces, double deviation);

} // namespace trime::sizing
