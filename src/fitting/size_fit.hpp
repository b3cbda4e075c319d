// SPDX-License-Identifier: BSD-3-Clause
// The factor of the relative size, or the spacing of the lattice, that yields the points or the edge length asked for.
#pragma once

#include "fitting/layout.hpp"
#include "placing/lattice_start.hpp"

#include <string>

namespace trime::fitting {

/// A stage without inner sites, and the lattice spacing that goes with it.
struct LatticeFit {
  sites::Stage stage;
  double spacing = 1;
  placing::LatticeRuns runs; ///< of this rank with that spacing, if they were found on the way
  std::string shortage;      ///< why there will be fewer points than asked for; empty if not
};

/// @brief Uniform size. Boundary first, at a size estimated from area and perimeter; then the spacing at which the
/// lattice has as many sites as the boundary leaves. If it differs from the boundary's by more than 2 % (a boundary
/// full of corners takes more sites than its length says), the boundary is laid again at that spacing, twice at most.
/// Collective.
/// @throws ConfigError if the boundary alone needs more than the requested points at any size, or max_size does; if the
/// edge length is outside the bounds of the size
LatticeFit fit_lattice(const LayoutContext& context);

/// A stage without inner sites, and how many there should be.
struct DensityFit {
  FittedStage laid;
  double inner = 0;
  std::string shortage;
};

/// @brief Any size field: the layout at the largest number of points that is not above `points`, from the integral of
/// h^-2 over the shape outside the strip and the sites that the boundary really takes; with an edge length in the
/// options, at the factor whose mean edge has it. Collective. O(cells of the integral), about 10 / coarsening^2 a site
/// and round, 3 to 6 rounds.
/// @param coarsening of the integral
/// @throws ConfigError as fit_lattice; GeometryError if the size field is not positive and finite
DensityFit fit_density(const LayoutContext& context, double points, double coarsening);

} // namespace trime::fitting
