// SPDX-License-Identifier: BSD-3-Clause
// Divides a piece of a curve, and turns it round.
#pragma once

#include "trime/geometry/boundary.hpp"
#include "trime/geometry/vec2.hpp"

#include <array>

namespace trime::geometry {

/// Returns the part of a piece before p, and the part after it, which begins with a corner. @pre p lies on the piece
std::array<Piece, 2> divided(const Piece& piece, Vec2 p);
/// Returns the piece in the other direction.
Piece reversed(Piece piece);

} // namespace trime::geometry
