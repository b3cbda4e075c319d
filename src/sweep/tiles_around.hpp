// SPDX-License-Identifier: BSD-3-Clause
// The tiles beside a tile, and which tiles of a rank have none of another rank beside them.
#pragma once

#include "mesh/binned_points.hpp"
#include "mesh/tile_grid.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace trime::sweep {

/// Calls visit(tile) for a tile and those beside it; across a periodic border nothing is beside it.
template <class Visit>
void for_tiles_around(const mesh::TileGrid& grid, LocalIndex tile, const Visit& visit) {
  const GridPosition here = grid.tile_position(tile);
  const int column = static_cast<int>(here.x), row = static_cast<int>(here.y);
  for (int y = std::max(0, row - 1); y <= std::min(grid.tiles_y() - 1, row + 1); ++y)
    for (int x = std::max(0, column - 1); x <= std::min(grid.tiles_x() - 1, column + 1); ++x)
      visit(grid.tile_at(x, y));
}

/// Where an owned tile lies. Inner tiles have only tiles of this rank around them: they can be swept while the ghosts
/// are on their way.
enum class TilePlace : std::uint8_t { inner, at_border };

/// The places of the owned tiles, in order.
inline std::vector<TilePlace> places_of_tiles(const mesh::BinnedPoints& points) {
  const LocalIndex first = points.first_tile(), last = points.last_tile();
  std::vector<TilePlace> places(static_cast<std::size_t>(last - first), TilePlace::inner);
  for (LocalIndex tile = first; tile < last; ++tile)
    for_tiles_around(points.grid(), tile, [&](LocalIndex other) {
      if (other < first || other >= last)
        places[static_cast<std::size_t>(tile - first)] = TilePlace::at_border;
    });
  return places;
}

} // namespace trime::sweep
