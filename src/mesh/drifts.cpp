// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/drifts.hpp"

#include <algorithm>

namespace trime::mesh {

void Drifts::forget(LocalIndex tiles) {
  of_tile_.assign(static_cast<std::size_t>(tiles), 0);
  largest_ = 0;
}

/// Sites near `center` were sorted into a tile that lies as near, but for the drift.
double Drifts::margin(geometry::Vec2 center, double reach, const KnownBins& bins) const {
  double most = 0;
  bins.grid().for_each_in(bins.grid().rect_around(center, reach + largest_),
                          [&](LocalIndex number, int, const FixedRect&) {
                            const LocalIndex tile = bins.known_tile(number);
                            most = std::max(most, tile >= 0 ? of(tile) : largest_);
                          });
  return most;
}

} // namespace trime::mesh
