// SPDX-License-Identifier: BSD-3-Clause
// Finds the zero set of a function coarsely, as closed chains of its crossings with the lines of a grid.
#pragma once

#include "tracing/level_function.hpp"

#include <vector>

namespace trime::tracing {

struct ZeroChains {
  std::vector<std::vector<geometry::Vec2>> chains; ///< closed chains with the interior on their left; neighbouring
                                                   ///< vertices are at most about 1.5 cells apart
  double cell;                                     ///< side of a cell of the grid
};

/// Returns the finest resolution of the grid.
/// @param side the longer side of the container
double finest_resolution(double side);

/// @brief Runs marching squares on a grid that covers the container and one more cell on each side. The cells are half
/// of `resolution` wide.
///
/// Coarse cells, four times as large, are examined everywhere; fine cells only where the values and slopes nearby allow
/// a zero, and along the curves from there. A curve that fits between the nodes of the fine grid is missed. Also
/// extends the function beyond the container (LevelFunction::build_wall). A resolution below finest_resolution() has no
/// further effect.
/// @throws GeometryError under the conditions of traced_part
ZeroChains march(LevelFunction& function, const geometry::Box& container, double resolution);

} // namespace trime::tracing
