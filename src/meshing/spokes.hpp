// SPDX-License-Identifier: BSD-3-Clause
// The neighbours of one site, as the formulas of the rules take them.
#pragma once

#include "meshing/rule_formulas.hpp"
#include "meshing/star_view.hpp"

namespace trime::meshing {

/// A neighbour as seen from a site at p.
inline Spoke<double> spoke_to(const StarView& view, geometry::Vec2 p, LocalIndex neighbour) {
  const geometry::Vec2 u = view.points.position(neighbour) - p;
  return {u.x, u.y, u.x * u.x + u.y * u.y, view.size(neighbour)};
}

} // namespace trime::meshing
