// SPDX-License-Identifier: BSD-3-Clause
// Finds whether pieces of curves cross or touch each other.
#pragma once

#include "trime/geometry/boundary.hpp"

namespace trime::generalise {

/// Returns whether a straight piece meets another one outside of a common end, or runs along it. Exact for straight
/// pieces; arcs of circles are compared as chords that turn by less than three degrees.
bool meet(const geometry::Piece& straight, const geometry::Piece& other);

} // namespace trime::generalise
