// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/drifts.hpp"

#include <algorithm>

namespace trime::mesh {

void Drifts::forget(LocalIndex tiles) {
  of_tile_.assign(static_cast<std::size_t>(tiles), 0);
  largest_ = 0;
}

/// Sites near `center` were sorted into its tile or one next to it, unless the search or the drift reaches across a
/// whole tile.
double Drifts::margin(geometry::Vec2 center, double reach, const KnownBins& bins) const {
  const TileGrid& grid = bins.grid();
  const geometry::Box box = grid.tile_box(0);
  if (reach + largest_ > std::min(box.width(), box.height()))
    return largest_;
  const int column = grid.tile_of(grid.x_axis().fixed(center.x)), row = grid.tile_of(grid.y_axis().fixed(center.y));
  double most = 0;
  for (int y = std::max(0, row - 1); y <= std::min(grid.tiles_y() - 1, row + 1); ++y)
    for (int x = std::max(0, column - 1); x <= std::min(grid.tiles_x() - 1, column + 1); ++x) {
      const LocalIndex tile = bins.known_tile(grid.tile_at(x, y));
      most = std::max(most, tile >= 0 ? of(tile) : largest_);
    }
  return most;
}

} // namespace trime::mesh
