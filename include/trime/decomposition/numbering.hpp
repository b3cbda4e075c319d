// SPDX-License-Identifier: BSD-3-Clause
// The canonical numbering of the mesh: points along the Hilbert curve, whatever ranks own them.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/decomposition/halo.hpp"
#include "trime/mesh/binned_points.hpp"

#include <vector>

namespace trime::decomposition {

struct Numbering {
  GlobalId first = 0;               ///< global id of the first owned point in canonical order
  GlobalId total = 0;               ///< points of the whole mesh
  std::vector<LocalIndex> order;    ///< owned local indices in canonical order
  std::vector<GlobalId> global_ids; ///< by local index, owned and ghosts
};

/// @brief Numbers the sites by the Hilbert key of their coordinates, ties lexicographic. Because ranks own ascending
/// ranges of the same curve, this is one scan and a sort inside each tile. @pre the halo of `points` is fresh.
/// Collective.
Numbering canonical_numbering(const comm::Communicator& comm, const mesh::BinnedPoints& points, const Halo& halo);

} // namespace trime::decomposition
