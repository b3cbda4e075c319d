// SPDX-License-Identifier: BSD-3-Clause
// Options of the stages of a run: how the points come into the mesh.
#pragma once

#include "trime/start/start_choice.hpp"

#include <cstdint>
#include <optional>

namespace trime::start {

/// See MeshOptions for the meaning of each; the defaults are there.
struct StartOptions {
  std::uint64_t seed = 0;
  Start start = Start::automatic;
  std::optional<double> initial_fraction;
  bool cleanup = false; ///< a clean-up follows, for which some points are kept back
};

} // namespace trime::start
