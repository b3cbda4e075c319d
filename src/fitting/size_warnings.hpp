// SPDX-License-Identifier: BSD-3-Clause
// Warnings about the size that a user can act on before the sweeps begin.
#pragma once

#include "sites/stage.hpp"
#include "trime/core/log.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"

namespace trime::fitting {

/// Warns of a size whose slope is above 1, which triangles cannot follow. Evaluates the size field at about 8000
/// places. @throws the errors of the size field
void warn_of_steep_sizes(const sites::Stage& stage, const geometry::Boundary& boundary,
                         const geometry::Lattice& lattice, Log& log);

/// Warns of chords far shorter than the size, with a place. O(sites of the boundary).
/// @param has_least_size true if the user wants no smaller triangles at narrow parts; then it warns only of many such
/// chords @throws the errors of the size field
void warn_of_fine_features(const sites::Stage& stage, bool has_least_size, Log& log);

} // namespace trime::fitting
