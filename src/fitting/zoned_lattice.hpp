// SPDX-License-Identifier: BSD-3-Clause
// Fits a lattice to a size that is uniform except in zones in which the boundary lowers it.
#pragma once

#include "fitting/layout.hpp"
#include "fitting/stage_fit.hpp"
#include "placing/hilbert_start.hpp"
#include "placing/lattice_start.hpp"
#include "placing/lowered_zones.hpp"

#include <cstdint>
#include <memory>
#include <optional>

namespace trime::fitting {

/// A stage without inner sites, and the places of these sites: on a lattice, and along the Hilbert curve in the zones.
struct ZonedLattice {
  sites::Stage stage;
  FittedSize fitted;                                        ///< the size with which the stage was laid out
  std::unique_ptr<const placing::LoweredZones> zones;       ///< in them the boundary lowers the size
  placing::LatticeRuns runs;                                ///< runs of this rank outside of the zones
  std::unique_ptr<const placing::HilbertStart> along_curve; ///< places in the zones
  std::int64_t in_zones = 0;                                ///< number of sites in the zones
};

/// @brief Finds the spacing at which a lattice outside of the zones, and the sites that the size asks for in the zones,
/// together have as many sites as wanted. If spacing and uniform size differ by more than 2 %, the boundary is laid out
/// again at a size between both, a few times. Collective.
/// @param fitted the size that the search for a graded size has found @param fit the result of that search; its stage
/// gets an empty container grid for the expected points, and may only be used further if nothing is returned
/// @param expected number of all points; if the options set no points, the spacing is the uniform size
/// @return nothing if the size is not uniform elsewhere, the zones have too large a share of the sites, too few sites
/// fit on the lattice, or no spacing near the size is found
/// @throws GeometryError as lay_stage, on all ranks together
std::optional<ZonedLattice> fit_zoned_lattice(const LayoutContext& context, const FittedSize& fitted, StageFit& fit,
                                              double expected);

} // namespace trime::fitting
