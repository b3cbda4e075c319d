// SPDX-License-Identifier: BSD-3-Clause
#include "meshing/plan.hpp"

#include "cleanup/rules.hpp"
#include "meshing/rules.hpp"

#include <cmath>

namespace trime::meshing {

namespace {

/// The shortest edges are shorter than h by about this factor.
constexpr double shortest_share = 0.6;

/// The smallest h with edges as long as was promised; 0 without a promise.
double least_for_edges(const MeshOptions& options) {
  return std::fmin(options.shortest_edge.value_or(0) / shortest_share, options.max_size.value_or(INFINITY));
}

/// The smallest h that is asked for.
std::optional<double> least_size(const MeshOptions& options) {
  if (!options.shortest_edge)
    return options.min_size;
  return std::fmax(options.min_size.value_or(0), least_for_edges(options));
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
          .least_lowered = least_for_edges(options),
          .shortest_edge = options.shortest_edge.value_or(0)};
}

start::StartOptions start_options(const MeshOptions& options, const start::OldPoints* old) {
  return {.seed = options.seed,
          .start = options.start,
          .initial_fraction = options.initial_fraction,
          .cleanup = options.cleanup,
          .old = old};
}

sweep::SweepOptions sweep_options(const MeshOptions& options) {
  return {options.method, options.max_sweeps, options.stop_tolerance, options.density_exponent, options.star_tests};
}

cleanup::CleanupOptions cleanup_options(const MeshOptions& options) {
  return {options.absolute_sizes ? 0 : options.points.value_or(0),
          options.features.keep_all ? 0 : MeshingRules::cleanup_tolerance * options.features.tolerance,
          cleanup::CleanupRules::bad_alpha, options.split_ears};
}

} // namespace trime::meshing
