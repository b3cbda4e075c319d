// SPDX-License-Identifier: BSD-3-Clause
// Part of the result: the loops of the boundary of the mesh.
#pragma once

#include <cstdint>
#include <vector>

namespace trime::polygon {

/// A loop of the boundary of the mesh.
struct LoopSummary {
  enum class Kind { outer, hole, band };
  std::int32_t tag = 0;            ///< value of DistributedMesh::facet_tags for its edges
  Kind kind = Kind::outer;         ///< around a component, around a hole, or all around a periodic container
  std::int64_t edges = 0;          ///< number of mesh edges
  double length = 0;               ///< sum of the lengths of these edges
  std::vector<std::int32_t> parts; ///< values of DistributedMesh::facet_parts along the loop, each once
};

} // namespace trime::polygon
