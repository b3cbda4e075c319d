// SPDX-License-Identifier: BSD-3-Clause
// What a run will do to the shape, foretold without a mesh. Plain data.
#pragma once

#include "trime/boundary/feature_summary.hpp"

namespace trime::meshing {

/// About what MeshResult::features will say, and the resolution at which nothing would be simplified.
struct Outlook {
  boundary::FeatureReport features;
  bool keeps_all = false; ///< nothing is simplified or dropped
  /// About so many points keep everything; if not `is_enough`, more than these do.
  double keeping_points = 0;
  double keeping_edge_length = 0; ///< the mean one of so many points
  bool is_enough = false;
};

} // namespace trime::meshing
