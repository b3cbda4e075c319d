// SPDX-License-Identifier: BSD-3-Clause
// Finds the boundary of a uniform size, and the spacing of the lattice that yields the points or the edge length asked
// for.
#pragma once

#include "fitting/few_points.hpp"
#include "placing/lattice_start.hpp"

#include <string>
#include <variant>

namespace trime::fitting {

/// A stage without inner sites, and its lattice spacing.
struct LatticeFit {
  sites::Stage stage;
  double spacing = 1;
  placing::LatticeRuns runs; ///< runs of this rank with that spacing, if they are known already
  std::string shortage;      ///< why there will be fewer points than asked for, or empty
};

/// @brief Lays the boundary first, at a size estimated from area and perimeter. Then finds the spacing at which the
/// lattice has as many sites as the boundary leaves. If it differs from the spacing of the boundary by more than 2 %,
/// the boundary is laid again at that spacing, at most twice; this happens if a boundary full of corners needs more
/// sites than its length suggests. With an edge length, the boundary is laid once at that size. Collective.
/// @return TooFewPoints if the boundary alone, or max_size, needs more points at any size
/// @throws ConfigError if the edge length is outside the bounds of the size
std::variant<LatticeFit, TooFewPoints> fit_lattice(const LayoutContext& context);

} // namespace trime::fitting
