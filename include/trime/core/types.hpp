// SPDX-License-Identifier: BSD-3-Clause
// Integer types by role. `int` is kept for ranks, threads and MPI counts.
#pragma once

#include <cstdint>

namespace trime {

using LocalIndex = std::int32_t; ///< index into an array of this rank
using GlobalId = std::int64_t;   ///< index into the whole mesh, all ranks together

} // namespace trime
