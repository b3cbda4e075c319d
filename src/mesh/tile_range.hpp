// SPDX-License-Identifier: BSD-3-Clause
// Consecutive tiles of a grid along its Hilbert curve.
#pragma once

#include "mesh/tile_grid.hpp"

namespace trime::mesh {

/// The tiles [first, last) of a grid.
struct TileRange {
  const TileGrid& grid;
  LocalIndex first, last;
};

} // namespace trime::mesh
