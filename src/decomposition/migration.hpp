// SPDX-License-Identifier: BSD-3-Clause
// Sends sites that have left the tiles of their owner to the rank that owns their new tile.
#pragma once

#include "decomposition/partition.hpp"
#include "mesh/binned_points.hpp"
#include "trime/comm/communicator.hpp"

#include <vector>

namespace trime::decomposition {

/// @brief Counts the sites of each tile over all ranks. The counts are the weights with which tiles are distributed
/// over ranks. Memory: O(tiles). Collective.
std::vector<std::int64_t> tile_weights(const comm::Communicator& comm, const mesh::TileGrid& grid,
                                       std::span<const mesh::Site> sites);

/// @brief Fits the tiles of a grid to sites that are spread over the ranks, as mesh::fit_tiles does. Memory: O(tiles).
/// Collective.
/// @return the weight of each tile, which is its number of sites
std::vector<std::int64_t> fit_tiles(const comm::Communicator& comm, mesh::TileGrid& grid,
                                    std::span<const mesh::Site> sites);

/// @brief Sends every site to the owner of its tile. Sites that stay keep their order at the front of the list;
/// arriving sites follow, ordered by the rank that sent them. Collective.
void migrate(const comm::Communicator& comm, const mesh::TileGrid& grid, const Partition& partition,
             mesh::SiteList& sites);

} // namespace trime::decomposition
