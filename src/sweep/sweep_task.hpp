// SPDX-License-Identifier: BSD-3-Clause
// Prepares the input of the sweep kernels from the sites of a rank.
#pragma once

#include "sites/site_state.hpp"
#include "sweep/guard_treatment.hpp"
#include "sweep/site_classes.hpp"
#include "sweep/sweep_kernel.hpp"

namespace trime::sweep {

/// Makes the input of the kernels except for the update rule. The result points into the arguments, and is valid until
/// sites are sorted or ghosts are fetched. The pointers to next places and leads are null before
/// BinnedPoints::prepare_advance is called.
SweepTask make_sweep_task(sites::SiteState& state, const delaunay::StarBuilder& builder, const MoveContext& context,
                          const SiteClasses& classes);

} // namespace trime::sweep
