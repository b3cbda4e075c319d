// SPDX-License-Identifier: BSD-3-Clause
#include "sweep/tiles_around.hpp"

#include "trime/core/error.hpp"

#include <algorithm>

namespace trime::sweep {

TilesAround::TilesAround(const mesh::BinnedPoints& points) {
  const mesh::TileGrid& grid = points.grid();
  const LocalIndex owned = points.last_tile() - points.first_tile();
  places_.assign(at(owned), TilePlace::inner);
  first_.push_back(0);
  for (LocalIndex t = 0; t < owned; ++t) {
    const GridPosition here = grid.tile_position(points.first_tile() + t);
    const int column = static_cast<int>(here.x), row = static_cast<int>(here.y);
    for (int y = std::max(0, row - 1); y <= std::min(grid.tiles_y() - 1, row + 1); ++y)
      for (int x = std::max(0, column - 1); x <= std::min(grid.tiles_x() - 1, column + 1); ++x) {
        const LocalIndex other = points.known_tile(grid.tile_at(x, y));
        TRIME_ASSERT(other >= 0, "no bin is known of the tile at column {}, row {}", x, y);
        if (other >= owned)
          places_[at(t)] = TilePlace::at_border;
        tiles_.push_back(other);
      }
    first_.push_back(tiles_.size());
  }
}

} // namespace trime::sweep
