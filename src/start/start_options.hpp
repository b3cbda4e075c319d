// SPDX-License-Identifier: BSD-3-Clause
// What the start of a run goes by: where points come from, how many, and what may be left out of the boundary.
#pragma once

#include "trime/boundary/feature_options.hpp"
#include "trime/core/types.hpp"
#include "trime/geometry/vec2.hpp"
#include "trime/start/start_choice.hpp"

#include <cstdint>
#include <optional>

namespace trime::start {

/// See MeshOptions for the meaning of each; the defaults are there.
struct StartOptions {
  geometry::Box container;
  std::optional<int> cells_x, cells_y;
  std::optional<GlobalId> points; ///< exactly one of points and edge_length is set
  std::optional<double> edge_length;
  boundary::FeatureOptions features;
  std::uint64_t seed = 0;
  Start start = Start::automatic;
  std::optional<double> initial_fraction;
  std::optional<double> min_size, max_size;
  bool cleanup = false; ///< a clean-up follows, for which some points are kept back
};

} // namespace trime::start
