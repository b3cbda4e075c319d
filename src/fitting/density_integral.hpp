// SPDX-License-Identifier: BSD-3-Clause
// How many sites a size asks for inside a shape.
#pragma once

#include "fitting/layout_context.hpp"
#include "placing/density_sampler.hpp"
#include "sites/stage.hpp"
#include "trime/comm/communicator.hpp"

namespace trime::fitting {

/// Sums over the cells of all tiles.
struct DensityTotals {
  double sites = 0;     ///< inner sites that the size field asks for
  double mean_size = 0; ///< mean of h over these sites
};
/// Collective. Threads over the tiles of this rank; integers inside.
/// @throws GeometryError as DensitySampler::for_each_cell, on all ranks together
DensityTotals integrate_density(const comm::Communicator& comm, const mesh::TileRange& tiles,
                                const placing::DensitySampler& sampler);

/// Inner sites that the size of a stage asks for. @param most_in_part see DensitySampler: with more they are not
/// counted to the end. Collective. @throws GeometryError as integrate_density
DensityTotals wanted_inside(const LayoutContext& context, const sites::Stage& stage, double coarsening,
                            double most_in_part);

} // namespace trime::fitting
