// SPDX-License-Identifier: BSD-3-Clause
// Summary of the loops (closed curves) of the boundary of a mesh. Part of the result of a run.
#pragma once

#include <cstdint>
#include <vector>

namespace trime::polygon {

/// A loop of the boundary of the mesh.
struct LoopSummary {
  enum class Kind { outer, hole, band };
  std::int32_t tag = 0;    ///< tag of the loop's edges in DistributedMesh::facet_tags
  Kind kind = Kind::outer; ///< outer: around a component; hole: around a hole; band: all around a periodic container
  std::int64_t edges = 0;  ///< number of mesh edges
  double length = 0;       ///< sum of the lengths of these edges
  std::vector<std::int32_t>
      parts; ///< the parts of the shape along the loop, as in DistributedMesh::facet_parts, each once
};

} // namespace trime::polygon
