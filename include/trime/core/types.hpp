// SPDX-License-Identifier: BSD-3-Clause
// Integer types by role. `int` is for ranks, threads and MPI counts.
#pragma once

#include <cstddef>
#include <cstdint>

namespace trime {

using LocalIndex = std::int32_t; ///< index into an array of this rank
using GlobalId = std::int64_t;   ///< index into the whole mesh, all ranks together

/// Converts a local index to the index type of standard containers. @pre i >= 0
constexpr std::size_t at(LocalIndex i) {
  return static_cast<std::size_t>(i);
}

} // namespace trime
