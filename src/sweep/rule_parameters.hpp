// SPDX-License-Identifier: BSD-3-Clause
// The parameters of an update rule, in addition to the star of a site: plain numbers, the same for all sites of a
// sweep.
#pragma once

#include "sweep/rules.hpp"

namespace trime::sweep {

/// The kind of rule: repulsive bars, centroids of Voronoi cells, or the energy of triangles.
enum class Mover { bars, cells, triangles };

struct RuleParameters {
  Mover mover = Mover::bars;
  double length_scale = 1;                     ///< bars: rest length over h
  double area_scale = 1;                       ///< triangles: wanted area over sqrt(3)/4 h^2
  int exponent = SweepRules::density_exponent; ///< cells: of 1/h in the weight
  double momentum = 0;                         ///< share of the last advance that the lead takes up
};

} // namespace trime::sweep
