// SPDX-License-Identifier: BSD-3-Clause
// Estimates how long a run will still take, from the history that this rank has. People read the estimate; it has no
// effect on the run.
#pragma once

#include "meshing/relaxation.hpp"
#include "sweep/sweep_options.hpp"

#include <span>

namespace trime::meshing {

/// @brief Returns about how many seconds the run will still take, to within a factor of two or three. It assumes that
/// the gains of this stage fall as a power of the number of sweeps until they are below the tolerance, and uses typical
/// numbers for all that follows.
/// @return a negative number before the second record of a stage, when nothing is known
double seconds_left(std::span<const sweep::SweepRecord> history, const StageNumber& stage,
                    const sweep::SweepOptions& options);

} // namespace trime::meshing
