// SPDX-License-Identifier: BSD-3-Clause
// What the kernels of a sweep are told of the sites of a rank.
#pragma once

#include "meshing/guard_treatment.hpp"
#include "meshing/site_classes.hpp"
#include "meshing/site_state.hpp"
#include "meshing/sweep_kernel.hpp"

namespace trime::meshing {

/// All but the rule. It points into its arguments, and holds until sites are sorted or ghosts are fetched; next places
/// and leads are null before BinnedPoints::prepare_advance.
SweepTask make_sweep_task(SiteState& state, const delaunay::StarBuilder& builder, const MoveContext& context,
                          const SiteClasses& classes);

} // namespace trime::meshing
