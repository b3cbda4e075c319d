// SPDX-License-Identifier: BSD-3-Clause
#include "meshing/plan_start.hpp"

namespace trime::meshing {
using start::StartOptions;

StartOptions plan_start(const MeshOptions& options) {
  StartOptions start;
  start.container = options.container;
  start.cells_x = options.cells_x;
  start.cells_y = options.cells_y;
  start.points = options.points;
  start.edge_length = options.edge_length;
  start.corner_angle = options.corner_angle;
  start.keep_features = options.keep_features;
  start.feature_tolerance = options.feature_tolerance;
  start.seed = options.seed;
  start.start = options.start;
  start.initial_fraction = options.initial_fraction;
  start.min_size = options.min_size;
  start.max_size = options.max_size;
  start.cleanup = options.cleanup;
  return start;
}

} // namespace trime::meshing
