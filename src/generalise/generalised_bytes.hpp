// SPDX-License-Identifier: BSD-3-Clause
// Packs simplified curves for other ranks.
#pragma once

#include "generalise/generalise.hpp"

#include <cstddef>
#include <vector>

namespace trime::generalise {

/// Packs the curves and their counts, for a machine of the same kind. O(pieces)
std::vector<std::byte> to_bytes(const Generalised& all);

/// Unpacks the result of to_bytes(). O(pieces)
/// @param given the boundary that was simplified, from which names of parts and periods are taken
Generalised generalised_of_bytes(std::vector<std::byte> bytes, const geometry::Boundary& given);

} // namespace trime::generalise
