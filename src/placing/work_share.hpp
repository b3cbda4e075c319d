// SPDX-License-Identifier: BSD-3-Clause
// Decides which rank makes which sites, from weights, before there are sites.
#pragma once

#include "mesh/tile_grid.hpp"
#include "sites/stage.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/sizing/size_field.hpp"

#include <cstdint>
#include <vector>

namespace trime::placing {

/// @brief Divides the tiles of a stage without sites until all want about equally many, by the size in the middle of
/// their quarters, and shares them out over the ranks. No count depends on it but one that ends early (DensitySampler),
/// only who does what. The tiles are the same on any ranks. O(tiles) memory. Collective.
/// @param size that the sites will follow @param grid_coarsening see complete()
void share_by_density(sites::Stage& stage, const sizing::SizeField& size, const geometry::Lattice& lattice,
                      double grid_coarsening);

/// @brief Does the same with the sites that will really be in the tiles, so that hardly any must go to another rank
/// after they are made: gives the tiles of SiteState::distribute. Counts sites on the boundary, too. O(tiles) memory.
/// Collective.
/// @param inside the other sites in each tile of own_share
/// @return false if a tile was divided: what lies in its quarters is to be counted. Levels are bounded, so this ends
bool share_by_count(sites::Stage& stage, std::vector<std::int64_t> inside);

/// The tiles that this rank fills with sites.
mesh::TileRange own_share(const sites::Stage& stage);

} // namespace trime::placing
