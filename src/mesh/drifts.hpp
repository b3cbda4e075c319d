// SPDX-License-Identifier: BSD-3-Clause
// Bounds on how far sites have moved since they were sorted into bins.
#pragma once

#include "mesh/known_bins.hpp"
#include "trime/core/types.hpp"
#include "trime/geometry/vec2.hpp"

#include <span>
#include <vector>

namespace trime::mesh {

/// A bound on how far any site of any rank has moved since the sites were sorted.
struct DriftBound {
  double distance = 0; ///< domain units
  /// Distance over the shortest side of the tile into which the site was sorted and of its neighbours; below 1.
  double in_sides = 0;
};

/// For each known tile, by its number in KnownBins, a bound on how far a site that was sorted into it has moved since.
class Drifts {
public:
  double of(LocalIndex tile) const { return of_tile_[static_cast<std::size_t>(tile)]; }
  void set(LocalIndex tile, double distance) { of_tile_[static_cast<std::size_t>(tile)] = distance; }
  std::span<const double> of_tiles() const { return of_tile_; }
  /// The bound for all tiles of all ranks, which is the only bound for tiles without known bins.
  const DriftBound& largest() const { return largest_; }
  void set_largest(const DriftBound& bound) { largest_ = bound; }

  /// Sets all bounds to 0 after sites were sorted. @param tiles number of owned tiles
  void forget(LocalIndex tiles);
  /// Sets how many tiles are known. A new tile gets the bound for all tiles.
  void make_room(LocalIndex tiles) { of_tile_.resize(static_cast<std::size_t>(tiles), largest_.distance); }
  /// @brief Returns how much farther a search around `center` must go in the bins. O(tiles that the search meets). It
  /// depends on the drift of nearby tiles only, so sites that move far in coarse regions do not slow down dense ones.
  double margin(geometry::Vec2 center, double reach, const KnownBins& bins) const;

private:
  std::vector<double> of_tile_;
  DriftBound largest_;
};

} // namespace trime::mesh
