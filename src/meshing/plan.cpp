// SPDX-License-Identifier: BSD-3-Clause
#include "meshing/plan.hpp"

namespace trime::meshing {
using sweep::SweepOptions;

SweepOptions sweep_options(const MeshOptions& options) {
  SweepOptions sweeps{options.method, options.max_sweeps, options.stop_tolerance, options.density_exponent};
  sweeps.verify_stars = options.verify_stars;
  sweeps.stars_by_emptiness = options.stars_by_emptiness;
  return sweeps;
}

} // namespace trime::meshing
