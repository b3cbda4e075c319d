// SPDX-License-Identifier: BSD-3-Clause
// Lists all edges of a mesh that have a label: those on the boundary, on curves inside, and between regions.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/mesh/distributed_mesh.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace trime::io {

/// @brief One rank's part of the list of edges with labels. Facets come first, in their order, then edges on curves,
/// then those edges between regions that lie on no curve, so each edge stands in the list once.
struct LabelledLines {
  mesh::Slab slab;
  std::vector<std::array<GlobalId, 2>> ends;
  std::vector<std::int32_t> labels; ///< a part k of the boundary has the label k + 1; curves follow, then interfaces
};

/// @brief Lists the edges. The list depends on the mesh alone, not on the number of ranks. Rows stay on their ranks if
/// all of them are facets; otherwise each rank gets an equal share. Cost: O(labelled edges).
/// @param parts, curves number of names of parts of the boundary, and of curves
/// @note Collective.
LabelledLines labelled_lines(const mesh::DistributedMesh& mesh, std::size_t parts, std::size_t curves,
                             const comm::Communicator& comm);

} // namespace trime::io
