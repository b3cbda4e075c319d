// SPDX-License-Identifier: BSD-3-Clause
// Finds the boundary of a uniform size, and the spacing of the lattice that yields the points or the edge length asked
// for.
#pragma once

#include "fitting/few_points.hpp"
#include "fitting/layout.hpp"
#include "placing/lattice_start.hpp"

#include <string>
#include <variant>

namespace trime::fitting {

/// A stage without inner sites, and its lattice spacing.
struct LatticeFit {
  sites::Stage stage;
  double spacing = 1;
  placing::LatticeRuns runs; ///< runs of this rank with that spacing, if they were found on the way
  std::string shortage;      ///< why there will be fewer points than asked for; empty if not
  FittedSize fitted;         ///< by which the stage was laid
};

/// @brief Lays the boundary first, at a size estimated from area and perimeter. Then finds the spacing at which the
/// lattice has as many sites as the boundary leaves. If it differs from the boundary's by more than 2 % (a boundary
/// full of corners takes more sites than its length says), the boundary is laid again at that spacing, twice at most.
/// If simplified curves need smaller triangles in narrow parts, the lattice is of no use: it is not looked for any
/// further, and `fitted` gets the factor from which a search for a graded size should begin. With an edge length the
/// boundary is laid once, at that size. Collective.
/// @return too few points if the boundary alone needs more than those at any size, or max_size does
/// @throws ConfigError if the edge length is outside the bounds of the size
std::variant<LatticeFit, TooFewPoints> fit_lattice(const LayoutContext& context);

} // namespace trime::fitting
