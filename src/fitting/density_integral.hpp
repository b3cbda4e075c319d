// SPDX-License-Identifier: BSD-3-Clause
// Computes how many sites inside a shape a size field asks for.
#pragma once

#include "fitting/layout_context.hpp"
#include "placing/density_sampler.hpp"
#include "sites/stage.hpp"
#include "trime/comm/communicator.hpp"

namespace trime::fitting {

/// Sums over the cells of all tiles on all ranks.
struct DensityTotals {
  double sites = 0;     ///< inner sites that the size field asks for
  double mean_size = 0; ///< mean of h over these sites
};
/// Returns the totals over all ranks. Collective. Threads share the tiles of this rank. The sums are computed with
/// integers, so they do not depend on their order.
/// @throws GeometryError on all ranks together, see DensitySampler::for_each_cell
DensityTotals integrate_density(const comm::Communicator& comm, const mesh::TileRange& tiles,
                                const placing::DensitySampler& sampler);

/// Returns how many inner sites the size of a stage asks for. Collective. @param most_in_part counting ends at this
/// number, see DensitySampler @throws GeometryError, see integrate_density
DensityTotals wanted_inside(const LayoutContext& context, const sites::Stage& stage, double coarsening,
                            double most_in_part);

} // namespace trime::fitting
