// SPDX-License-Identifier: BSD-3-Clause
// What the fit of the size goes by: how many points or which edge length, within which limits, and what of the boundary
// may be left out.
#pragma once

#include "trime/boundary/features.hpp"
#include "trime/core/types.hpp"

#include <optional>

namespace trime::fitting {

/// See MeshOptions for the meaning of each; the defaults are there.
struct FitOptions {
  std::optional<int> cells_x, cells_y;
  std::optional<GlobalId> points; ///< exactly one of points and edge_length is set
  std::optional<double> edge_length;
  boundary::FeatureOptions features;
  std::optional<double> min_size, max_size;
};

} // namespace trime::fitting
