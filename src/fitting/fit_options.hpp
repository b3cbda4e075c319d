// SPDX-License-Identifier: BSD-3-Clause
// Options of the fit of the size: the number of points or the edge length, the limits of the size, and which features
// of the boundary may be left out.
#pragma once

#include "trime/boundary/features.hpp"
#include "trime/core/types.hpp"

#include <optional>

namespace trime::fitting {

/// See MeshOptions for the meaning and the default of each option.
struct FitOptions {
  std::optional<int> cells_x, cells_y;
  std::optional<GlobalId> points; ///< exactly one of points and edge_length is set, unless the sizes are absolute
  std::optional<double> edge_length;
  bool absolute = false;               ///< the factor of the size is 1; then neither points nor edge_length is set
  std::optional<GlobalId> point_limit; ///< a mesh with more points is refused
  std::optional<double> gradation;     ///< largest growth of h per unit of distance; empty: not limited
  boundary::FeatureOptions features;
  std::optional<double> min_size, max_size;
  double least_lowered = 0; ///< narrow places do not lower h below this
  double shortest_edge = 0; ///< no edge of the boundary may be shorter; 0: no limit
};

} // namespace trime::fitting
