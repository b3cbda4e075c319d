// SPDX-License-Identifier: BSD-3-Clause
// How far sites have come since they were sorted into bins.
#pragma once

#include "mesh/known_bins.hpp"
#include "trime/core/types.hpp"
#include "trime/geometry/vec2.hpp"

#include <span>
#include <vector>

namespace trime::mesh {

/// For each known tile, by its number in KnownBins, a bound on how far a site that was sorted into it has come since.
class Drifts {
public:
  double of(LocalIndex tile) const { return of_tile_[static_cast<std::size_t>(tile)]; }
  void set(LocalIndex tile, double distance) { of_tile_[static_cast<std::size_t>(tile)] = distance; }
  std::span<const double> of_tiles() const { return of_tile_; }
  /// The largest of all, over all ranks. It is assumed of a tile of which no bin is known.
  double largest() const { return largest_; }
  void set_largest(double distance) { largest_ = distance; }

  /// Nothing has moved since the sites were sorted. @param tiles the owned ones
  void forget(LocalIndex tiles);
  /// So many tiles are known. Those that are new may have come as far as any.
  void make_room(LocalIndex tiles) { of_tile_.resize(static_cast<std::size_t>(tiles), largest_); }
  /// How much farther a search around `center` has to go in the bins.
  double margin(geometry::Vec2 center, double reach, const KnownBins& bins) const;

private:
  std::vector<double> of_tile_;
  double largest_ = 0;
};

} // namespace trime::mesh
