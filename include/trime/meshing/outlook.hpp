// SPDX-License-Identifier: BSD-3-Clause
// An estimate of what a run will do to the shape, computed without making a mesh. Plain data.
#pragma once

#include "trime/boundary/feature_summary.hpp"

namespace trime::meshing {

/// An estimate of MeshResult::features, and the resolution at which nothing would be simplified.
struct Outlook {
  boundary::FeatureReport features;
  bool keeps_all = false; ///< nothing is simplified or dropped
  /// Number of points that keep everything, about; a lower bound if not `is_enough`.
  double keeping_points = 0;
  double keeping_edge_length = 0; ///< mean edge length of that many points
  bool is_enough = false;
};

} // namespace trime::meshing
