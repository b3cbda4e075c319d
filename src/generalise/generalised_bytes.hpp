// SPDX-License-Identifier: BSD-3-Clause
// Generalised curves on their way to other ranks.
#pragma once

#include "generalise/generalise.hpp"

#include <cstddef>
#include <vector>

namespace trime::generalise {

/// The curves and their counts, for a machine of the same kind. O(pieces)
std::vector<std::byte> to_bytes(const Generalised& all);

/// Unpacks the result of to_bytes(). O(pieces)
/// @param given the boundary that was generalised: names of parts and periods are its own
Generalised generalised_of_bytes(std::vector<std::byte> bytes, const geometry::Boundary& given);

} // namespace trime::generalise
