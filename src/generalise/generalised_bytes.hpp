// SPDX-License-Identifier: BSD-3-Clause
// Packs simplified curves into bytes, to send them to other ranks.
#pragma once

#include "generalise/generalise.hpp"

#include <cstddef>
#include <vector>

namespace trime::generalise {

/// Packs the curves and the counts of changes, for machines of the same kind. Cost: O(pieces).
std::vector<std::byte> to_bytes(const Generalised& all);

/// Unpacks the result of to_bytes(). Cost: O(pieces).
/// @param given the boundary that was simplified; names of parts and periods are taken from it
Generalised generalised_of_bytes(std::vector<std::byte> bytes, const geometry::Boundary& given);

} // namespace trime::generalise
