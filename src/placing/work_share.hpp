// SPDX-License-Identifier: BSD-3-Clause
// Decides from weights which rank makes which sites, before there are sites.
#pragma once

#include "mesh/tile_grid.hpp"
#include "sites/stage.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/sizing/size_field.hpp"

#include <cstdint>
#include <vector>

namespace trime::placing {

/// @brief Divides the tiles of a stage until all should hold about equally many sites, by the size in the middle of
/// their quarters, and distributes them over the ranks. This decides only which rank does what; no number of sites
/// depends on it, except one that ends early (DensitySampler). The tiles do not depend on the ranks. O(tiles) memory.
/// Collective. @pre the stage has no sites
/// @param size the size of the future sites @param grid_coarsening see complete()
void share_by_density(sites::Stage& stage, const sizing::SizeField& size, const geometry::Lattice& lattice,
                      double grid_coarsening);

/// @brief As share_by_density, but with the actual numbers of sites in the tiles, including those on the boundary. It
/// gives the tiles of SiteState::distribute, so hardly any site must be sent to another rank after it is made. O(tiles)
/// memory. Collective.
/// @param inside number of inner sites in each tile of own_share
/// @return false if a tile was divided; then the sites in its quarters must be counted. Levels are bounded, so this
/// ends
bool share_by_count(sites::Stage& stage, std::vector<std::int64_t> inside);

/// Returns the tiles that this rank fills with sites.
mesh::TileRange own_share(const sites::Stage& stage);

} // namespace trime::placing
