// SPDX-License-Identifier: BSD-3-Clause
// How long a run will still take, for the eyes of a person: from the history that this rank has. Steers nothing.
#pragma once

#include "meshing/relaxation.hpp"
#include "sweep/sweep_options.hpp"

#include <span>

namespace trime::meshing {

/// @brief Seconds to the end of the run, about: sweeps of this stage until its gains fall below the tolerance, if they
/// fall as a power of the number of sweeps; usual numbers for all that follows. Within a factor of two or three.
/// @return negative where nothing is known: before the second record of a stage
double seconds_left(std::span<const sweep::SweepRecord> history, const StageNumber& stage,
                    const sweep::SweepOptions& options);

} // namespace trime::meshing
