// SPDX-License-Identifier: BSD-3-Clause
// How far sites have come since they were sorted into bins.
#pragma once

#include "mesh/known_bins.hpp"
#include "trime/core/types.hpp"
#include "trime/geometry/vec2.hpp"

#include <vector>

namespace trime::mesh {

/// For each tile a bound on how far a site that was sorted into it has come since. O(tiles of the container) memory.
class Drifts {
public:
  double of(LocalIndex tile) const { return of_tile_[static_cast<std::size_t>(tile)]; }
  void set(LocalIndex tile, double distance) { of_tile_[static_cast<std::size_t>(tile)] = distance; }
  std::size_t grid_table_bytes() const { return of_tile_.capacity() * sizeof(double); }
  const std::vector<double>& of_tiles() const { return of_tile_; }
  /// The largest of all, over all ranks. It is assumed of a tile of which no bin is known.
  double largest() const { return largest_; }
  void set_largest(double distance) { largest_ = distance; }

  /// Nothing has moved since the sites were sorted. @param tiles of the container
  void forget(LocalIndex tiles);
  /// How much farther a search around `center` has to go in the bins.
  double margin(geometry::Vec2 center, double reach, const KnownBins& bins) const;

private:
  std::vector<double> of_tile_;
  double largest_ = 0;
};

} // namespace trime::mesh
