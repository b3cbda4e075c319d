// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/drifts.hpp"

#include <algorithm>

namespace trime::mesh {

void Drifts::forget(LocalIndex tiles) {
  of_tile_.assign(static_cast<std::size_t>(tiles), 0);
  largest_ = {};
}

/// A site has moved less far than the sides of its tile and of the tiles next to it. So it is now in its own tile or in
/// a tile next to that one, and the side of this tile bounds how far it has moved. Therefore the tiles that the search
/// meets bound the drift of all sites that it must find, and the tiles within this bound hold them.
double Drifts::margin(geometry::Vec2 center, double reach, const KnownBins& bins) const {
  const TileGrid& grid = bins.grid();
  double widest = 0;
  grid.for_each_in(grid.rect_around(center, reach),
                   [&](LocalIndex number, int, const FixedRect&) { widest = std::max(widest, grid.side_of(number)); });
  const double bound = std::min(largest_.distance, largest_.in_sides * widest);
  double most = 0;
  grid.for_each_in(grid.rect_around(center, reach + bound), [&](LocalIndex number, int, const FixedRect&) {
    const LocalIndex tile = bins.known_tile(number);
    most = std::max(most, tile >= 0 ? of(tile) : largest_.in_sides * grid.side_of(number));
  });
  return std::min(most, bound);
}

} // namespace trime::mesh
