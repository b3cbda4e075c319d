// SPDX-License-Identifier: BSD-3-Clause
// Options of the stages of a run, which say how points get into the mesh.
#pragma once

#include "trime/start/start_choice.hpp"

#include <cstdint>
#include <optional>

namespace trime::start {

/// See MeshOptions for the meaning and the default of each option.
struct StartOptions {
  std::uint64_t seed = 0;
  Start start = Start::automatic;
  std::optional<double> initial_fraction;
  bool cleanup = false; ///< a clean-up follows, for which some points are held back
};

} // namespace trime::start
