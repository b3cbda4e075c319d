// SPDX-License-Identifier: BSD-3-Clause
// Sends values at the points of a local mesh from owners to ghosts, and back.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/handover/local_mesh.hpp"

#include <span>

namespace trime::handover {

/// @brief Gives each ghost the values of its owner, bit for bit.
/// @param values [local points x components], the components of a point side by side; only those of ghosts change
/// @note Collective. Each rank sends one message to each neighbour and receives one from each; it waits for no other
/// rank. O(shared points).
void update_ghosts(const comm::Communicator& comm, const LocalMesh& mesh, std::span<double> values, int components = 1);

/// @brief Adds the values of all ghosts to the values of their owners, one neighbour after the other in the order of
/// their ranks. The ghosts keep their values. The last bits of the sum depend on the number of ranks.
/// @param values [local points x components], as above; only those of owned points change
/// @note Collective, as update_ghosts.
void add_to_owners(const comm::Communicator& comm, const LocalMesh& mesh, std::span<double> values, int components = 1);

} // namespace trime::handover
