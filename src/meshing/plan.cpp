// SPDX-License-Identifier: BSD-3-Clause
#include "meshing/plan.hpp"

#include "meshing/rules.hpp"

namespace trime::meshing {

start::StartOptions start_options(const MeshOptions& options) {
  start::StartOptions start;
  start.container = options.container;
  start.cells_x = options.cells_x;
  start.cells_y = options.cells_y;
  start.points = options.points;
  start.edge_length = options.edge_length;
  start.features = options.features;
  start.seed = options.seed;
  start.start = options.start;
  start.initial_fraction = options.initial_fraction;
  start.min_size = options.min_size;
  start.max_size = options.max_size;
  start.cleanup = options.cleanup;
  return start;
}

sweep::SweepOptions sweep_options(const MeshOptions& options) {
  return {options.method, options.max_sweeps, options.stop_tolerance, options.density_exponent, options.star_tests};
}

cleanup::CleanupOptions cleanup_options(const MeshOptions& options) {
  return {options.points.value_or(0),
          options.features.keep_all ? 0 : MeshingRules::cleanup_tolerance * options.features.tolerance};
}

} // namespace trime::meshing
