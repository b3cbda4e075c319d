// SPDX-License-Identifier: BSD-3-Clause
// Part of the result: what the clean-up of the worst triangles did.
#pragma once

#include <cstdint>

namespace trime::cleanup {

/// Counts of the clean-up, summed over all ranks.
struct CleanupCounts {
  std::int64_t patches = 0;                          ///< surroundings of bad triangles on which changes were tried
  std::int64_t better = 0;                           ///< patches where a change was kept
  std::int64_t moved = 0, inserted = 0, deleted = 0; ///< sites in kept changes; a site may move several times
  std::int64_t on_boundary = 0;                      ///< number of these sites that are on the boundary
  std::int64_t left = 0;                             ///< bad places that no change improved
};

} // namespace trime::cleanup
