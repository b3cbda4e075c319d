// SPDX-License-Identifier: BSD-3-Clause
// Generalised curves on their way to other ranks.
#pragma once

#include "generalise/generalise.hpp"

#include <string>

namespace trime::generalise {

/// The curves and their counts, for a machine of the same kind. O(pieces)
std::string to_bytes(const Generalised& all);

/// What to_bytes() has packed. O(pieces)
/// @param given the boundary that was generalised: names of parts and periods are its own
Generalised generalised_of_bytes(const std::string& bytes, const geometry::Boundary& given);

} // namespace trime::generalise
