// SPDX-License-Identifier: BSD-3-Clause
// Selects the smallest of many keys that are spread over the ranks.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/geometry/vec2.hpp"

#include <cstdint>
#include <span>

namespace trime::decomposition {

/// @brief Returns the key of a site for a selection. It rises with `value` (0..1 in steps of 2^-32, clamped); equal
/// values are ordered by a hash of the place. It is the same on every rank.
std::uint64_t selection_key(double value, geometry::Vec2 place);

/// @brief Returns the largest threshold with at most k keys below it, over all ranks. So `key < threshold` selects the
/// k smallest keys, or fewer where keys are equal. Collective: eight reductions of 256 counts. O(8 keys)
std::uint64_t selection_threshold(const comm::Communicator& comm, std::span<const std::uint64_t> keys, std::int64_t k);

} // namespace trime::decomposition
