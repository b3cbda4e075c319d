// SPDX-License-Identifier: BSD-3-Clause
// Selects the k smallest of many keys that are distributed over the ranks.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/geometry/vec2.hpp"

#include <cstdint>
#include <span>

namespace trime::decomposition {

/// @brief Returns the key of a site for a selection. The key increases with `value` (0..1 in steps of 2^-32; other
/// values are clamped); a hash of the place orders equal values. The key is the same on every rank.
std::uint64_t selection_key(double value, geometry::Vec2 place);

/// @brief Returns the largest threshold such that at most k keys over all ranks are below it. So `key < threshold`
/// selects the k smallest keys, or fewer if some keys are equal. Collective: eight reductions of 256 counts. Cost:
/// eight passes over the keys.
std::uint64_t selection_threshold(const comm::Communicator& comm, std::span<const std::uint64_t> keys, std::int64_t k);

} // namespace trime::decomposition
