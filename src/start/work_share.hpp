// SPDX-License-Identifier: BSD-3-Clause
// Who makes which sites: weights before sites.
#pragma once

#include "mesh/tile_range.hpp"
#include "sites/stage.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/sizing/size_field.hpp"

namespace trime::start {

/// @brief Divides the tiles of a stage without sites until all want about equally many, by the size in the middle of
/// their quarters, and shares them out over the ranks. No result depends on it, only who does what. The tiles are the
/// same on any ranks. O(tiles) memory. Collective.
/// @param size that the sites will follow @param grid_coarsening see complete()
void share_by_density(sites::Stage& stage, const sizing::SizeField& size, const geometry::Lattice& lattice,
                      double grid_coarsening);

/// The tiles that this rank fills with sites.
mesh::TileRange own_share(const sites::Stage& stage);

} // namespace trime::start
