// SPDX-License-Identifier: BSD-3-Clause
#include "meshing/plan.hpp"

#include "meshing/rules.hpp"

#include <cmath>

namespace trime::meshing {

namespace {

/// The shortest edges are shorter than h by about this factor.
constexpr double shortest_share = 0.6;

/// The smallest h, so that edges are as long as was promised.
std::optional<double> least_size(const MeshOptions& options) {
  if (!options.shortest_edge)
    return options.min_size;
  const double least = *options.shortest_edge / shortest_share;
  return std::fmax(options.min_size.value_or(0), options.max_size ? std::fmin(least, *options.max_size) : least);
}

} // namespace

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
          .min_size = least_size(options),
          .max_size = options.max_size,
          .least_lowered = options.shortest_edge ? least_size(options).value_or(0) : 0};
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
