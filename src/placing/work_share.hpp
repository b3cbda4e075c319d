// SPDX-License-Identifier: BSD-3-Clause
// Distributes the work of making sites over the ranks by estimated numbers of sites, before the sites exist.
#pragma once

#include "mesh/tile_grid.hpp"
#include "sites/stage.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/sizing/size_field.hpp"

#include <cstdint>
#include <vector>

namespace trime::placing {

/// @brief Divides the tiles of a stage until all will hold about the same number of sites, estimated by the size at the
/// centres of their quarters, and distributes the tiles over the ranks. The distribution decides only which rank does
/// which work; no number of sites depends on it, except a number for which the sampling ends early (DensitySampler).
/// The tiles do not depend on the ranks. Memory: O(tiles). Collective.
/// @pre the stage has no sites
/// @param size size field for the future sites
/// @param grid_coarsening see fitting::complete
void share_by_density(sites::Stage& stage, const sizing::SizeField& size, const geometry::Lattice& lattice,
                      double grid_coarsening);

/// @brief Divides and distributes the tiles by the actual numbers of sites in the tiles, including boundary sites. The
/// tiles are then those of SiteState::distribute, so few sites must be sent to another rank after they are made.
/// Memory: O(tiles). Collective.
/// @param inside number of inner sites in each tile of own_share()
/// @return false if a tile was divided; then the caller must count the sites in its quarters. Because levels are
/// bounded, repeated calls end
bool share_by_count(sites::Stage& stage, std::vector<std::int64_t> inside);

/// Returns the tiles in which this rank makes sites.
mesh::TileRange own_share(const sites::Stage& stage);

} // namespace trime::placing
