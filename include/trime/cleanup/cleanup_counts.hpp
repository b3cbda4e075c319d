// SPDX-License-Identifier: BSD-3-Clause
// Counts how many of the worst triangles the clean-up of a mesh has tried to improve, and with what result.
#pragma once

#include <cstdint>

namespace trime::cleanup {

/// Counts of the clean-up, summed over all ranks.
struct CleanupCounts {
  std::int64_t patches = 0; ///< neighbourhoods of bad triangles in which the clean-up tried changes
  std::int64_t better = 0;  ///< patches in which a change improved the mesh and was kept
  std::int64_t moved = 0, inserted = 0,
               deleted = 0; ///< sites that kept changes moved, inserted or deleted; a site may be moved several times
  std::int64_t on_boundary = 0; ///< how many of the moved, inserted and deleted sites are on the boundary
  std::int64_t left = 0;        ///< bad triangles that no change improved
};

} // namespace trime::cleanup
