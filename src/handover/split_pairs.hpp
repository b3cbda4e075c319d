// SPDX-License-Identifier: BSD-3-Clause
// Gives the pairs of points on split curves to the ranks that own the points.
#pragma once

#include "trime/handover/local_mesh.hpp"

namespace trime::handover {

/// Sets the arrays of pairs of a local mesh. Collective, with one sparse exchange if there are pairs.
void share_split_pairs(const comm::Communicator& comm, const mesh::DistributedMesh& mesh, LocalMesh& made);

} // namespace trime::handover
