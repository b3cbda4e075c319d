// SPDX-License-Identifier: BSD-3-Clause
// How far sites have come since they were sorted into bins.
#pragma once

#include "mesh/known_bins.hpp"
#include "trime/core/types.hpp"
#include "trime/geometry/vec2.hpp"

#include <span>
#include <vector>

namespace trime::mesh {

/// How far any site of any rank has come since sites were sorted.
struct DriftBound {
  double distance = 0; ///< domain units
  double in_sides = 0; ///< divided by the shortest side of the tile that the site was sorted into and of the tiles next
                       ///< to it; below 1
};

/// For each known tile, by its number in KnownBins, a bound on how far a site that was sorted into it has come since.
class Drifts {
public:
  double of(LocalIndex tile) const { return of_tile_[static_cast<std::size_t>(tile)]; }
  void set(LocalIndex tile, double distance) { of_tile_[static_cast<std::size_t>(tile)] = distance; }
  std::span<const double> of_tiles() const { return of_tile_; }
  /// Sets the bound for all tiles of all ranks. For a tile without known bins, nothing else is known.
  const DriftBound& largest() const { return largest_; }
  void set_largest(const DriftBound& bound) { largest_ = bound; }

  /// Nothing has moved since the sites were sorted. @param tiles the owned ones
  void forget(LocalIndex tiles);
  /// Sets how many tiles are known. Sites of new tiles may have moved as far as any site.
  void make_room(LocalIndex tiles) { of_tile_.resize(static_cast<std::size_t>(tiles), largest_.distance); }
  /// @brief How much farther a search around `center` has to go in the bins. O(tiles that the search meets): where
  /// sites are dense it depends on the drift there, not on that of coarse places.
  double margin(geometry::Vec2 center, double reach, const KnownBins& bins) const;

private:
  std::vector<double> of_tile_;
  DriftBound largest_;
};

} // namespace trime::mesh
