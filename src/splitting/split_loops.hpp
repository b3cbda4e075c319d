// SPDX-License-Identifier: BSD-3-Clause
// Finds the boundary loops of a mesh whose curves were split: around cracks there are new ones, and a crack that meets
// the boundary changes those that it meets.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/mesh/distributed_mesh.hpp"
#include "trime/polygon/loop_summary.hpp"

#include <map>
#include <set>
#include <vector>

namespace trime::splitting {

/// The loops after the split.
struct SplitLoops {
  std::vector<polygon::LoopSummary> loops; ///< ascending by tag
  /// Tags of the loops to which the edges of each loop belong now, by its old tag. Loops without change are not listed.
  std::map<std::int32_t, std::set<std::int32_t>> new_tags;
};

/// @brief Finds the loops, and sets `facet_tags` and `boundary` of the mesh. A loop without a side of a split curve is
/// not changed. Another loop keeps the lowest tag of its edges that no other loop has, or gets the next free one. Every
/// rank knows all boundary edges meanwhile: 48 bytes each. Cost: O(facets log facets). Collective.
/// @param parts number of parts of the shape; facets with this part or a higher one are sides of split curves
/// @param before the loops before the split
SplitLoops find_split_loops(const comm::Communicator& comm, mesh::DistributedMesh& mesh, std::int32_t parts,
                            const std::vector<polygon::LoopSummary>& before);

} // namespace trime::splitting
