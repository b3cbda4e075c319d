// SPDX-License-Identifier: BSD-3-Clause
#include "meshing/plan.hpp"

#include "meshing/rules.hpp"

namespace trime::meshing {

fitting::FitOptions fit_options(const MeshOptions& options, const sizing::SizeField& size) {
  const bool absolute = options.absolute_sizes, is_one_length = absolute && size.is_uniform();
  return {.cells_x = options.cells_x,
          .cells_y = options.cells_y,
          .points = absolute ? std::nullopt : options.points,
          .edge_length = is_one_length ? size.size({}) : options.edge_length,
          .absolute = absolute && !is_one_length,
          .point_limit = absolute ? options.points : std::nullopt,
          .gradation = options.gradation,
          .features = options.features,
          .min_size = options.min_size,
          .max_size = options.max_size};
}

start::StartOptions start_options(const MeshOptions& options) {
  return {.seed = options.seed,
          .start = options.start,
          .initial_fraction = options.initial_fraction,
          .cleanup = options.cleanup};
}

sweep::SweepOptions sweep_options(const MeshOptions& options) {
  return {options.method, options.max_sweeps, options.stop_tolerance, options.density_exponent, options.star_tests};
}

cleanup::CleanupOptions cleanup_options(const MeshOptions& options) {
  return {options.absolute_sizes ? 0 : options.points.value_or(0),
          options.features.keep_all ? 0 : MeshingRules::cleanup_tolerance * options.features.tolerance};
}

} // namespace trime::meshing
