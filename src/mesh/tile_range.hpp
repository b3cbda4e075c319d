// SPDX-License-Identifier: BSD-3-Clause
// Some tiles of a grid, one after the other along its Hilbert curve.
#pragma once

#include "mesh/tile_grid.hpp"

namespace trime::mesh {

/// Tiles [first, last) of a grid.
struct TileRange {
  const TileGrid& grid;
  LocalIndex first, last;
};

} // namespace trime::mesh
