// SPDX-License-Identifier: BSD-3-Clause
// Tiles of about equal weight.
#pragma once

#include "mesh/tile_grid.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace trime::mesh {

/// Returns the largest number of sites in a tile, if the mesh has `points` points.
std::int64_t most_per_tile(double points);

/// Tiles, and what lies in each.
struct WeightedTiles {
  std::vector<Tile> tiles; ///< along the curve
  std::vector<std::int64_t> weights;
  bool divided = false; ///< some tiles were divided: the caller must find the weights of their quarters
};

/// @brief Joins and divides tiles until each is the largest square that weighs at most `most`: what comes of it in the
/// end does not depend on the tiles at first. Divides once only, since weights of quarters are not known. O(tiles).
/// @param weights of the tiles of the grid
WeightedTiles fit_tiles(const TileGrid& grid, std::span<const std::int64_t> weights, std::int64_t most);

} // namespace trime::mesh
