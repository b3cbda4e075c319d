// SPDX-License-Identifier: BSD-3-Clause
// Values at the points of a local mesh, brought from owners to ghosts and back.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/handover/local_mesh.hpp"

#include <span>

namespace trime::handover {

/// @brief Gives each ghost the values of its owner, bit for bit.
/// @param values [local points x components], the components of a point side by side; only those of ghosts change
/// @note Collective. One message to each neighbour and one from each; others are not waited for. O(shared points).
void update_ghosts(const comm::Communicator& comm, const LocalMesh& mesh, std::span<double> values, int components = 1);

/// @brief Adds the values of all ghosts to those of their owners, neighbour after neighbour by rank. The ghosts keep
/// theirs. The sum depends on the number of ranks in its last bits, as sums of shares do.
/// @param values [local points x components], as above; only those of owned points change
/// @note Collective, as update_ghosts.
void add_to_owners(const comm::Communicator& comm, const LocalMesh& mesh, std::span<double> values, int components = 1);

} // namespace trime::handover
