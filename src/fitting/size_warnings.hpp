// SPDX-License-Identifier: BSD-3-Clause
// Warnings about the size that a user can act on before the sweeps begin.
#pragma once

#include "sites/stage.hpp"
#include "trime/core/log.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"

namespace trime::fitting {

/// Warns of a size that changes by more than the way that it takes: triangles cannot follow. Asks the size field at
/// some 8000 places. @throws whatever the size field throws
void warn_of_steep_sizes(const sites::Stage& stage, const geometry::Boundary& boundary,
                         const geometry::Lattice& lattice, Log& log);

/// Warns of chords far shorter than the size, and says where. O(sites of the boundary).
/// @param has_least_size the user wants no smaller triangles at narrow parts: only many such chords are told
/// @throws whatever the size field throws
void warn_of_fine_features(const sites::Stage& stage, bool has_least_size, Log& log);

} // namespace trime::fitting
