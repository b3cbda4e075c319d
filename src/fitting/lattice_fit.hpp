// SPDX-License-Identifier: BSD-3-Clause
// Finds the boundary sites for a uniform size, and the spacing of the lattice that yields the number of points or the
// edge length asked for.
#pragma once

#include "fitting/few_points.hpp"
#include "fitting/layout.hpp"
#include "placing/lattice_start.hpp"

#include <string>
#include <variant>

namespace trime::fitting {

/// A stage without inner sites, and the spacing of the lattice for its inner sites.
struct LatticeFit {
  sites::Stage stage;
  double spacing = 1;
  placing::LatticeRuns runs; ///< runs of this rank with that spacing, if they were found on the way
  std::string shortage;      ///< why there will be fewer points than asked for; empty if there will not
  FittedSize fitted;         ///< the size with which the stage was laid out
};

/// @brief First lays out the boundary, at a size estimated from area and perimeter. Then finds the spacing at which the
/// lattice has as many sites as the points asked for minus the boundary sites. If spacing and size of the boundary
/// differ by more than 2 % (many corners take more sites than the length of the boundary says), the boundary is laid
/// out again at that spacing, at most twice. If curves after simplification need smaller triangles in narrow parts, a
/// lattice does not fit. Then the search ends, and `fitted` gets the factor from which the search for a graded size
/// should begin. If the options set an edge length, the boundary is laid out once, at that size. Collective.
/// @return TooFewPoints if the boundary alone needs more points than were asked for at any size, or at max_size
/// @throws ConfigError if the edge length is below min_size or above max_size
std::variant<LatticeFit, TooFewPoints> fit_lattice(const LayoutContext& context);

/// @brief Returns the runs of the smallest spacing found whose lattice has at most `wanted` sites. The search begins at
/// the spacing h. All ranks take the same steps. Collective.
placing::LatticeRuns fitting_runs(const LayoutContext& context, const sites::Stage& stage,
                                  const placing::LatticeStart& start, double h, GlobalId wanted);

} // namespace trime::fitting
