// SPDX-License-Identifier: BSD-3-Clause
// What the clean-up of the worst triangles did.
#pragma once

#include <cstdint>

namespace trime::cleanup {

/// What the clean-up of the worst triangles did, over all ranks.
struct CleanupCounts {
  std::int64_t patches = 0;                          ///< surroundings of bad triangles on which changes were tried
  std::int64_t better = 0;                           ///< of these kept
  std::int64_t moved = 0, inserted = 0, deleted = 0; ///< sites in what was kept; a site may move more than once
  std::int64_t on_boundary = 0;                      ///< of these sites, those on the boundary
  std::int64_t left = 0;                             ///< bad places where nothing helped
};

} // namespace trime::cleanup
