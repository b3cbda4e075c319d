// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "trime/mesh/tile_grid.hpp"

#include <algorithm>

namespace trime::meshing {

/// Calls visit(tile) for a tile and those beside it; across a periodic border nothing is beside it.
template <class Visit>
void for_tiles_around(const mesh::TileGrid& grid, LocalIndex tile, const Visit& visit) {
  const GridPosition here = grid.tile_position(tile);
  const int column = static_cast<int>(here.x), row = static_cast<int>(here.y);
  for (int y = std::max(0, row - 1); y <= std::min(grid.tiles_y() - 1, row + 1); ++y)
    for (int x = std::max(0, column - 1); x <= std::min(grid.tiles_x() - 1, column + 1); ++x)
      visit(grid.tile_at(x, y));
}

} // namespace trime::meshing
