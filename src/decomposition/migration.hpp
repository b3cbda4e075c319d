// SPDX-License-Identifier: BSD-3-Clause
// Sends sites that have left the tiles of their owner to their new owner.
#pragma once

#include "decomposition/partition.hpp"
#include "mesh/binned_points.hpp"
#include "trime/comm/communicator.hpp"

#include <vector>

namespace trime::decomposition {

/// @brief Counts the sites of each tile over all ranks. The counts are the weights of a partition. O(tiles) memory.
/// Collective.
std::vector<std::int64_t> tile_weights(const comm::Communicator& comm, const mesh::TileGrid& grid,
                                       std::span<const mesh::Site> sites);

/// @brief Fits the tiles of a grid to sites on any ranks: see mesh::fit_tiles. O(tiles) memory. Collective.
/// @return the weights of the tiles
std::vector<std::int64_t> fit_tiles(const comm::Communicator& comm, mesh::TileGrid& grid,
                                    std::span<const mesh::Site> sites);

/// @brief Sends every site to the owner of its tile. Sites that stay keep their order at the front of the list;
/// arrivals follow, ordered by sending rank. Collective.
void migrate(const comm::Communicator& comm, const mesh::TileGrid& grid, const Partition& partition,
             mesh::SiteList& sites);

} // namespace trime::decomposition
