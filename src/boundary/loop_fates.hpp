// SPDX-License-Identifier: BSD-3-Clause
// Which loops of the given boundary the meshed one follows, and how far it strays from them.
#pragma once

#include "trime/boundary/features.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/sizing/size_field.hpp"

#include <vector>

namespace trime::boundary {

/// @brief One for each loop of `given`, in its order. A meshed loop follows the given loops on which its vertices lie;
/// where none of them lies on one, the nearest.
///
/// Deviations are measured at vertices and at places a quarter of the size apart, at most 16 a piece.
/// O(n log n) for n pieces, O(n) where nothing changed; one thread. Local.
/// @param size that was asked for
/// @throws GeometryError if a size is not positive and finite
std::vector<LoopFate> find_loop_fates(const geometry::Boundary& given, const geometry::Boundary& meshed,
                                      const sizing::SizeField& size, const geometry::Lattice& lattice);

} // namespace trime::boundary
