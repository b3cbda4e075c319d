// SPDX-License-Identifier: BSD-3-Clause
// The first, coarse picture of a zero set: closed chains of its crossings with the lines of a grid.
#pragma once

#include "tracing/level_function.hpp"

#include <vector>

namespace trime::tracing {

struct ZeroChains {
  std::vector<std::vector<geometry::Vec2>>
      chains;  ///< closed, interior on the left, vertices at most about 1.5 cells apart
  double cell; ///< side of a cell
};

/// The grid is never finer than with this resolution. @param side the longer one of the container
double finest_resolution(double side);

/// @brief Marching squares on a grid with cells of half of `resolution` over the container and one ring of cells around
/// it.
///
/// Coarse cells, four times as large, are looked at everywhere; finer ones only where the zero set may be, judged by
/// the values and the slopes near by, and along the curves from there. A curve that fits between the nodes of the fine
/// grid is missed. Builds the wall of the function around the container.
/// A resolution below finest_resolution() has no further effect.
/// @throws GeometryError see traced_part
ZeroChains march(LevelFunction& function, const geometry::Box& container, double resolution);

} // namespace trime::tracing
