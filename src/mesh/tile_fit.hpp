// SPDX-License-Identifier: BSD-3-Clause
// Fits tiles to the sites, so that all have about equal weight.
#pragma once

#include "mesh/tile_grid.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace trime::mesh {

/// Returns the largest number of sites in a tile, if the mesh has `points` points.
std::int64_t most_per_tile(double points);

/// Tiles and their weights.
struct WeightedTiles {
  std::vector<Tile> tiles; ///< in the order of the curve
  std::vector<std::int64_t> weights;
  bool divided = false; ///< some tiles were divided: the caller must find the weights of their quarters
};

/// @brief Joins and divides tiles so that each becomes the largest square that weighs at most `most`. One call divides
/// a tile only once, because the weights of its quarters are not known; repeated calls give a result that does not
/// depend on the first tiles. O(tiles).
/// @param weight of each tile of the grid
WeightedTiles fit_tiles(const TileGrid& grid, std::span<const std::int64_t> weights, std::int64_t most);

} // namespace trime::mesh
