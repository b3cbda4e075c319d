// SPDX-License-Identifier: BSD-3-Clause
#include "sweep/tiles_around.hpp"

#include "trime/core/error.hpp"

#include <algorithm>

namespace trime::sweep {

TilesAround::TilesAround(const mesh::BinnedPoints& points) {
  const mesh::TileGrid& grid = points.grid();
  const LocalIndex owned = points.last_tile() - points.first_tile();
  places_.assign(at(owned), TilePlace::inner);
  narrowest_.assign(at(owned), 0);
  first_.push_back(0);
  for (LocalIndex t = 0; t < owned; ++t) {
    const LocalIndex tile = points.first_tile() + t;
    double& narrowest = narrowest_[at(t)] = grid.side_of(tile);
    const mesh::FixedRect rect = mesh::common_part(rect_of(grid.tile(tile)).grown(1), grid.limits());
    grid.for_each_in(rect, [&](LocalIndex number, int, const mesh::FixedRect&) {
      const LocalIndex other = points.known_tile(number);
      TRIME_ASSERT(other >= 0, "no bin is known of tile {} next to tile {}", number, tile);
      if (other >= owned)
        places_[at(t)] = TilePlace::at_border;
      tiles_.push_back(other);
      narrowest = std::min(narrowest, grid.side_of(number));
    });
    first_.push_back(tiles_.size());
  }
}

} // namespace trime::sweep
