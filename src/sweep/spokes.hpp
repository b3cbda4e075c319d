// SPDX-License-Identifier: BSD-3-Clause
// The neighbours of one site, as the formulas of the rules take them.
#pragma once

#include "sites/star_view.hpp"
#include "sweep/rule_formulas.hpp"

namespace trime::sweep {

/// A neighbour as seen from a site at p.
inline Spoke<double> spoke_to(const sites::StarView& view, geometry::Vec2 p, LocalIndex neighbour) {
  const geometry::Vec2 u = view.points.position(neighbour) - p;
  return {u.x, u.y, u.x * u.x + u.y * u.y, view.size(neighbour)};
}

} // namespace trime::sweep
