// SPDX-License-Identifier: BSD-3-Clause
// Warnings about the size that a user can act on before the sweeps begin.
#pragma once

#include "fitting/layout.hpp"
#include "sites/stage.hpp"
#include "trime/core/log.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"

#include <vector>

namespace trime::fitting {

/// Warns of a size whose slope is above 1, because triangles cannot change their size so quickly. Evaluates the size
/// field at about 8000 places. @throws the errors of the size field
void warn_of_steep_sizes(const sites::Stage& stage, const geometry::Boundary& boundary,
                         const geometry::Lattice& lattice, Log& log);

/// Warns of a size that was lowered at places because it grows by more than `gradation` per length.
void warn_of_lowered_growth(const SteepPlaces& steep, double gradation, Log& log);

/// Warns of a size that was raised so that no edge is shorter than `shortest_edge`. @throws the errors of the size
/// field
void warn_of_raised_sizes(const sites::Stage& stage, const std::vector<sizing::LeastSize>& raised, double shortest_edge,
                          Log& log);

/// Warns of boundary edges far shorter than the size, and names a place. Cost: O(sites of the boundary).
/// @param has_least_size whether the user has set a smallest size for narrow parts; then the function warns only of
/// many such edges @throws the errors of the size field
void warn_of_fine_features(const sites::Stage& stage, bool has_least_size, Log& log);

} // namespace trime::fitting
