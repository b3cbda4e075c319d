// SPDX-License-Identifier: BSD-3-Clause
// The smallest of many keys that are spread over the ranks.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/geometry/vec2.hpp"

#include <cstdint>
#include <span>

namespace trime::decomposition {

/// @brief Key of a site for a selection: ascending in `value` (0..1 in steps of 2^-32, clamped), equal ones in the
/// order of a hash of the place. It is the same on every rank.
std::uint64_t selection_key(double value, geometry::Vec2 place);

/// @brief The largest threshold with at most k keys below it, over all ranks: `key < threshold` selects the k smallest
/// (fewer only where keys are equal). Collective: eight reductions of 256 counts. O(8 keys)
std::uint64_t selection_threshold(const comm::Communicator& comm, std::span<const std::uint64_t> keys, std::int64_t k);

} // namespace trime::decomposition
