// SPDX-License-Identifier: BSD-3-Clause
// The loops of the boundary as the mesh has them: a part of the result.
#pragma once

#include <cstdint>
#include <vector>

namespace trime::polygon {

/// A loop of the boundary as the mesh has it.
struct LoopSummary {
  enum class Kind { outer, hole, band };
  std::int32_t tag = 0;            ///< DistributedMesh::facet_tags of its edges
  Kind kind = Kind::outer;         ///< around a component, around a hole, or all around a periodic container
  std::int64_t edges = 0;          ///< of the mesh
  double length = 0;               ///< sum of the lengths of these edges
  std::vector<std::int32_t> parts; ///< DistributedMesh::facet_parts of its edges: each once, in order along the loop
};

} // namespace trime::polygon
