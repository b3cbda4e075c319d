// SPDX-License-Identifier: BSD-3-Clause
// Finds out which loops of the given boundary the meshed boundary follows, and how far it deviates from them.
#pragma once

#include "trime/boundary/features.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/sizing/size_field.hpp"

#include <vector>

namespace trime::boundary {

/// @brief Returns the fate of each loop of `given`, in their order. A meshed loop follows the given loops on which its
/// vertices lie; if no vertex lies on a given loop, it follows the nearest one.
///
/// Deviations are measured at vertices and at places that are a quarter of the size apart, at most 16 per piece. Cost:
/// O(n log n) for n pieces, O(n) if nothing changed; uses one thread. Does not communicate.
/// @param size the size that the user asked for
/// @throws GeometryError if a size is not positive and finite
std::vector<LoopFate> find_loop_fates(const geometry::Boundary& given, const geometry::Boundary& meshed,
                                      const sizing::SizeField& size, const geometry::Lattice& lattice);

} // namespace trime::boundary
